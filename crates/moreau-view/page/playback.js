// The time that is shown, and how it goes on.

/** Rates, in seconds of the run for a second of ours. */
const RATES = [-5, -4, -3, -2, -1, 0, 1].flatMap((e) => [1, 2, 5].map((m) => m * 10 ** e));

class Playback {
    constructor(run, picture) {
        this.run = run;
        this.picture = picture;
        this.playing = false;
        this.index = 0;
        this.time = run.times[0];
        this.blending = true;
        this.follows = run.meta.live; // a live run's newest frame
        // A run lasts about ten seconds unless it is told otherwise.
        const wanted = (run.times.at(-1) - run.times[0]) / 10;
        this.rate = RATES.reduce((best, rate) => (Math.abs(Math.log(rate / wanted)) < Math.abs(Math.log(best / wanted)) ? rate : best));
        this.reaching = false;
    }

    get last() {
        return this.run.frames - 1;
    }

    play() {
        if (this.index >= this.last && !this.run.meta.live) this.seekFrame(0).catch(tell);
        this.follows = false;
        this.playing = true;
        this.before = undefined;
    }

    pause() {
        if (this.playing) {
            this.playing = false;
            this.seekFrame(this.index).catch(tell);
        }
    }

    /** Shows frame `i` when it is decoded; of several that are asked for meanwhile the last one. */
    seekFrame(i) {
        this.index = clamp(Math.round(i), 0, this.last);
        this.time = this.run.times[this.index];
        if (!this.reaching) this.seeking = this.reach();
        return this.seeking;
    }

    /** Decodes what is asked for, one block after the other, until that is shown. */
    async reach() {
        this.reaching = true;
        try {
            for (;;) {
                const { index } = this, frame = this.run.decoded(index) ?? (await this.run.frame(index));
                if (this.playing) return;
                if (index !== this.index) continue;
                this.picture.show(frame, null, 0);
                this.run.ahead(index + 1);
                return this.changed();
            }
        } finally {
            this.reaching = false;
        }
    }

    /** Shows the frame that is nearest to a time. */
    seekTime(time) {
        const { times } = this.run, i = lastBelow(times, time);
        const next = i < this.last && times[i + 1] - time < time - times[i] ? i + 1 : i;
        return this.seekFrame(next);
    }

    /** Goes on by the time since the last picture; waits, without losing time, for frames that are not decoded yet. */
    advance(now) {
        if (!this.playing) return;
        const passed = Math.min(now - (this.before ?? now), 250) / 1000;
        this.before = now;
        const { times } = this.run, time = Math.min(this.time + passed * this.rate, times[this.last]);
        const index = lastBelow(times, time), second = Math.min(index + 1, this.last);
        const frame = this.run.decoded(index), next = this.run.decoded(second);
        this.run.ahead(second);
        if (!frame || !next) return this.run.ahead(index);
        [this.time, this.index] = [time, index];
        const blend = second > index ? (time - times[index]) / (times[second] - times[index]) : 0;
        this.picture.show(frame, next, this.blending ? blend : 0);
        // The next block is decoded while this one plays.
        const k = this.run.blockOf(index);
        if (k + 1 < this.run.firsts.length) this.run.ahead(this.run.firsts[k + 1]);
        if (index === this.last && !this.run.meta.live) this.playing = false;
        this.changed();
    }

    /** A rate that is `by` places further in the list. */
    shiftRate(by) {
        const i = RATES.findIndex((rate) => rate >= this.rate * 0.999);
        this.rate = RATES[clamp(i + by, 0, RATES.length - 1)];
        this.changed();
    }
}
