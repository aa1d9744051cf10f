// Runs that were never computed, with all that a page has to show: bodies of all kinds, contacts of each status, every column of the
// steps. `node synthetic.mjs KIND BODIES FRAMES PAGE.html [EXPECTED.json]`; kinds are balls, mixed and plane.

import { writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { assemble } from "./assemble.mjs";

const BLOCK_BYTES = Number(process.env.BLOCK_BYTES ?? 4e6);

/** Numbers from 0 to 1 that are the same each time. */
function random(seed) {
    let state = seed;
    return () => {
        state = (Math.imul(state ^ (state >>> 15), 0x2c1b3c6d) + 0x9e3779b9) >>> 0;
        return (state ^ (state >>> 12)) / 4294967296 % 1;
    };
}

const BOX = [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]];
const BOX_FACES = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
const sized = (corners, size) => corners.map((p) => p.map((x, i) => x * size[i]));

/** Shapes by kind of run: those of free bodies, then those of the ground. */
function shapesOf(kind, r) {
    if (kind === "plane") {
        const gon = (m) => Array.from({ length: m }, (_, k) => [r * Math.cos((2 * Math.PI * k) / m), r * Math.sin((2 * Math.PI * k) / m)]);
        const moving = [{ ball: r }, { ball: 0.8 * r }, { vertices: gon(5), polygons: [[0, 1, 2, 3, 4]] },
            { vertices: sized([[-1, -1], [1, -1], [1, 1], [-1, 1]], [0.7 * r, 0.7 * r]), polygons: [[0, 1, 2, 3]] }];
        return [moving, [{ plane: [0, 1] }, { vertices: [[-3 * r, 0], [0, r], [4 * r, 0]], polygons: [[0, 1], [1, 2]] }]];
    }
    const moving = kind === "balls" ? [{ ball: r }, { ball: 0.85 * r }]
        : [{ ball: r }, { vertices: sized(BOX, [0.62 * r, 0.62 * r, 0.45 * r]), polygons: BOX_FACES }, { ball: 0.8 * r },
            { vertices: [[0, 0, r], [0.94 * r, 0, -0.33 * r], [-0.47 * r, 0.82 * r, -0.33 * r], [-0.47 * r, -0.82 * r, -0.33 * r]],
                polygons: [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]] }];
    return [moving, [{ plane: [0, 0, 1] }, { vertices: sized(BOX, [3 * r, 3 * r, 0.6 * r]), polygons: BOX_FACES }]];
}

/** The run: a heap on a lattice that comes together while it falls. */
export class Synthetic {
    constructor(kind, n, frames) {
        Object.assign(this, { kind, frames, D: kind === "plane" ? 2 : 3, r: 0.01 });
        const [moving, ground] = shapesOf(kind, this.r), shapes = [...moving, ...ground], dice = random(7);
        this.grounds = ground.length;
        this.n = n + ground.length;
        const shape = [...ground.map((_, i) => moving.length + i), ...Array.from({ length: n }, (_, i) => i % moving.length)];
        const radius = shape.map((s) => (shapes[s].plane ? 0 : shapes[s].ball ?? Math.max(...shapes[s].vertices.map((v) => Math.hypot(...v)))));
        this.bodies = {
            name: shape.map((_, i) => (i === 0 ? "floor" : i === 1 ? "step" : i % 3 ? null : `grain.${i}`)),
            material: shape.map((_, i) => (i < ground.length ? 2 : i % 2)), free: shape.map((_, i) => (i < ground.length ? 0 : 1)), radius,
            mass: shape.map((_, i) => (i < ground.length ? null : 2500 * 4 * radius[i] ** 3)), shape,
        };
        this.shapes = shapes;
        this.side = Math.ceil(this.D === 2 ? Math.sqrt(n * 1.6) : Math.cbrt(n));
        this.axes = Array.from({ length: n }, () => [dice() - 0.5, dice() - 0.5, dice() - 0.5]);
    }

    cell(i) {
        const k = i - this.grounds, s = this.side;
        return this.D === 2 ? [k % s, Math.floor(k / s)] : [k % s, Math.floor(k / s) % s, Math.floor(k / (s * s))];
    }

