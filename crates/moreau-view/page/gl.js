// WebGL 2 in few words: programs with their uniforms, buffers with their attributes, and arrays of all bodies in textures.

/** Bodies in a row of a texture; the programs know it too. */
const ROW = 1024;

class Program {
    constructor(gl, source, flat, withBodies = true) {
        const head = `#version 300 es\n${flat ? "#define FLAT\n" : ""}${COMMON}${withBodies ? BODIES : ""}`;
        this.gl = gl;
        this.program = gl.createProgram();
        this.shaders = [];
        for (const [kind, text] of [[gl.VERTEX_SHADER, source.vertex], [gl.FRAGMENT_SHADER, source.fragment]]) {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, head + text);
            gl.compileShader(shader);
            gl.attachShader(this.program, shader);
            this.shaders.push(shader);
        }
        gl.linkProgram(this.program);
    }

    /** What waits for the compiler is left until a program is needed, so that all are compiled beside each other. */
    finish() {
        const { gl } = this;
        if (!gl.getProgramParameter(this.program, gl.LINK_STATUS)) {
            const notes = this.shaders.map((shader) => gl.getShaderInfoLog(shader)).join("\n");
            throw new Error(`${gl.getProgramInfoLog(this.program)}\n${notes}`);
        }
        this.places = {};
        const count = gl.getProgramParameter(this.program, gl.ACTIVE_UNIFORMS);
        for (let i = 0; i < count; i++) {
            const name = gl.getActiveUniform(this.program, i).name;
            this.places[name.replace("[0]", "")] = gl.getUniformLocation(this.program, name);
        }
    }

    use() {
        if (!this.places) this.finish();
        this.gl.useProgram(this.program);
        return this;
    }

    number(name, x) {
        if (this.places[name]) this.gl.uniform1f(this.places[name], x);
    }

    integer(name, x) {
        if (this.places[name]) this.gl.uniform1i(this.places[name], x);
    }

    vector(name, v) {
        if (this.places[name]) this.gl.uniform3fv(this.places[name], v);
    }

    matrix(name, m) {
        if (this.places[name]) this.gl.uniformMatrix4fv(this.places[name], false, m);
    }
}

/** A long array in a texture with rows of `row` texels, each of `parts` floats or of one whole number. */
class ArrayTexture {
    constructor(gl, length, parts, row = ROW, whole = false) {
        Object.assign(this, { gl, parts, row, room: length });
        this.format = whole ? gl.RED_INTEGER : [gl.RED, gl.RG, gl.RGB, gl.RGBA][parts - 1];
        this.type = whole ? gl.UNSIGNED_INT : gl.FLOAT;
        this.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        const inside = whole ? gl.R32UI : [gl.R32F, gl.RG32F, gl.RGB32F, gl.RGBA32F][parts - 1];
        gl.texStorage2D(gl.TEXTURE_2D, 1, inside, row, Math.ceil((length + 1) / row));
        for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    }

    /** Sends the numbers as they are; the last row is a part of one. */
    send(numbers) {
        const { gl, parts, row, format, type } = this, length = numbers.length / parts;
        const rows = Math.floor(length / row), rest = length % row;
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        if (rows) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, row, rows, format, type, numbers, 0);
        if (rest) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, rows, rest, 1, format, type, numbers, rows * row * parts);
    }
}

/** A texture of 256 colours. */
function colourTexture(gl, colours) {
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, colours);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    return texture;
}

/** Puts an array into a new buffer that feeds an attribute of `parts` numbers, by vertex or (`step` 1) by instance. */
function attribute(gl, index, array, parts, step) {
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, array, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(index);
    if (array instanceof Int32Array) gl.vertexAttribIPointer(index, parts, gl.INT, 0, 0);
    else gl.vertexAttribPointer(index, parts, gl.FLOAT, false, 0, 0);
    gl.vertexAttribDivisor(index, step);
}
