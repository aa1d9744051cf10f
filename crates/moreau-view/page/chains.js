// Contacts as ribbons between the bodies that touch, as wide as the normal impulse is great. Ends at bodies that do not move are at the
// point of contact. What the run wrote of the contacts is sent as it is.

class Chains {
    constructor(gl, run) {
        this.gl = gl;
        this.run = run;
        this.program = new Program(gl, CHAIN, run.dimension === 2);
        this.array = gl.createVertexArray();
        this.buffer = gl.createBuffer();
        this.room = 0;
        this.count = 0;
        this.colours = new Float32Array(STATUS_COLOURS.flatMap(fractions));
        this.widest = this.medianRadius() * 0.55;
        this.reference = 1;
    }

    medianRadius() {
        const { radius, free } = this.run.bodies;
        const sizes = Float64Array.from(radius.filter((r, i) => r > 0 && free[i])).sort();
        return sizes.length ? sizes[sizes.length >> 1] : 0.05;
    }

    /** Takes the contacts of a frame. The greatest width stands for four times the mean normal impulse. */
    send(frame) {
        const { gl, run } = this, D = run.dimension, m = frame.contacts;
        this.count = m;
        let sum = 0, pressed = 0;
        for (let k = 0; k < m; k++) {
            if (frame.status[k] === 0) continue;
            for (let i = D * k; i < D * (k + 1); i++) sum += frame.impulse[i] * frame.normal[i];
            pressed++;
        }
        this.reference = pressed ? Math.max((4 * sum) / pressed, 1e-30) : 1;
        if (!m) return;
        gl.bindVertexArray(this.array);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
        if (frame.contactBytes.length > this.room) {
            this.room = Math.ceil(1.5 * frame.contactBytes.length);
            gl.bufferData(gl.ARRAY_BUFFER, this.room, gl.DYNAMIC_DRAW);
        }
        gl.bufferSubData(gl.ARRAY_BUFFER, 0, frame.contactBytes);
        gl.vertexAttribIPointer(0, 1, gl.UNSIGNED_INT, 0, 0);
        gl.vertexAttribIPointer(1, 1, gl.UNSIGNED_INT, 0, 4 * m);
        for (let i = 0; i < 3; i++) gl.vertexAttribPointer(2 + i, D, gl.FLOAT, false, 0, 8 * m + 4 * D * m * i);
        gl.vertexAttribIPointer(5, 1, gl.UNSIGNED_BYTE, 0, 12 * m + 12 * D * m);
        for (let i = 0; i < 6; i++) {
            gl.enableVertexAttribArray(i);
            gl.vertexAttribDivisor(i, 1);
        }
        gl.bindVertexArray(null);
    }

    draw(set, chosen) {
        if (!this.count) return;
        const { gl, program } = this;
        set(program.use());
        program.integer("chosen", chosen);
        program.vector("statusColours", this.colours);
        program.number("widest", this.widest);
        program.number("reference", this.reference);
        gl.bindVertexArray(this.array);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.count);
    }
}
