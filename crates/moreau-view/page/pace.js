// How fast pictures come.

/** Adapts how sharp moving pictures are to how fast the machine draws them. */
class Pace {
    constructor(picture) {
        this.picture = picture;
        this.gaps = new Float32Array(40);
        this.count = 0;
        this.last = NaN;
        this.motion = -1e9;
    }

    /** Notes a picture that was drawn at `now`; after a rest (NaN) there is no gap to count. */
    note(now) {
        const gap = now - this.last;
        this.last = now;
        if (Number.isNaN(gap)) return;
        this.gaps[this.count++ % this.gaps.length] = gap;
        if (this.count % 12) return;
        const { picture } = this, rate = this.fps();
        const least = 0.5 / window.devicePixelRatio;
        if (rate < 22) picture.sharpness = Math.max(picture.sharpness * 0.8, Math.min(least, 1));
        else if (rate > 50 && picture.sharpness < 1) picture.sharpness = Math.min(picture.sharpness * 1.1, 1);
    }

    fps() {
        const n = Math.min(this.count, this.gaps.length);
        if (!n) return 0;
        let sum = 0;
        for (let k = 0; k < n; k++) sum += this.gaps[k];
        return (1000 * n) / sum;
    }
}
