// Vectors are arrays of three numbers, matrices are column by column as WebGL reads them, quaternions are x, y, z, w.

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const norm = (a) => Math.hypot(a[0], a[1], a[2]);
const unit = (a) => scale(a, 1 / (norm(a) || 1));
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/** Two unit vectors that are normal to `n` and to each other. */
function tangents(n) {
    const t = unit(cross(n, Math.abs(n[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0]));
    return [t, cross(n, t)];
}

/** The vector turned by a unit quaternion. */
function turn(q, v) {
    const t = scale(cross(q, v), 2);
    return add(add(v, scale(t, q[3])), cross(q, t));
}

const opposite = (q) => [-q[0], -q[1], -q[2], q[3]];

/** The product of two 4 by 4 matrices. */
function product(a, b) {
    const c = new Float32Array(16);
    for (let j = 0; j < 4; j++)
        for (let i = 0; i < 4; i++)
            for (let k = 0; k < 4; k++) c[4 * j + i] += a[4 * k + i] * b[4 * j + k];
    return c;
}

/** World to eye, for an eye that looks along minus its third axis. */
function viewMatrix(right, up, back, eye) {
    return new Float32Array([
        right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
        -dot(right, eye), -dot(up, eye), -dot(back, eye), 1,
    ]);
}

/** Eye to clip space; `slope` is the tangent of half the vertical field. */
function perspective(slope, aspect, near, far) {
    const m = new Float32Array(16);
    m[0] = 1 / (slope * aspect);
    m[5] = 1 / slope;
    m[10] = (near + far) / (near - far);
    m[11] = -1;
    m[14] = (2 * near * far) / (near - far);
    return m;
}

/** Eye to clip space without perspective; `half` is half the height that is seen. */
function parallel(half, aspect, near, far) {
    const m = new Float32Array(16);
    m[0] = 1 / (half * aspect);
    m[5] = 1 / half;
    m[10] = 2 / (near - far);
    m[14] = (near + far) / (near - far);
    m[15] = 1;
    return m;
}

/** The index of the last number of a rising list that is not above `x`, at least 0. */
function lastBelow(rising, x) {
    let low = 0, high = rising.length - 1;
    while (low < high) {
        const middle = (low + high + 1) >> 1;
        if (rising[middle] <= x) low = middle;
        else high = middle - 1;
    }
    return low;
}

/** The smallest of 1, 2, 5, 10, 20, ... in any decade that is not below `x`. */
function roundUp(x) {
    if (!(x > 0)) return 1;
    const decade = 10 ** Math.floor(Math.log10(x) + 1e-9);
    return decade * [1, 2, 5, 10].find((step) => step * decade >= x * (1 - 1e-9));
}
