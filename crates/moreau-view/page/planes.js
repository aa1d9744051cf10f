// Half-spaces and half-planes: a faint grid, or a line with the solid half hinted at below.

class Planes {
    constructor(gl, run) {
        this.gl = gl;
        this.program = new Program(gl, PLANE, run.dimension === 2);
        this.nothing = gl.createVertexArray();
        this.planes = [];
        run.bodies.shape.forEach((s, body) => {
            const given = run.meta.shapes[s].plane;
            if (!given) return;
            const normal = unit([given[0], given[1], given[2] ?? 0]);
            const [along, across] = run.dimension === 2 ? [[normal[1], -normal[0], 0], normal] : tangents(normal);
            this.planes.push({ body, normal, along, across });
        });
    }

    draw(set, middle, radius, flat) {
        if (!this.planes.length) return;
        const { gl, program } = this;
        set(program.use());
        program.vector("middle", middle);
        program.number("reach", (flat ? 40 : 2.2) * radius);
        program.number("spacing", roundUp(radius / 5));
        gl.enable(gl.BLEND);
        gl.depthMask(false);
        gl.bindVertexArray(this.nothing);
        for (const { body, normal, along, across } of this.planes) {
            program.integer("body", body);
            program.vector("normal", normal);
            program.vector("along", along);
            program.vector("across", across);
            gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
        }
        gl.depthMask(true);
        if (!flat) gl.disable(gl.BLEND);
    }
}
