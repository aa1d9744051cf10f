// The page as a server shows it, of a run that goes on: node served.mjs. The server here stands for the program's.

import { createServer } from "node:http";
import { deflateSync } from "node:zlib";
import assert from "node:assert/strict";
import { assemble } from "./assemble.mjs";
import { launch } from "./browser.mjs";
import { Synthetic } from "./synthetic.mjs";

const { meta, blocks } = new Synthetic("mixed", 60, 12).make(), raw = blocks[0], orders = [], unexpected = [];
let there = 4;

/** The run as it is when `there` frames are. */
function now() {
    const upTo = (columns, k) => Object.fromEntries(Object.entries(columns).map(([name, column]) => [name, column.slice(0, k)]));
    return { ...meta, live: there < 12, frames: upTo(meta.frames, there), blocks: [{ first: 0, frames: there }], steps: upTo(meta.steps, 80 * there) };
}

/** The bytes of the frames that are there. */
function block() {
    const { n, D } = { n: meta.bodies.radius.length, D: meta.dimension };
    const body = 4 * n * (2 * D + 7), contact = (m) => 4 * m * (3 + 3 * D) + 4 * Math.ceil(m / 4);
    return deflateSync(raw.subarray(0, meta.frames.contacts.slice(0, there).reduce((sum, m) => sum + body + contact(m), 0)));
}

const server = createServer((request, answer) => {
    const name = `${request.method} ${request.url}`;
    if (name === "GET /key/") return answer.setHeader("content-type", "text/html").end(assemble(null));
    if (name === "GET /key/meta.json") return answer.end(JSON.stringify(now()));
    if (name === "GET /key/block/0") return answer.end(block());
    if (name === "POST /key/control") return request.on("data", (text) => orders.push(String(text))).on("end", () => answer.end());
    unexpected.push(name);
    return answer.writeHead(404).end();
});
await new Promise((listening) => server.listen(0, "127.0.0.1", listening));

const browser = await launch();
try {
    const page = await browser.newPage(), complaints = [];
    page.on("console", (message) => ["error", "warning"].includes(message.type()) && complaints.push(message.text()));
    page.on("pageerror", (error) => complaints.push(error.stack));
    await page.goto(`http://127.0.0.1:${server.address().port}/key/`);
    await page.waitForFunction(() => window.moreau);
    await page.evaluate(() => window.moreau.ready);
    assert.ok(await page.locator("#live").isVisible());
    for (const word of ["pause", "step", "resume"]) await page.click(`#live button[value=${word}]`);
    there = 8;
    await page.waitForFunction(() => window.moreau.frames() === 8 && window.moreau.frame() === 7, null, { timeout: 20000 });
    await page.evaluate(() => window.moreau.setFrame(2));
    there = 12;
    await page.waitForFunction(() => document.querySelector("#live-state").textContent === "ended", null, { timeout: 20000 });
    assert.equal(await page.evaluate(() => window.moreau.frame()), 2, "somebody who looks at a frame is left there");
    await page.evaluate(() => window.moreau.setFrame(11));
    assert.ok(await page.evaluate(() => Number.isFinite(window.moreau.position(5)[2])));
    assert.deepEqual(orders, ["pause", "step", "resume"]);
    assert.deepEqual([complaints, unexpected], [[], []]);
    console.log("ok");
} finally {
    await browser.close();
    server.close();
}
