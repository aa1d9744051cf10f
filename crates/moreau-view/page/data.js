// The run: its meta data, and blocks of frames that are decoded when they are needed and forgotten when they are many.

/** Decoded bytes that are kept; at least three blocks are, so that the next one can be decoded ahead. */
const KEPT_BYTES = 384 * 1024 * 1024;

/** Reads the meta data that the page holds or, where it holds none, that the server has. */
async function readMeta() {
    const held = document.getElementById("meta");
    if (held) return JSON.parse(held.textContent);
    for (;;) {
        const answer = await fetch("meta.json", { cache: "no-store" });
        if (answer.ok) return answer.json();
        // A run that has just begun has nothing yet, and a file that grows can be met half-way.
        if (answer.status !== 503) throw new Error(`the server says ${answer.status}: ${await answer.text()}`);
        await new Promise((later) => setTimeout(later, 300));
    }
}

/** Arrays of one frame, as views of its block's bytes from `offset` on; `end` is where the next frame begins. */
function frameAt(buffer, offset, n, m, dimension) {
    let at = offset;
    const floats = (count) => {
        const view = new Float32Array(buffer, at, count);
        at += 4 * count;
        return view;
    };
    const indices = (count) => {
        const view = new Uint32Array(buffer, at, count);
        at += 4 * count;
        return view;
    };
    const frame = {
        position: floats(n * dimension),
        rotation: floats(n * (dimension === 3 ? 4 : 2)),
        velocity: floats(n * dimension),
        spin: floats(n * (dimension === 3 ? 3 : 1)),
        contacts: m,
    };
    frame.motion = new Uint8Array(buffer, at, n); // 0 absent, 1 held or driven, 2 free
    at += 4 * Math.ceil(n / 4);
    const start = at;
    Object.assign(frame, {
        a: indices(m), b: indices(m), point: floats(m * dimension), normal: floats(m * dimension),
        impulse: floats(m * dimension), gap: floats(m), status: new Uint8Array(buffer, at, m),
    });
    at += 4 * Math.ceil(m / 4);
    frame.contactWords = new Uint32Array(buffer, start, (at - start) / 4);
    frame.end = at;
    return frame;
}

class Run {
    constructor(meta, served) {
        this.served = served;
        this.dimension = meta.dimension;
        this.bodies = meta.bodies;
        this.n = meta.bodies.radius.length;
        this.blocks = new Map(); // in the order of their last use
        this.pending = new Map();
        this.decoder = new Decoder();
        this.renew(meta);
    }

    /** Takes newer meta data of the same run. */
    renew(meta) {
        this.meta = meta;
        this.times = meta.frames.time;
        this.firsts = meta.blocks.map((block) => block.first);
        for (const [k, frames] of this.blocks) if (meta.blocks[k].frames !== frames.length) this.blocks.delete(k);
    }

    get frames() {
        return this.times.length;
    }

    blockOf(i) {
        return lastBelow(this.firsts, i);
    }

    /** Frame `i` if it is decoded. */
    decoded(i) {
        const k = this.blockOf(i), frames = this.blocks.get(k);
        if (!frames) return null;
        this.blocks.delete(k);
        this.blocks.set(k, frames);
        return frames[i - this.firsts[k]] ?? null;
    }

    /** Frame `i`, decoded now if it has to be. */
    async frame(i) {
        await this.block(this.blockOf(i));
        return this.decoded(i);
    }

    /** Has the block of frame `i` decoded in a while. */
    ahead(i) {
        if (i >= this.frames) return;
        const k = this.blockOf(i);
        if (!this.blocks.has(k)) this.block(k).catch(tell);
    }

    block(k) {
        if (this.blocks.has(k)) return this.blocks.get(k);
        if (!this.pending.has(k)) this.pending.set(k, this.decode(k).finally(() => this.pending.delete(k)));
        return this.pending.get(k);
    }

    async decode(k) {
        const { first, frames: count } = this.meta.blocks[k];
        const packed = await packedBlock(k, this.served);
        // The first block is waited for in any case, and a thread takes a while to start.
        const buffer = await (this.blocks.size ? this.decoder.unpack(packed) : unpacked(packed));
        const frames = [];
        for (let i = 0, offset = 0; i < count; i++) {
            frames.push(frameAt(buffer, offset, this.n, this.meta.frames.contacts[first + i], this.dimension));
            offset = frames[i].end;
        }
        this.blocks.set(k, frames);
        this.forget(buffer.byteLength);
    }

    /** Drops the blocks that were not used for longest. */
    forget(newest) {
        const kept = Math.max(3, Math.floor(KEPT_BYTES / Math.max(newest, 1)));
        for (const k of this.blocks.keys()) {
            if (this.blocks.size <= kept) break;
            this.blocks.delete(k);
        }
    }
}