    /** Where body `i` is at `t` from 0 to 1; the last one comes late, and is not a number before. */
    place(i, t) {
        const { D, r, side } = this;
        if (i === this.n - 1 && t < 0.3) return Array(D).fill(NaN);
        if (i === 0) return D === 2 ? [0, 0] : [0, 0, 0];
        if (i === 1) return D === 2 ? [-side * r - 8 * r, 0] : [-side * r - 6 * r, 0, 0.6 * r];
        const cell = this.cell(i), loose = 1 + 0.35 * (1 - t) ** 2, axis = this.axes[i - this.grounds];
        const place = cell.slice(0, D - 1).map((c, k) => (c - (side - 1) / 2) * 2 * r * loose + axis[k] * r * (1 - t));
        return [...place, r + cell[D - 1] * 1.98 * r * loose + 6 * r * (1 - t) ** 2];
    }

    /** The raw bytes of frame `f`, and the number of its contacts. */
    frame(f) {
        const { D, n, grounds } = this, t = f / Math.max(this.frames - 1, 1), h = 1e-4;
        const position = [], rotation = [], velocity = [], spin = [];
        for (let i = 0; i < n; i++) {
            const p = this.place(i, t), q = this.place(i, t + h), axis = i < grounds ? [0, 0, 0] : this.axes[i - grounds];
            const angle = (i < grounds ? 0 : 6) * t * (1 + Math.abs(axis[0])), size = Math.hypot(...axis) || 1;
            position.push(...p);
            velocity.push(...q.map((x, k) => (x - p[k]) / h));
            if (D === 2) rotation.push(Math.cos(angle), Math.sin(angle));
            else rotation.push(...axis.map((x) => (x / size) * Math.sin(angle / 2)), Math.cos(angle / 2));
            spin.push(...(D === 2 ? [6 * (1 - t)] : axis.map((x) => (6 * (1 - t) * x) / size)));
        }
        const contacts = this.contacts(position, t), m = contacts.length;
        const floats = (list) => Buffer.from(Float32Array.from(list).buffer), of = (key) => contacts.flatMap((c) => c[key]);
        const indices = (key) => Buffer.from(Uint32Array.from(contacts, (c) => c[key]).buffer);
        const status = Buffer.alloc(4 * Math.ceil(m / 4));
        contacts.forEach((c, k) => (status[k] = c.status));
        const parts = [position, rotation, velocity, spin].map(floats);
        const motion = Buffer.alloc(4 * Math.ceil(n / 4));
        for (let i = 0; i < n; i++) motion[i] = Number.isNaN(position[D * i]) ? 0 : i < grounds ? 1 : 2;
        parts.push(motion, indices("a"), indices("b"), ...["point", "normal", "impulse", "gap"].map((key) => floats(of(key))), status);
        return { bytes: Buffer.concat(parts), contacts: m };
    }

    /** Neighbours of the lattice that are near, and the lowest bodies with the floor. */
    contacts(position, t) {
        const { D, n, side, grounds } = this, strides = D === 2 ? [1, side] : [1, side, side * side], found = [];
        const at = (i) => position.slice(D * i, D * (i + 1));
        for (let i = grounds; i < n; i++) {
            const cell = this.cell(i), load = (side - cell[D - 1]) ** 1.2 * 1e-4 * t * (0.3 + Math.abs(this.axes[i - grounds][0]) * 2);
            strides.forEach((stride, axis) => {
                const j = i + stride;
                if (j < n && cell[axis] + 1 < side) this.touch(found, i, j, at(i), at(j), load * (axis === D - 1 ? 1 : 0.4));
            });
            if (cell[D - 1] === 0) {
                const foot = at(i);
                foot[D - 1] = 0;
                this.touch(found, 0, i, foot, at(i), 1.2 * load, true);
            }
        }
        return found;
    }

    touch(found, a, b, p, q, load, floor = false) {
        const apart = q.map((x, k) => x - p[k]), d = Math.hypot(...apart), normal = apart.map((x) => x / d);
        const gap = d - (floor ? 1 : 2) * this.r;
        if (!(gap <= 0.25 * this.r)) return;
        const status = gap > 0.1 * this.r ? 0 : found.length % 4 === 0 ? 2 : 1;
        const slip = 0.2 * load, impulse = normal.map((x, k) => (status ? load * x + (k === 0 ? slip * (1 - normal[0] ** 2) : 0) : 0));
        found.push({ a, b, point: p.map((x, k) => x + (floor ? 0 : apart[k] / 2)), normal, impulse, gap, status });
    }

