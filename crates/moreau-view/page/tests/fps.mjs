// Frames per second and seconds to open, drawn in software: node fps.mjs [BODIES ...]. Says what the machine can do, and passes or fails nothing.

import { mkdtempSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { tmpdir } from "node:os";
import { assemble } from "./assemble.mjs";
import { launch, open } from "./browser.mjs";
import { Synthetic } from "./synthetic.mjs";

const sizes = process.argv.slice(2).map(Number), folder = mkdtempSync(join(tmpdir(), "moreau-"));
const browser = await launch();
console.log("bodies   MB  open s  playing  with forces  by speed   (frames per second at 1280 x 720)");
for (const n of sizes.length ? sizes : [2000, 20000, 50000]) {
    const { meta, blocks } = new Synthetic("balls", n, n > 10000 ? 6 : 30).make(), path = join(folder, `${n}.html`);
    writeFileSync(path, assemble(meta, blocks));
    const { page, complaints, seconds } = await open(browser, path);
    const rate = async () => {
        await page.evaluate(async () => {
            const { moreau } = window, { playback } = moreau.page;
            await moreau.setFrame(0);
            playback.rate = 0.02;
            moreau.play();
        });
        await page.waitForTimeout(3000);
        const before = await page.evaluate(() => [window.moreau.framesDrawn(), performance.now()]);
        await page.waitForTimeout(4000);
        const after = await page.evaluate(() => [window.moreau.framesDrawn(), performance.now()]);
        return ((after[0] - before[0]) / (after[1] - before[1])) * 1000;
    };
    const playing = await rate();
    await page.evaluate(() => window.moreau.forces(true));
    const forces = await rate();
    await page.evaluate(() => (window.moreau.forces(false), window.moreau.colourBy("speed")));
    const speed = await rate();
    const cells = [n, (statSync(path).size / 1e6).toFixed(1), seconds.toFixed(2), ...[playing, forces, speed].map((x) => x.toFixed(1))];
    console.log(cells.map((x, i) => String(x).padStart([6, 5, 7, 8, 12, 9][i])).join(" "), complaints.join("\n"));
    await page.close();
}
await browser.close();
