// Puts the parts of the page together and tells its tests about them.

/** Says in the page that something went wrong. */
function tell(error) {
    byId("note").hidden = false;
    write(byId("note"), `Something went wrong: ${error.message}`);
    console.error(error);
}

/** Centre and radius of where the free bodies are in some frames, without the farthest few of many, and half the sides of the box around. */
function extent(run, frames) {
    const D = run.dimension, { radius, free } = run.bodies, low = [0, 0, 0], high = [0, 0, 0];
    const bounded = Array.from(radius.keys()).filter((i) => radius[i] > 0), moving = bounded.filter((i) => free[i]);
    const counted = moving.length ? moving : bounded;
    const largest = counted.reduce((most, i) => Math.max(most, radius[i]), 0);
    for (let k = 0; k < D; k++) {
        const places = new Float32Array(counted.length * frames.length);
        let count = 0;
        for (const { position } of frames)
            for (const i of counted) if (Number.isFinite(position[D * i + k])) places[count++] = position[D * i + k];
        if (!count) continue;
        const sorted = places.subarray(0, count).sort(), out = count > 200 ? Math.floor(count / 100) : 0;
        low[k] = sorted[out] - largest;
        high[k] = sorted[count - 1 - out] + largest;
    }
    const half = scale(sub(high, low), 0.5);
    return [scale(add(low, high), 0.5), norm(half) || 1, half];
}

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

class Page {
    async open() {
        const meta = await readMeta(), served = !byId("meta");
        this.run = new Run(meta, served);
        showHeader(meta);
        this.toggleTheme = listenTheme(() => this.themed());
        if (!this.run.frames) await this.firstFrame();
        this.run.ahead(0); // is decoded while programs are compiled
        this.picture = new Picture(byId("picture"), this.run);
        if (!this.picture.gl) this.note("This browser has no WebGL 2, so there is no picture; charts and numbers are there all the same.");
        this.playback = new Playback(this.run, this.picture);
        this.playback.changed = () => this.changed();
        this.picker = new Picker(this.picture);
        this.panel = new Panel(this.picture, (kind, index) => this.select(kind, index));
        this.charts = new Charts(this.run, (time) => this.seek(() => this.playback.seekTime(time)));
        this.pace = new Pace(this.picture);
        this.listen();
        await this.playback.seekFrame(0);
        this.frameAll([this.picture.frame]);
        this.live = new Live(this.run, this.playback, (grown) => this.grown(grown));
        requestAnimationFrame((now) => this.tick(now));
        await new Promise((drawn) => (this.firstDrawn = drawn));
        this.widen().catch(tell);
    }

    /** A live run may be opened before its first frame. */
    async firstFrame() {
        this.note("Waiting for the first frame …");
        while (!this.run.frames) {
            await new Promise((later) => setTimeout(later, 300));
            this.run.renew(await readMeta());
        }
        byId("note").hidden = true;
    }

    note(text) {
        byId("note").hidden = false;
        write(byId("note"), text);
    }

    frameAll(frames) {
        const [centre, radius, half] = extent(this.run, frames);
        this.picture.resize(false);
        this.picture.camera.fit(centre, radius, half);
        this.picture.dirty = true;
    }

    /** The view takes in the last frame too, once it is decoded, unless somebody has moved it. */
    async widen() {
        const first = this.picture.frame, last = await this.run.frame(this.run.frames - 1);
        if (!this.picture.camera.touched) this.frameAll([first, last]);
    }

    seek(action) {
        this.playback.playing = false;
        this.playback.follows = false;
        return action();
    }

    toggle() {
        this.playback.playing ? this.playback.pause() : this.playback.play();
        this.changed();
    }

    themed() {
        if (!this.picture) return;
        this.picture.theme = null;
        this.picture.dirty = true;
        this.charts?.draw();
    }

    select(kind, index) {
        this.picture.selection = { kind, index, from: this.picture.frame };
        this.picture.dirty = true;
        this.panel.update();
    }

    click({ x, y }) {
        const { canvas, chainsShown } = this.picture, [w, h] = [canvas.clientWidth, canvas.clientHeight];
        const contact = chainsShown ? this.picker.contact(x, y, w, h, 6) : -1;
        if (contact >= 0) return this.select("contact", contact);
        const body = this.picker.body((2 * x) / w - 1, 1 - (2 * y) / h);
        this.select(body >= 0 ? "body" : null, body);
    }

    colourBy(name) {
        if (!(name in COLOURINGS)) throw new Error(`nothing is coloured by ${name}`);
        this.picture.scalars.name = name;
        byId("colour").value = name;
        this.picture.fill();
        this.changed();
    }

    forces(on) {
        this.picture.chainsShown = on;
        byId("forces").checked = on;
        byId("faint").hidden = !on;
        this.picture.fill();
        this.changed();
    }

    /** Follows a selected contact from frame to frame. */
    follow() {
        const { selection, frame } = this.picture;
        if (selection.kind !== "contact" || selection.from === frame) return;
        const origin = selection.lost ?? { frame: selection.from, index: selection.index };
        const index = sameContact(origin.frame, origin.index, frame, this.run.dimension);
        this.picture.selection = { kind: "contact", index, from: frame, lost: index < 0 ? origin : undefined };
    }

