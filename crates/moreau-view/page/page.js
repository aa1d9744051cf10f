// The parts of the page, put together.

/** Says in the page that something went wrong. */
function tell(error) {
    byId("note").hidden = false;
    write(byId("note"), `Something went wrong: ${error.message}`);
    console.error(error);
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
        byId("picture").addEventListener("webglcontextlost", () => this.note("The graphics card has dropped the picture; load the page again."));
        if (!this.picture.gl) this.note("This browser has no WebGL 2, so there is no picture; charts and numbers are there all the same.");
        this.playback = new Playback(this.run, this.picture);
        this.playback.changed = () => this.changed();
        this.picker = new Picker(this.picture);
        this.panel = new Panel(this.picture, (kind, index) => this.select(kind, index));
        this.charts = new Charts(this.run, (time) => this.seek(() => this.playback.seekTime(time)));
        this.pace = new Pace(this.picture);
        listenPage(this);
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
}
