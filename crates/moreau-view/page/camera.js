// Where the picture is seen from. In space the camera goes around a target; in the plane it looks along z and only shifts and zooms.

const SLOPE = Math.tan((32 * Math.PI) / 360);

class Camera {
    constructor(dimension, gravity) {
        this.flat = dimension === 2;
        const g = [gravity[0] ?? 0, gravity[1] ?? 0, gravity[2] ?? 0];
        this.up = this.flat ? [0, 1, 0] : norm(g) > 0 ? unit(scale(g, -1)) : [0, 0, 1];
        [this.east, this.north] = tangents(this.up);
        this.aspect = 1;
        this.touched = false;
        this.face();
        this.fit([0, 0, 0], 1, [1, 1, 1]);
    }

    /** Shows the box around `target` that is `half` to each side; `radius` is the size of all that is there. */
    fit(target, radius, half) {
        this.home = { target, radius, half };
        this.target = target;
        this.radius = radius;
        this.distance = 1;
        this.update();
        let need = 0;
        for (let k = 0; k < 8; k++) {
            const corner = half.map((x, i) => ((k >> i) & 1 ? x : -x)), beside = dot(corner, this.right) / this.aspect;
            const near = this.flat ? 0 : dot(corner, this.back);
            need = Math.max(need, near + Math.max(Math.abs(beside), Math.abs(dot(corner, this.above))) / SLOPE);
        }
        this.distance = 1.14 * need || 1;
        this.update();
    }

    /** Turns to where a run is first seen from. */
    face() {
        this.azimuth = this.flat ? 0 : -0.6;
        this.elevation = this.flat ? 0 : 0.32;
    }

    refit() {
        this.touched = false;
        this.fit(this.home.target, this.home.radius, this.home.half);
    }

    update() {
        const { azimuth: a, elevation: e } = this;
        const level = add(scale(this.east, Math.sin(a)), scale(this.north, -Math.cos(a)));
        this.back = this.flat ? [0, 0, 1] : unit(add(scale(level, Math.cos(e)), scale(this.up, Math.sin(e))));
        this.right = this.flat ? [1, 0, 0] : unit(cross(this.up, this.back));
        this.above = cross(this.back, this.right);
        this.eye = add(this.target, scale(this.back, this.distance));
        this.view = viewMatrix(this.right, this.above, this.back, this.eye);
        const near = this.flat ? -1e3 * this.radius : Math.max(this.distance - 8 * this.radius, 0.02 * this.distance);
        const far = this.distance + (this.flat ? 1e3 : 12) * this.radius;
        this.projection = this.flat
            ? parallel(this.distance * SLOPE, this.aspect, near, far)
            : perspective(SLOPE, this.aspect, near, far);
        this.matrix = product(this.projection, this.view);
    }

    /** A metre at the target, in parts of the picture's height. */
    get heightOfMetre() {
        return 1 / (2 * SLOPE * this.distance);
    }

    orbit(dx, dy) {
        this.touched = true;
        this.azimuth -= 5 * dx;
        this.elevation = clamp(this.elevation + 4 * dy, -1.55, 1.55);
        this.update();
    }

    /** Moves what is seen by parts of the picture's height. */
    pan(dx, dy) {
        this.touched = true;
        const s = 1 / this.heightOfMetre;
        this.target = add(this.target, add(scale(this.right, -dx * s), scale(this.above, dy * s)));
        this.update();
    }

    /** Comes nearer by a factor; the point at x, y (from -1 to 1) stays where it is seen. */
    zoom(factor, x, y) {
        this.touched = true;
        const before = this.distance;
        this.distance = clamp(before * factor, 1e-3 * this.radius, 60 * this.radius);
        const s = (before - this.distance) * SLOPE;
        this.target = add(this.target, add(scale(this.right, x * s * this.aspect), scale(this.above, y * s)));
        this.update();
    }

    /** Place in the picture (from -1 to 1, and depth) of a point, or null if it is behind the eye. */
    project(p) {
        const m = this.matrix, row = (i) => m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i];
        const w = row(3);
        return w > 0 ? [row(0) / w, row(1) / w, row(2) / w] : null;
    }

    /** Start and unit direction of what is seen at x, y (from -1 to 1). */
    ray(x, y) {
        const side = add(scale(this.right, x * SLOPE * this.aspect), scale(this.above, y * SLOPE));
        if (this.flat) return [add(this.eye, scale(side, this.distance)), [0, 0, -1]];
        return [this.eye, unit(sub(side, this.back))];
    }
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
