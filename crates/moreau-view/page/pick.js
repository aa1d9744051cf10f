// What is under the pointer: the nearest body that a ray meets, or the contact whose ribbon is nearest on the screen.

class Picker {
    constructor(picture) {
        this.picture = picture;
        this.run = picture.run;
    }

    /** Where body `i` is shown. */
    position(i, frame = this.picture.frame) {
        const D = this.run.dimension, p = frame.position;
        return [p[D * i], p[D * i + 1], D === 3 ? p[D * i + 2] : 0];
    }

    turnBack(i, v, frame) {
        const q = frame.rotation;
        if (this.run.dimension === 3) return turn(opposite([q[4 * i], q[4 * i + 1], q[4 * i + 2], q[4 * i + 3]]), v);
        const [c, s] = [q[2 * i], q[2 * i + 1]];
        return [c * v[0] + s * v[1], -s * v[0] + c * v[1], v[2]];
    }

    /** The free or fixed body that is seen at x, y (from -1 to 1), or -1. Planes cannot be picked: they are everywhere. */
    body(x, y) {
        const { frame, camera } = this.picture, { radius, shape } = this.run.bodies;
        const [start, direction] = camera.ray(x, y);
        let best = Infinity, found = -1;
        for (let i = 0; i < this.run.n; i++) {
            if (!(radius[i] > 0)) continue;
            const to = sub(this.position(i), start), along = dot(to, direction);
            const beside2 = dot(to, to) - along * along, r = radius[i];
            if (!(beside2 <= r * r) || along + r < 0) continue;
            const figure = this.run.meta.shapes[shape[i]];
            const ball = along - Math.sqrt(r * r - beside2);
            const at = figure.ball ? ball : ball < best ? this.meet(figure, i, start, direction) : Infinity;
            if (at < best) [best, found] = [at, i];
        }
        return found;
    }

    /** How far along a ray the nearest polygon of a body is. */
    meet(figure, i, start, direction) {
        const { frame } = this.picture;
        const o = this.turnBack(i, sub(start, this.position(i)), frame), d = this.turnBack(i, direction, frame);
        let best = Infinity;
        for (const polygon of figure.polygons) {
            const corners = polygon.map((k) => figure.vertices[k]).map((v) => [v[0], v[1], v[2] ?? 0]);
            for (let k = 1; k + 1 < corners.length; k++) best = Math.min(best, crossing(o, d, corners[0], corners[k], corners[k + 1]));
        }
        return best;
    }

    /** Both ends of contact `k` as they are drawn. */
    ends(k) {
        const { frame } = this.picture, { radius, free } = this.run.bodies, D = this.run.dimension;
        const point = [frame.point[D * k], frame.point[D * k + 1], D === 3 ? frame.point[D * k + 2] : 0];
        return [frame.a[k], frame.b[k]].map((i) => (radius[i] > 0 && free[i] ? this.position(i) : point));
    }

    /** The contact whose ribbon passes within `near` of x, y (in pixels of a picture of `width` and `height`), or -1. */
    contact(x, y, width, height, near) {
        const { frame, camera } = this.picture;
        let best = Infinity, found = -1;
        for (let k = 0; k < frame.contacts; k++) {
            const [p, q] = this.ends(k).map((end) => camera.project(end));
            if (!p || !q) continue;
            const px = 0.5 * (1 + p[0]) * width - x, py = 0.5 * (1 - p[1]) * height - y;
            const dx = 0.5 * (q[0] - p[0]) * width, dy = -0.5 * (q[1] - p[1]) * height;
            const t = clamp(-(px * dx + py * dy) / (dx * dx + dy * dy || 1), 0, 1);
            const distance = Math.hypot(px + t * dx, py + t * dy);
            // Of those under the pointer the one in front, the loaded before the open.
            const rank = p[2] + t * (q[2] - p[2]) + (frame.status[k] === 0 ? 1 : 0) + (camera.flat ? distance / near : 0);
            if (distance <= near && rank < best) [best, found] = [rank, k];
        }
        return found;
    }
}

/** How far along a ray a triangle is met, or infinity. */
function crossing(o, d, a, b, c) {
    const e = sub(b, a), f = sub(c, a), h = cross(d, f), det = dot(e, h);
    if (Math.abs(det) < 1e-300) return Infinity;
    const s = sub(o, a), u = dot(s, h) / det, k = cross(s, e), v = dot(d, k) / det;
    const t = dot(f, k) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : Infinity;
}
