// Contacts as ribbons between the bodies that touch, as wide as the normal impulse is great. Ends at bodies that do not move are at the
// point of contact. What the run wrote of the contacts is sent as it is. Nothing is drawn by instances: where processors draw, an instance
// costs more than its corners.

/** Words in a row of the texture of contacts; the program knows it too. */
const CONTACT_ROW = 4096;

class Chains {
    constructor(gl, run) {
        this.gl = gl;
        this.run = run;
        this.program = new Program(gl, CHAIN, run.dimension === 2);
        this.nothing = gl.createVertexArray();
        this.count = 0;
        this.colours = new Float32Array(STATUS_COLOURS.flatMap(fractions));
        this.widest = this.medianRadius() * 0.4;
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
        if (!(frame.contactWords.length <= this.texture?.room)) {
            if (this.texture) gl.deleteTexture(this.texture.texture);
            this.texture = new ArrayTexture(gl, Math.ceil(1.5 * frame.contactWords.length), 1, CONTACT_ROW, true);
        }
        this.texture.send(frame.contactWords);
    }

    draw(set, chosen) {
        if (!this.count) return;
        const { gl, program } = this;
        set(program.use());
        program.integer("chosen", chosen);
        program.vector("statusColours", this.colours);
        program.number("widest", this.widest);
        program.number("reference", this.reference);
        program.integer("count", this.count);
        gl.activeTexture(gl.TEXTURE0 + 7);
        gl.bindTexture(gl.TEXTURE_2D, this.texture.texture);
        program.integer("contacts", 7);
        gl.bindVertexArray(this.nothing);
        gl.drawArrays(gl.TRIANGLES, 0, 6 * this.count);
    }
}