    /** A ring around the selected body, which may be behind others. */
    ring() {
        const { camera, selection, canvas, run } = this.picture, mark = byId("ring");
        const place = selection.kind === "body" && camera.project(this.picker.position(selection.index));
        mark.hidden = !place || !Number.isFinite(place[0]) || !(run.bodies.radius[selection.index] > 0);
        if (mark.hidden) return;
        const depth = camera.flat ? camera.distance : dot(sub(camera.eye, this.picker.position(selection.index)), camera.back);
        const h = canvas.clientHeight, half = (run.bodies.radius[selection.index] * h) / (2 * SLOPE * depth) + 5;
        const x = 0.5 * (1 + place[0]) * canvas.clientWidth - half, y = 0.5 * (1 - place[1]) * h - half;
        mark.style.width = mark.style.height = `${(2 * half).toFixed(1)}px`;
        mark.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    }

    /** Something that is shown beside the picture has changed. */
    changed() {
        const { playback, run } = this;
        this.follow();
        byId("scrubber").max = playback.last;
        byId("scrubber").value = playback.index;
        write(byId("clock"), `${playback.time.toPrecision(4)} s · ${playback.index + 1} / ${run.frames}`);
        write(byId("play"), playback.playing ? "❚❚" : "▶");
        byId("play").setAttribute("aria-label", playback.playing ? "Pause" : "Play");
        byId("rate").value = playback.rate;
        this.charts.show(playback.time);
        this.panel.update();
        showLegend(this.picture);
        this.picture.dirty = true;
    }

    /** A live run has grown. */
    grown(frames) {
        showHeader(this.run.meta);
        this.charts.renew();
        if (frames && this.playback.follows) this.playback.seekFrame(this.playback.last).catch(tell);
        else this.changed();
    }

    tick(now) {
        requestAnimationFrame((next) => this.tick(next));
        const { picture, playback, pace } = this;
        playback.advance(now);
        if (playback.playing || byId("picture").classList.contains("dragging")) pace.motion = now;
        picture.resize(now - pace.motion < 300);
        if (!picture.dirty) return void (pace.last = NaN);
        if (picture.gl) {
            picture.draw();
            this.ring();
            pace.note(now);
        }
        picture.dirty = false;
        this.firstDrawn?.();
    }

    listen() {
        const { playback, picture } = this, on = (id, kind, action) => byId(id).addEventListener(kind, action);
        byId("colour").append(...Object.entries(COLOURINGS).map(([name, { title }]) => element("option", { value: name }, title)));
        byId("rate").append(...RATES.map((rate) => element("option", { value: rate }, `${figures(rate)} ×`)));
        on("colour", "change", (event) => this.colourBy(event.target.value));
        on("forces", "change", (event) => this.forces(event.target.checked));
        on("faded", "change", (event) => {
            picture.faded = event.target.checked;
            picture.dirty = true;
        });
        const reset = () => {
            picture.camera.face();
            picture.camera.refit();
            picture.dirty = true;
        };
        on("reset", "click", reset);
        on("play", "click", () => this.toggle());
        const step = (by) => this.seek(() => playback.seekFrame(playback.index + by)).catch(tell);
        on("back", "click", () => step(-1));
        on("next", "click", () => step(1));
        on("scrubber", "input", (event) => this.seek(() => playback.seekFrame(Number(event.target.value))).catch(tell));
        on("rate", "change", (event) => (playback.rate = Number(event.target.value)));
        on("blending", "change", (event) => (playback.blending = event.target.checked));
        on("theme", "click", () => this.toggleTheme());
        const help = () => byId("keys").showModal();
        on("help", "click", help);
        listenPicture(byId("picture"), picture.camera, () => (picture.dirty = true), (place) => this.click(place));
        const names = Object.keys(COLOURINGS);
        listenKeys({
            " ": () => this.toggle(), ArrowLeft: (far) => step(far ? -10 : -1), ArrowRight: (far) => step(far ? 10 : 1),
            Home: () => step(-Infinity), End: () => step(Infinity), "[": () => playback.shiftRate(-1), "]": () => playback.shiftRate(1),
            c: () => this.colourBy(names[(names.indexOf(picture.scalars.name) + 1) % names.length]),
            f: () => this.forces(!picture.chainsShown), r: reset, t: () => this.toggleTheme(), "?": help,
            h: () => {
                picture.scalars.hold = !picture.scalars.hold;
                picture.fill();
                this.changed();
            },
            Escape: () => this.select(null, -1),
        });
    }
}

const page = new Page();
const ready = page.open();
ready.catch(tell);

/** For tests and for those who look behind the page. */
window.moreau = {
    ready,
    page,
    frame: () => page.playback.index,
    frames: () => page.run.frames,
    time: () => page.playback.time,
    setFrame: async (i) => {
        await page.seek(() => page.playback.seekFrame(i));
        await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
    },
    position: (i) => page.picker.position(i).slice(0, page.run.dimension),
    play: () => page.playback.play(),
    pause: () => page.playback.pause(),
    playing: () => page.playback.playing,
    colourBy: (name) => page.colourBy(name),
    forces: (on) => page.forces(on),
    select: (kind, index) => page.select(kind, index),
    selection: () => ({ kind: page.picture.selection.kind, index: page.picture.selection.index }),
    fps: () => page.pace.fps(),
    framesDrawn: () => page.picture.drawn,
    chartTime: () => page.charts.time,
    cameraMatrix: () => [...page.picture.camera.matrix],
    /** Where a point of the scene is on the page, in CSS pixels of the window. */
    project: (p) => {
        const box = byId("picture").getBoundingClientRect(), place = page.picture.camera.project([p[0], p[1], p[2] ?? 0]);
        return place && [box.left + 0.5 * (1 + place[0]) * box.width, box.top + 0.5 * (1 - place[1]) * box.height];
    },
    contactEnds: (k) => page.picker.ends(k),
};
