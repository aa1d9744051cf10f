// The picture: one canvas, drawn again only when something in it has changed.

/** With more bodies than this, edges are not smoothed: it costs more than it shows. */
const SMOOTH_UP_TO = 3000;

class Picture {
    constructor(canvas, run) {
        this.canvas = canvas;
        this.run = run;
        this.smooth = run.n <= SMOOTH_UP_TO;
        this.gl = canvas.getContext("webgl2", { alpha: false, antialias: this.smooth, powerPreference: "high-performance" });
        this.camera = new Camera(run.dimension, run.meta.gravity);
        this.scalars = new Scalars(run);
        this.chainsShown = false;
        this.faded = true;
        this.blend = 0;
        this.dirty = true;
        this.drawn = 0;
        this.sharpness = 1;
        this.selection = { kind: null, index: -1 };
        if (this.gl) this.prepare();
    }

    prepare() {
        const { gl, run } = this, flat = run.dimension === 2, D = run.dimension;
        gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
        this.places = [new ArrayTexture(gl, run.n, D), new ArrayTexture(gl, run.n, D)];
        this.turns = [new ArrayTexture(gl, run.n, flat ? 2 : 4), new ArrayTexture(gl, run.n, flat ? 2 : 4)];
        this.values = new ArrayTexture(gl, run.n, 1);
        this.facts = new ArrayTexture(gl, run.n, 2);
        const facts = new Float32Array(2 * run.n);
        for (let i = 0; i < run.n; i++) facts.set([run.bodies.radius[i], run.bodies.free[i]], 2 * i);
        this.facts.send(facts);
        this.ramps = { even: colourTexture(gl, rampBytes()), named: colourTexture(gl, namedBytes()) };
        this.bodies = new Bodies(gl, run);
        this.planes = new Planes(gl, run);
        this.chains = new Chains(gl, run);
        this.sent = [null, null];
        this.set = (program) => this.share(program);
    }

    /** Shows frame `first`, or a place between it and `second`. */
    show(first, second, blend) {
        this.frame = first;
        this.blend = second ? blend : 0;
        this.dirty = true;
        if (!this.gl) return this.scalars.count(first);
        second ??= first;
        if (this.sent[1] === first && this.sent[0] !== first) {
            // What came next is now first: only a new next one has to be sent.
            for (const list of [this.places, this.turns, this.sent]) list.reverse();
        }
        [first, second].forEach((frame, k) => {
            if (this.sent[k] === frame) return;
            this.places[k].send(frame.position);
            this.turns[k].send(frame.rotation);
            this.sent[k] = frame;
        });
        if (this.filled !== first) this.fill();
    }

    /** Sends what is coloured by, and contacts. */
    fill() {
        this.filled = this.frame;
        this.dirty = true;
        this.scalars.fill(this.frame);
        if (!this.gl) return;
        this.values.send(this.scalars.values);
        if (this.chainsShown) this.chains.send(this.frame);
    }

    /** Fits the canvas to its box; `moving` pictures may be coarser if the machine is slow. */
    resize(moving) {
        const { canvas, camera } = this;
        const ratio = window.devicePixelRatio * (moving ? this.sharpness : 1);
        const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
        const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
        if (canvas.width === width && canvas.height === height) return;
        [canvas.width, canvas.height] = [width, height];
        this.dirty = true;
        camera.aspect = width / height;
        if (camera.touched) camera.update();
        else camera.refit();
    }

    /** What all programs need. */
    share(program) {
        const { gl, camera, scalars } = this, theme = this.theme;
        program.matrix("view", camera.view);
        program.matrix("projection", camera.projection);
        for (const name in theme) program.vector(name, theme[name]);
        program.number("pixel", (2 * SLOPE * (camera.flat ? camera.distance : 1)) / this.canvas.height);
        program.number("fade", this.chainsShown && this.faded ? 0.74 : 0);
        program.number("blend", this.blend);
        program.number("low", scalars.low);
        program.number("high", scalars.high);
        program.integer("chosen", this.selection.kind === "body" ? this.selection.index : -1);
        const ramp = scalars.name === "material" ? this.ramps.named : this.ramps.even;
        this.bind(program, "placesA", 0, this.places[0].texture);
        this.bind(program, "placesB", 1, this.places[1].texture);
        this.bind(program, "turnsA", 2, this.turns[0].texture);
        this.bind(program, "turnsB", 3, this.turns[1].texture);
        this.bind(program, "values", 4, this.values.texture);
        this.bind(program, "facts", 5, this.facts.texture);
        this.bind(program, "ramp", 6, ramp);
        gl.activeTexture(gl.TEXTURE0 + 7); // what is sent to textures later must not land in those of a program
    }

    bind(program, name, unit, texture) {
        this.gl.activeTexture(this.gl.TEXTURE0 + unit);
        this.gl.bindTexture(this.gl.TEXTURE_2D, texture);
        program.integer(name, unit);
    }

    draw() {
        const { gl, camera } = this, flat = camera.flat;
        this.theme ??= themeColours();
        gl.viewport(0, 0, this.canvas.width, this.canvas.height);
        gl.clearColor(...this.theme.ground, 1);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        // In the plane all lie at one depth: the order of drawing decides, and disks have soft rims.
        for (const [capability, on] of [[gl.DEPTH_TEST, !flat], [gl.BLEND, flat]]) on ? gl.enable(capability) : gl.disable(capability);
        if (flat) this.planes.draw(this.set, camera.home.target, camera.home.radius, flat);
        this.bodies.draw(this.set, this.smooth);
        if (!flat) this.planes.draw(this.set, camera.home.target, camera.home.radius, flat);
        if (this.chainsShown) {
            // Forces lie inside the bodies, so they are drawn over them, with depth among themselves alone.
            gl.clear(gl.DEPTH_BUFFER_BIT);
            this.chains.draw(this.set, this.selection.kind === "contact" ? this.selection.index : -1);
        }
        gl.bindVertexArray(null);
        this.dirty = false;
        this.drawn++;
    }
}
