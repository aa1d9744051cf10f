// The programs of the graphics card. Places and turns of all bodies are in textures, two frames of them, and are mixed there: while
// a run plays between two frames nothing is sent.

const COMMON = `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform mat4 view, projection;
uniform vec3 ground, line, still, faint, mark;
uniform float pixel, fade;
#ifdef FLAT
const bool flatScene = true;
#else
const bool flatScene = false;
#endif
// Metres in a pixel where the eye sees z.
float pixelAt(float z) { return flatScene ? pixel : -z * pixel; }
vec3 lit(vec3 tint, vec3 n) {
    if (flatScene) return tint;
    float key = max(dot(n, vec3(-0.37, 0.66, 0.65)), 0.0);
    return tint * (0.52 + 0.12 * n.y + 0.48 * key) + vec3(0.05) * pow(key, 12.0);
}`;

const BODIES = `
uniform sampler2D placesA, placesB, turnsA, turnsB, values, facts, ramp;
uniform float blend, low, high;
uniform int chosen;
ivec2 cell(int i) { return ivec2(i & 1023, i >> 10); }
// Of NaN and infinity; comparisons with NaN may be optimised away.
bool absent(vec3 p) { return (floatBitsToUint(p.x) & 0x7f800000u) == 0x7f800000u; }
vec3 place(int i) {
    vec3 a = texelFetch(placesA, cell(i), 0).xyz, b = texelFetch(placesB, cell(i), 0).xyz;
    return absent(b) ? a : mix(a, b, blend);
}
vec4 attitude(int i) {
    vec4 a = texelFetch(turnsA, cell(i), 0), b = texelFetch(turnsB, cell(i), 0);
    if (absent(b.xyz)) return a;
    if (flatScene) return vec4(normalize(mix(a.xy, b.xy, blend)), 0.0, 0.0);
    return normalize(mix(a, dot(a, b) < 0.0 ? -b : b, blend));
}
vec3 turned(vec4 q, vec3 v) {
    if (flatScene) return vec3(q.x * v.x - q.y * v.y, q.y * v.x + q.x * v.y, v.z);
    vec3 t = 2.0 * cross(q.xyz, v);
    return v + q.w * t + cross(q.xyz, t);
}
vec3 turnedBack(vec4 q, vec3 v) { return turned(flatScene ? vec4(q.x, -q.y, 0.0, 0.0) : vec4(-q.xyz, q.w), v); }
bool isFree(int i) { return texelFetch(facts, cell(i), 0).y > 0.5; }
vec3 tintOf(int i) {
    if (i == chosen) return mark;
    if (!isFree(i)) return mix(still, faint, fade);
    float value = (texelFetch(values, cell(i), 0).x - low) / (high - low);
    vec3 tint = texelFetch(ramp, ivec2(int(clamp(value, 0.0, 1.0) * 255.0 + 0.5), 0), 0).rgb;
    return mix(tint, faint, fade);
}`;

const NOWHERE = "gl_Position = vec4(2.0, 2.0, 2.0, 1.0);";