    /** Columns of a thousand steps. */
    steps() {
        const dice = random(3), count = 1000, column = (value) => Array.from({ length: count }, (_, k) => value(k / (count - 1), k));
        const noise = () => 0.6 + 0.8 * dice();
        return {
            step: column((_, k) => k + 1), time: column((t) => 0.5 * t), contacts: column((t) => Math.round(3 * this.n * t)),
            active: column((t) => Math.round(2.2 * this.n * t * t)), sweeps: column((t) => Math.round(10 + 90 * t * noise())),
            eps_motion: column(() => 1e-15 * noise()), eps_bipotential: column((t) => 4e-8 * noise() * (0.2 + t)),
            eps_penetration: column((t) => (t < 0.1 ? null : 2e-8 * noise())), scaled_residual: column(() => 6e-8 * noise()),
            penetration: column((t) => 1e-6 * t * noise()), kinetic: column((t) => 2 * t * (1 - t) ** 2), potential: column((t) => 1 - 0.8 * t),
            work: column(() => 0), dissipated: column((t) => 0.8 * t - 2 * t * (1 - t) ** 2), impact: column((t) => 0.3 * t), friction: column((t) => 0.4 * t), balance_error: column((t) => 1e-6 * t * noise()),
            seconds_detect: column(() => 2e-4 * noise()), seconds_localise: column(() => 5e-5 * noise()),
            seconds_solve: column((t) => 1e-3 * (0.2 + t) * noise()), seconds_step: column((t) => 1.2e-3 * (0.3 + t) * noise()),
        };
    }

    /** Meta data, and the raw bytes of each block. */
    make() {
        const frames = { time: [], step: [], contacts: [] }, blocks = [], raw = [];
        for (let f = 0; f < this.frames; f++) {
            const { bytes, contacts } = this.frame(f);
            const t = f / Math.max(this.frames - 1, 1);
            frames.time.push(0.5 * t);
            frames.step.push(Math.round(1000 * t));
            frames.contacts.push(contacts);
            if (!raw.length || raw.at(-1).size > BLOCK_BYTES) {
                blocks.push({ first: f, frames: 0 });
                raw.push({ size: 0, parts: [] });
            }
            blocks.at(-1).frames++;
            raw.at(-1).size += bytes.length;
            raw.at(-1).parts.push(bytes);
        }
        return { meta: this.meta(frames, blocks), blocks: raw.map(({ parts }) => Buffer.concat(parts)) };
    }

    meta(frames, blocks) {
        const { D, bodies, shapes } = this;
        return {
            version: 1, title: `A made-up heap of ${this.n - this.grounds} ${{ balls: "balls", mixed: "balls, boxes and tetrahedra", plane: "disks and polygons" }[this.kind]}`,
            dimension: D, gravity: D === 2 ? [0, -9.81] : [0, 0, -9.81], scene: "# </script> is harmless here", live: false,
            solver: { local: "pdas", global: "nlgs", criterion: "eps_glob", tolerance: 1e-7 },
            verdict: {
                steps: 1000, planned_steps: 1000, unconverged_steps: 0, scaled_residual_max: 8e-8, eps_glob_max: 9.3e-8, penetration_max: 1.4e-6,
                balance_error_max: 1.3e-6, reliable: true, reasons: [],
                checks: [{ name: "Convergence", passed: true, text: "the solver met its criterion in all 1000 steps" }], seconds: { detect: 0.2, localise: 0.05, solve: 1, output: 0.1, total: 1.4 }, threads: 1, version: "0.4.0",
            },
            materials: ["glass", "steel", "ground"], bodies, shapes, frames, blocks, thinned: 10, steps: this.steps(),
        };
    }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const [kind, n, count, page, expected] = process.argv.slice(2), run = new Synthetic(kind, Number(n), Number(count));
    const { meta, blocks } = run.make();
    writeFileSync(page, assemble(meta, blocks));
    const last = run.frames - 1, positions = Array.from({ length: run.n }, (_, i) => run.place(i, 1));
    if (expected) writeFileSync(expected, JSON.stringify({ frame: last, positions }));
}
