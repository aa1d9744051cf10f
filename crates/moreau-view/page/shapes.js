// Polygons of shapes as triangles and edges, each once for its shape, in the body's frame.

/** Edges whose two faces are nearly in one plane are not drawn: they are the mesh's, not the body's. */
const SHARP = Math.cos((12 * Math.PI) / 180);

/** The normal of a polygon of any number of corners (Newell), of the length of twice its area. */
function areaNormal(corners) {
    let n = [0, 0, 0];
    corners.forEach((p, i) => (n = add(n, cross(p, corners[(i + 1) % corners.length]))));
    return n;
}

/** Triangles as corners and normals, and edges as pairs of corners: plain lists of coordinates. */
function facets(shape) {
    const space = shape.vertices.map((v) => [v[0], v[1], v[2] ?? 0]);
    const corners = [], normals = [], edges = new Map();
    for (const polygon of shape.polygons) {
        const points = polygon.map((i) => space[i]);
        const n = polygon.length > 2 ? unit(areaNormal(points.map((p) => sub(p, points[0])))) : null;
        for (let k = 1; k + 1 < points.length; k++) {
            corners.push(...points[0], ...points[k], ...points[k + 1]);
            normals.push(...n, ...n, ...n);
        }
        polygon.forEach((i, k) => {
            const j = polygon[(k + 1) % polygon.length], key = Math.min(i, j) * space.length + Math.max(i, j);
            // An edge is drawn unless a second face goes on from the first nearly as flat.
            const first = edges.get(key);
            edges.set(key, first && n && dot(first, n) > SHARP ? "flat" : n);
        });
    }
    const lines = [];
    for (const [key, kind] of edges)
        if (kind !== "flat") lines.push(...space[Math.floor(key / space.length)], ...space[key % space.length]);
    return { corners, normals, lines };
}

/** Numbers of coordinates up to which a shape is repeated for each of its bodies. */
const REPEATED = 6e6;

/**
 * What to draw for all bodies with polygons: `parts`, each with typed arrays `corners`, `normals`, `lines`, and whose they are. Shapes lie
 * together in one part, once for each body, and each corner has its body. Only what would be too much is drawn by instances, `bodies`.
 */
function meshParts(run) {
    const { shapes, bodies } = run.meta, users = shapes.map(() => []);
    bodies.shape.forEach((s, i) => users[s].push(i));
    const parts = [], repeated = [];
    let room = REPEATED;
    shapes.forEach((shape, s) => {
        if (!shape.polygons || !users[s].length) return;
        const found = { ...facets(shape), users: users[s] }, need = found.corners.length * users[s].length;
        if (users[s].length > 1 && need > room) return parts.push({ ...typed(found), bodies: Int32Array.from(users[s]) });
        room -= need;
        repeated.push(found);
    });
    if (repeated.length) parts.push(together(repeated));
    return parts;
}

const typed = ({ corners, normals, lines }) => ({
    corners: new Float32Array(corners), normals: new Float32Array(normals), lines: new Float32Array(lines),
});

/** One part of all bodies of some shapes. */
function together(repeated) {
    const length = (name) => repeated.reduce((sum, shape) => sum + shape[name].length * shape.users.length, 0);
    const part = { cornerBodies: new Int32Array(length("corners") / 3), lineBodies: new Int32Array(length("lines") / 3) };
    for (const name of ["corners", "normals", "lines"]) {
        part[name] = new Float32Array(length(name));
        const owner = { corners: part.cornerBodies, lines: part.lineBodies }[name];
        let at = 0;
        for (const shape of repeated)
            for (const body of shape.users) {
                part[name].set(shape[name], at);
                owner?.fill(body, at / 3, (at + shape[name].length) / 3);
                at += shape[name].length;
            }
    }
    return part;
}
