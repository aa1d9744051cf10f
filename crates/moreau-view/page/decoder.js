// From a block's text or bytes, as they were packed, to its numbers.

/** The deflated bytes of block `k`, or where the page holds them their text. */
async function packedBlock(k, served) {
    if (!served) return document.getElementById(`block-${k}`).textContent.trim();
    const answer = await fetch(`block/${k}`, { cache: "no-store" });
    if (!answer.ok) throw new Error(`the server has no block ${k}`);
    return new Uint8Array(await answer.arrayBuffer());
}

/** The bytes of a block. This function must need nothing of the page: the decoder takes its text. */
async function unpacked(packed) {
    let bytes = packed;
    if (typeof packed === "string") {
        const binary = atob(packed);
        bytes = new Uint8Array(binary.length);
        for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
    }
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Response(stream).arrayBuffer();
}

/** Unpacks blocks in a thread beside the page's, so that pictures do not wait; in the page's own where there is no such thread. */
class Decoder {
    constructor() {
        this.waiting = new Map();
        this.asked = 0;
    }

    start() {
        const answer = "async ({ data: [id, packed] }) => { try { const bytes = await unpacked(packed); postMessage([id, bytes], [bytes]); } " +
            "catch (error) { postMessage([id, null, error.message]); } }";
        this.address = URL.createObjectURL(new Blob([`${unpacked}\nonmessage = ${answer};`], { type: "text/javascript" }));
        this.worker = new Worker(this.address);
        this.worker.onmessage = ({ data: [id, bytes, complaint] }) => {
            const { done, failed } = this.waiting.get(id);
            this.waiting.delete(id);
            bytes ? done(bytes) : failed(new Error(complaint));
        };
        this.worker.onerror = () => {
            this.worker = null;
            for (const { packed, done, failed } of this.waiting.values()) unpacked(packed).then(done, failed);
            this.waiting.clear();
        };
    }

    unpack(packed) {
        if (this.worker === undefined) this.start();
        if (!this.worker) return unpacked(packed);
        return new Promise((done, failed) => {
            this.waiting.set(++this.asked, { packed, done, failed });
            this.worker.postMessage([this.asked, packed]);
        });
    }
}