const BALL = {
    vertex: `
layout(location = 0) in int body;
layout(location = 1) in float size;
flat out vec3 centre, tint;
flat out vec4 q;
flat out float r;
out vec3 seen;
void main() {
    vec3 p = place(body);
    if (absent(p)) { ${NOWHERE} return; }
    // Corners of the smallest triangle around the circle of radius 1.
    int k = gl_VertexID % 3;
    vec2 corner = k == 0 ? vec2(0.0, 2.0) : vec2(k == 1 ? -1.7320509 : 1.7320509, -1.0);
    q = attitude(body);
    tint = tintOf(body);
    centre = (view * vec4(p, 1.0)).xyz;
    r = max(size, 0.6 * pixelAt(centre.z));
    float far = length(centre), wide = r + pixelAt(centre.z);
    vec3 u = vec3(1, 0, 0), v = vec3(0, 1, 0);
    if (!flatScene) {
        u = normalize(cross(centre, vec3(0, 1, 0)));
        v = cross(u, centre) / far;
        wide *= far / sqrt(max(far * far - r * r, 1e-6 * far * far));
    }
    seen = centre + wide * (corner.x * u + corner.y * v);
    gl_Position = projection * vec4(seen, 1.0);
}`,
    fragment: `
flat in vec3 centre, tint;
flat in vec4 q;
flat in float r;
in vec3 seen;
uniform float smoothEdges;
out vec4 colour;
void main() {
    float px = pixelAt(centre.z) / r;
    if (flatScene) {
        vec2 x = (seen.xy - centre.xy) / r;
        float inside = clamp((1.0 - length(x)) / px + 0.5, 0.0, 1.0);
        if (inside <= 0.0) discard;
        vec2 y = turnedBack(q, vec3(x, 0.0)).xy;
        float sector = smoothstep(-px, px, y.x * y.y) * smoothstep(6.0, 12.0, 2.0 / px);
        float rim = smoothstep(1.0 - 2.5 * px, 1.0 - 1.0 * px, length(x));
        colour = vec4(mix(tint * (1.0 - 0.16 * sector), mix(line, ground, 0.75 * fade), 0.55 * rim), inside);
        return;
    }
    vec3 d = normalize(seen);
    float along = dot(d, centre);
    float beside = length(centre - along * d) / r;
    float inside = clamp((1.0 - beside) / px + 0.5, 0.0, 1.0);
    if (inside <= 0.5 - 0.5 * smoothEdges) discard;
    float depth = sqrt(max(1.0 - beside * beside, 0.0));
    vec3 hit = d * (along - r * depth);
    vec3 n = normalize(hit - centre);
    // A belt and a spot in the body's frame, so that its spin is seen.
    vec3 m = turnedBack(q, n * mat3(view));
    float soft = max(0.03, 1.5 * px);
    float belt = 1.0 - smoothstep(0.2 - soft, 0.2 + soft, abs(m.z));
    float spot = smoothstep(0.88 - soft, 0.88 + soft, m.z);
    float marked = max(belt, spot) * smoothstep(4.0, 9.0, 1.0 / px);
    vec3 painted = tint * (1.0 - 0.3 * marked);
    colour = vec4(lit(painted, n) * mix(0.6, 1.0, smoothstep(0.0, 0.5, depth)), inside);
    float z = projection[2][2] * hit.z + projection[3][2];
    gl_FragDepth = 0.5 + 0.5 * z / -hit.z;
}`,
};

const MESH = {
    vertex: `
layout(location = 0) in int body;
layout(location = 1) in vec3 corner;
layout(location = 2) in vec3 normal;
flat out vec3 tint;
out vec3 n;
void main() {
    vec3 p = place(body);
    if (absent(p)) { ${NOWHERE} return; }
    vec4 q = attitude(body);
    tint = tintOf(body);
    n = mat3(view) * turned(q, normal);
    gl_Position = projection * (view * vec4(p + turned(q, corner), 1.0));
}`,
    fragment: `
flat in vec3 tint;
in vec3 n;
out vec4 colour;
void main() {
    colour = vec4(lit(tint, normalize(n) * (gl_FrontFacing ? 1.0 : -1.0)), 1.0);
}`,
};

const EDGE = {
    vertex: `
layout(location = 0) in int body;
layout(location = 1) in vec3 corner;
flat out vec3 tint;
void main() {
    vec3 p = place(body);
    if (absent(p)) { ${NOWHERE} return; }
    tint = flatScene ? mix(line, ground, 0.75 * fade) : 0.45 * tintOf(body);
    gl_Position = projection * (view * vec4(p + turned(attitude(body), corner), 1.0));
    gl_Position.z -= 3e-4 * gl_Position.w; // in front of its faces
}`,
    fragment: `
flat in vec3 tint;
uniform float strength;
out vec4 colour;
void main() { colour = vec4(tint, strength); }`,
};
