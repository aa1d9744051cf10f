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
        const n = polygon.length > 2 ? unit(areaNormal(points.map((p) => sub(p, points[0])))) : [0, 0, 1];
        for (let k = 1; k + 1 < points.length; k++) {
            corners.push(...points[0], ...points[k], ...points[k + 1]);
            normals.push(...n, ...n, ...n);
        }
        polygon.forEach((i, k) => {
            const j = polygon[(k + 1) % polygon.length], key = i < j ? `${i} ${j}` : `${j} ${i}`;
            if (!edges.has(key)) edges.set(key, { i, j, normals: [] });
            if (polygon.length > 2) edges.get(key).normals.push(n);
        });
    }
    const lines = [];
    for (const { i, j, normals: [first, second] } of edges.values())
        if (!first || !second || dot(first, second) < SHARP) lines.push(...space[i], ...space[j]);
    return { corners, normals, lines };
}

/**
 * What to draw for all bodies with polygons: `parts`, each with typed arrays `corners`, `normals`, `lines`, and `bodies`. Many bodies of
 * one shape are instances of it; bodies of rare shapes lie together in one part, where each vertex has its body.
 */
function meshParts(run) {
    const { shapes, bodies } = run.meta, users = shapes.map(() => []);
    bodies.shape.forEach((s, i) => users[s].push(i));
    const parts = [], rest = { corners: [], normals: [], lines: [], cornerBodies: [], lineBodies: [] };
    shapes.forEach((shape, s) => {
        if (!shape.polygons || !users[s].length) return;
        const { corners, normals, lines } = facets(shape);
        if (users[s].length * corners.length > 3e5 || users[s].length > 16) {
            parts.push({ ...typed({ corners, normals, lines }), bodies: Int32Array.from(users[s]) });
            return;
        }
        for (const body of users[s]) {
            for (const x of corners) rest.corners.push(x);
            for (const x of normals) rest.normals.push(x);
            for (const x of lines) rest.lines.push(x);
            for (let k = 0; k < corners.length; k += 3) rest.cornerBodies.push(body);
            for (let k = 0; k < lines.length; k += 3) rest.lineBodies.push(body);
        }
    });
    if (rest.lines.length || rest.corners.length)
        parts.push({ ...typed(rest), cornerBodies: Int32Array.from(rest.cornerBodies), lineBodies: Int32Array.from(rest.lineBodies) });
    return parts;
}

const typed = ({ corners, normals, lines }) => ({
    corners: new Float32Array(corners), normals: new Float32Array(normals), lines: new Float32Array(lines),
});
