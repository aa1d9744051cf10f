// The programs of planes and of forces.

const PLANE = {
    vertex: `
uniform int body;
uniform vec3 normal, along, across, middle;
uniform float reach;
out vec2 at, off;
void main() {
    vec3 p = place(body);
    if (absent(p)) { ${NOWHERE} return; }
    vec4 q = attitude(body);
    vec3 n = turned(q, normal), t = turned(q, along), s = turned(q, across);
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    // Seen from above the solid half lies behind the line.
    if (flatScene) corner.y = 0.5 * corner.y - 0.5;
    off = corner;
    vec3 foot = middle - n * dot(middle - p, n) + reach * (corner.x * t + corner.y * s);
    at = vec2(dot(foot - p, t), dot(foot - p, s));
    gl_Position = projection * (view * vec4(foot, 1.0));
}`,
    fragment: `
in vec2 at, off;
uniform float spacing, reach;
out vec4 colour;
void main() {
    if (flatScene) {
        float deep = -off.y * reach / pixel;
        float hatch = abs(fract((at.x + at.y) / (10.0 * pixel)) - 0.5) < 0.06 ? 0.2 : 0.0;
        float fill = (0.12 + hatch) * (1.0 - smoothstep(0.0, 60.0, deep));
        colour = vec4(line, deep < 1.6 ? 0.85 : fill);
        return;
    }
    vec2 x = at / spacing;
    vec2 lines = 1.0 - min(abs(fract(x - 0.5) - 0.5) / fwidth(x), 1.0);
    float grid = max(lines.x, lines.y) * (1.0 - smoothstep(0.15, 0.6, max(fwidth(x).x, fwidth(x).y)));
    float fading = 1.0 - smoothstep(0.35, 1.0, length(off));
    float side = gl_FrontFacing ? 1.0 : 0.35;
    colour = vec4(line, fading * side * (0.045 + 0.2 * grid));
}`,
};

const CHAIN = {
    vertex: `
precision highp usampler2D;
uniform usampler2D contacts; // a, b, point, normal, impulse, gap, status of all contacts, one array after the other
uniform int count;
uniform vec3 statusColours[3];
uniform float widest, reference;
flat out vec3 tint;
out float beside;
#ifdef FLAT
const int D = 2;
#else
const int D = 3;
#endif
uint word(int i) { return texelFetch(contacts, ivec2(i & 4095, i >> 12), 0).x; }
// The vector of contact k in the array that is the first, second, ... after the indices of bodies.
vec3 vectorOf(int array, int k) {
    int at = 2 * count + D * (array * count + k);
    return vec3(uintBitsToFloat(word(at)), uintBitsToFloat(word(at + 1)), flatScene ? 0.0 : uintBitsToFloat(word(at + 2)));
}
vec3 end(uint body, vec3 point) {
    vec2 fact = texelFetch(facts, cell(int(body)), 0).xy;
    vec3 p = place(int(body));
    return fact.x > 0.0 && fact.y > 0.5 && !absent(p) ? p : point;
}
void main() {
    int k = gl_VertexID / 6, corner = gl_VertexID % 6;
    if (corner > 2) corner -= 2; // the second triangle, from the second corner on
    vec3 point = vectorOf(0, k);
    uint status = word((3 + 3 * D) * count + (k >> 2)) >> (8 * (k & 3)) & 255u;
    vec3 p = (view * vec4(end(word(k), point), 1.0)).xyz, q = (view * vec4(end(word(count + k), point), 1.0)).xyz;
    bool isChosen = k == chosen;
    float push = dot(vectorOf(2, k), vectorOf(1, k));
    float width = push > 0.0 ? widest * clamp(push / reference, 0.03, 1.3) : 0.0;
    vec3 here = (corner >> 1) == 0 ? p : q;
    width = max(width, (status == 0u ? 0.4 : 0.75) * pixelAt(here.z));
    if (isChosen) width = 1.3 * width + 2.0 * pixelAt(here.z);
    vec3 along = q - p;
    vec3 side = flatScene ? vec3(-along.y, along.x, 0.0) : cross(along, here);
    side /= max(length(side), 1e-30);
    beside = float(corner & 1) * 2.0 - 1.0;
    tint = isChosen ? mark : status == 0u ? mix(statusColours[0], ground, 0.45) : statusColours[status];
    gl_Position = projection * vec4(here + side * beside * width, 1.0);
}`,
    fragment: `
flat in vec3 tint;
in float beside;
out vec4 colour;
void main() { colour = vec4(tint * (0.62 + 0.38 * sqrt(max(1.0 - beside * beside, 0.0))), 1.0); }`,
};
