// The number of each body by which it is coloured.

const COLOURINGS = {
    material: { title: "material", unit: "" },
    speed: { title: "speed", unit: "m/s" },
    spin: { title: "spin", unit: "rad/s" },
    energy: { title: "kinetic energy", unit: "J" },
    coordination: { title: "coordination", unit: "" },
};

/** Length of the vector of body `i` in an array with `parts` numbers a body. */
function lengthAt(array, i, parts) {
    let square = 0;
    for (let k = parts * i; k < parts * (i + 1); k++) square += array[k] * array[k];
    return Math.sqrt(square);
}

/** Kinetic energy in J: of translation, and of rotation too where the moment of inertia is known, which is that of balls and disks. */
function kineticEnergy(run, frame, i) {
    const { mass, shape } = run.bodies, m = mass[i] ?? 0, D = run.dimension;
    const v = lengthAt(frame.velocity, i, D), r = run.meta.shapes[shape[i]].ball ?? 0;
    const w = r ? lengthAt(frame.spin, i, D === 3 ? 3 : 1) : 0;
    return 0.5 * m * (v * v + (D === 3 ? 0.4 : 0.5) * r * r * w * w);
}

class Scalars {
    constructor(run) {
        this.run = run;
        this.values = new Float32Array(run.n);
        this.touching = new Uint16Array(run.n);
        this.bins = new Uint32Array(200);
        this.name = "material";
        this.hold = false;
        this.low = 0;
        this.high = 255;
    }

    /** How many contacts with an impulse each body has. */
    count(frame) {
        this.touching.fill(0);
        for (let k = 0; k < frame.contacts; k++) {
            if (frame.status[k] === 0) continue;
            this.touching[frame.a[k]]++;
            this.touching[frame.b[k]]++;
        }
    }

    fill(frame) {
        const { run, values, name } = this, D = run.dimension;
        this.count(frame);
        if (name === "material") values.set(run.bodies.material);
        else if (name === "coordination") values.set(this.touching);
        else
            for (let i = 0; i < run.n; i++) {
                if (name === "speed") values[i] = lengthAt(frame.velocity, i, D);
                else if (name === "spin") values[i] = lengthAt(frame.spin, i, D === 3 ? 3 : 1);
                else values[i] = kineticEnergy(run, frame, i);
            }
        if (name === "material") [this.low, this.high] = [0, 255];
        else if (!this.hold) this.range();
    }

    /** From zero to a round number that all but the fastest hundredth of the free bodies stay below. */
    range() {
        const { values, bins } = this, { free } = this.run.bodies;
        let most = 0, count = 0;
        for (let i = 0; i < values.length; i++) if (free[i] && values[i] > most) most = values[i];
        bins.fill(0);
        for (let i = 0; i < values.length; i++) {
            if (!free[i] || !(values[i] >= 0)) continue;
            bins[Math.min(Math.floor((values[i] / (most || 1)) * bins.length), bins.length - 1)]++;
            count++;
        }
        let bin = bins.length - 1;
        for (let above = bins[bin]; bin > 0 && above < 0.01 * count; ) above += bins[--bin];
        this.low = 0;
        this.high = roundUp((most * (bin + 1)) / bins.length);
        if (this.name === "coordination") this.high = Math.max(4, Math.ceil((most * (bin + 1)) / bins.length));
    }
}
