// Draws balls and bodies with polygons, all of one kind with one call. A ball is a triangle in which its sphere is found pixel by pixel.

class Bodies {
    constructor(gl, run) {
        this.gl = gl;
        this.flat = run.dimension === 2;
        this.ball = new Program(gl, BALL, this.flat);
        this.mesh = new Program(gl, MESH, this.flat);
        this.edge = new Program(gl, EDGE, this.flat);
        this.makeBalls(run);
        this.parts = meshParts(run).map((part) => this.makePart(part));
    }

    makeBalls(run) {
        const { gl } = this, { shapes, bodies } = run.meta;
        const index = [], radius = [];
        bodies.shape.forEach((s, i) => {
            if (!shapes[s].ball) return;
            index.push(i, i, i);
            radius.push(shapes[s].ball, shapes[s].ball, shapes[s].ball);
        });
        this.balls = gl.createVertexArray();
        this.ballCorners = index.length;
        gl.bindVertexArray(this.balls);
        attribute(gl, 0, Int32Array.from(index), 1, 0);
        attribute(gl, 1, Float32Array.from(radius), 1, 0);
        gl.bindVertexArray(null);
    }

    makePart({ corners, normals, lines, bodies, cornerBodies, lineBodies }) {
        const { gl } = this, step = bodies ? 1 : 0;
        const part = { instances: bodies?.length ?? 0, corners: corners.length / 3, lineEnds: lines.length / 3 };
        part.faces = gl.createVertexArray();
        gl.bindVertexArray(part.faces);
        attribute(gl, 0, bodies ?? cornerBodies, 1, step);
        attribute(gl, 1, corners, 3, 0);
        attribute(gl, 2, normals, 3, 0);
        part.edges = gl.createVertexArray();
        gl.bindVertexArray(part.edges);
        attribute(gl, 0, bodies ?? lineBodies, 1, step);
        attribute(gl, 1, lines, 3, 0);
        gl.bindVertexArray(null);
        return part;
    }

    drawPart(mode, array, count, instances) {
        if (!count) return;
        this.gl.bindVertexArray(array);
        if (instances) this.gl.drawArraysInstanced(mode, 0, count, instances);
        else this.gl.drawArrays(mode, 0, count);
    }

    /** Draws all; `set` hands a program what all programs need. */
    draw(set, smooth) {
        const { gl } = this;
        if (this.parts.length) {
            set(this.mesh.use());
            for (const part of this.parts) this.drawPart(gl.TRIANGLES, part.faces, part.corners, part.instances);
        }
        if (this.ballCorners) {
            set(this.ball.use());
            this.ball.number("smoothEdges", smooth ? 1 : 0);
            if (smooth && !this.flat) gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE);
            this.drawPart(gl.TRIANGLES, this.balls, this.ballCorners, 0);
            gl.disable(gl.SAMPLE_ALPHA_TO_COVERAGE);
        }
        if (this.parts.length) {
            set(this.edge.use());
            this.edge.number("strength", this.flat ? 0.9 : 0.55);
            gl.enable(gl.BLEND);
            for (const part of this.parts) this.drawPart(gl.LINES, part.edges, part.lineEnds, part.instances);
            if (!this.flat) gl.disable(gl.BLEND);
        }
    }
}
