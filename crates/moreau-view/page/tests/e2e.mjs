// Drives the page of a report in a browser: node e2e.mjs REPORT.html [EXPECTED.json] [--shots FOLDER]. EXPECTED is { frame, positions }.

import { readFileSync, mkdirSync } from "node:fs";
import assert from "node:assert/strict";
import { launch, open } from "./browser.mjs";

const words = process.argv.slice(2), shots = words.includes("--shots") ? words.splice(words.indexOf("--shots"), 2)[1] : null;
const [report, expected] = words;
if (!report) throw new Error("usage: node e2e.mjs REPORT.html [EXPECTED.json] [--shots FOLDER]");

/** What the page says of itself. */
const ask = (page, text) => page.evaluate(`window.moreau.${text}`);
const settled = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 120)))));

/** The colours of the picture as a browser shows them, to see that something is there and that it changes. */
async function look(page) {
    const box = await page.locator("#picture").boundingBox();
    return page.screenshot({ clip: box });
}

/** Whether the run is one in which bodies can be seen to move. */
const moves = (page, last) => page.evaluate(async (end) => {
    const { run, picture } = window.moreau.page, [a, b] = [(await run.frame(0)).position, (await run.frame(end)).position];
    return a.some((x, i) => Math.abs(x - b[i]) > 0.02 * picture.camera.home.radius);
}, last);

async function plays(page) {
    await ask(page, "setFrame(0)");
    const first = await look(page), last = (await ask(page, "frames()")) - 1;
    await page.selectOption("#rate", await page.evaluate(() => {
        const { times } = window.moreau.page.run, wanted = (times.at(-1) - times[0]) / 2;
        return [...document.querySelectorAll("#rate option")].map((o) => o.value).find((rate) => rate >= wanted) ?? "50";
    }));
    await page.click("#play");
    await page.waitForFunction((i) => window.moreau.frame() === i && !window.moreau.playing(), last, { timeout: 60000 });
    if (await moves(page, last)) assert.notDeepEqual(await look(page), first, "the picture has not changed while the run played");
    return last;
}

async function scrubs(page, last) {
    const box = await page.locator("#scrubber").boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await settled(page);
    const middle = await ask(page, "frame()");
    assert.ok(Math.abs(middle - last / 2) <= Math.max(2, 0.05 * last), `the scrubber's middle is frame ${middle} of ${last}`);
    await page.locator("#picture").focus();
    await page.keyboard.press("ArrowRight");
    await settled(page);
    assert.equal(await ask(page, "frame()"), Math.min(middle + 1, last));
    assert.equal(await ask(page, "chartTime()"), await ask(page, "time()"));
}

/** All charts are there, those of measures where the run has some; whether it has. */
async function allCharts(page) {
    const measured = await page.evaluate(() => Boolean(window.moreau.page.run.meta.measures?.time?.length));
    assert.equal(await page.locator(".plot").count(), measured ? 14 : 8);
    return measured;
}

async function charts(page) {
    const plot = page.locator(".plot canvas").first();
    await plot.scrollIntoViewIfNeeded();
    const box = await plot.boundingBox(), before = await page.locator(".cursor").boundingBox();
    await page.mouse.click(box.x + 0.9 * box.width, box.y + box.height / 2);
    await settled(page);
    const { start, end } = await page.evaluate(() => ({ start: window.moreau.page.charts.start, end: window.moreau.page.charts.end }));
    const time = await ask(page, "time()"), after = await page.locator(".cursor").boundingBox();
    assert.ok(time > start + 0.75 * (end - start), `a click near the end of a chart gave ${time} s`);
    assert.ok(Math.abs(after.x - (box.x + 0.9 * box.width)) < 0.06 * box.width, "the cursor is not where the chart was clicked");
    assert.notEqual(after.x, before.x);
    if (await allCharts(page)) {
        await page.waitForTimeout(200);
        const shown = await page.locator(".plot", { hasText: "Solid fraction" }).locator(".value").textContent();
        const fraction = await page.evaluate((time) => {
            const { time: times, solid_fraction: fractions } = window.moreau.page.run.meta.measures;
            return fractions[Math.max(times.filter((t) => t <= time + 1e-9 * times.at(-1)).length - 1, 0)];
        }, time);
        assert.ok(Math.abs(parseFloat(shown) - fraction) <= 0.01 * Math.abs(fraction), `solid fraction ${shown} in place of ${fraction}`);
    }
}

async function colours(page) {
    let before = await look(page);
    for (const name of ["speed", "spin", "energy", "coordination", "material"]) {
        await page.selectOption("#colour", name);
        await settled(page);
        const now = await look(page);
        assert.notDeepEqual(now, before, `colours by ${name} are those before`);
        before = now;
    }
}

/** Clicks at the projected places of free bodies until one that is in front is hit. */
async function clicksBody(page) {
    const places = await page.evaluate(() => {
        const { moreau } = window, { n, bodies } = moreau.page.run, box = document.querySelector("#picture").getBoundingClientRect();
        const all = Array.from({ length: n }, (_, i) => i).filter((i) => bodies.free[i] && bodies.radius[i] > 0);
        return all.map((i) => ({ i, at: moreau.project(moreau.position(i)) }))
            .filter(({ at }) => at && document.elementFromPoint(...at)?.id === "picture" && at[0] > box.left && at[1] < box.bottom).slice(-400);
    });
    for (const { i, at } of places.reverse()) {
        await page.mouse.click(...at);
        const chosen = await ask(page, "selection()");
        if (chosen.kind !== "body" || chosen.index !== i) continue;
        const text = await page.locator("#selection").innerText();
        assert.match(text, /Mass/);
        assert.match(text, /Coordination/);
        return i;
    }
    throw new Error("no body could be clicked");
}

async function clicksContact(page) {
    const places = await page.evaluate(() => {
        const { moreau } = window, frame = moreau.page.picture.frame, half = (p, q) => p.map((x, k) => (x + q[k]) / 2);
        return Array.from({ length: frame.contacts }, (_, k) => k).filter((k) => frame.status[k] > 0)
            .map((k) => ({ k, at: moreau.project(half(...moreau.contactEnds(k))) }))
            .filter(({ at }) => at && document.elementFromPoint(...at)?.id === "picture").slice(0, 200);
    });
    if (!places.length) return console.log("no loaded contact in this frame");
    await page.click("#forces");
    await settled(page);
    for (const { k, at } of places) {
        await page.mouse.click(...at);
        const chosen = await ask(page, "selection()");
        if (chosen.kind !== "contact" || chosen.index !== k) continue;
        const text = await page.locator("#selection").innerText();
        assert.match(text, /Normal impulse/);
        assert.match(text, /sticking|sliding/);
        return k;
    }
    throw new Error("no contact could be clicked");
}

async function compares(page) {
    const { frame, positions } = JSON.parse(readFileSync(expected, "utf8"));
    await ask(page, `setFrame(${frame})`);
    let worst = 0, size = 0;
    const shown = await page.evaluate((n) => Array.from({ length: n }, (_, i) => window.moreau.position(i)), positions.length);
    positions.forEach((p, i) => p.forEach((x, k) => {
        if (x === null) return assert.ok(shown[i][k] === null || Number.isNaN(shown[i][k]), `body ${i} should be absent`);
        size = Math.max(size, Math.abs(x));
        worst = Math.max(worst, Math.abs(shown[i][k] - x));
    }));
    assert.ok(worst <= 1e-6 * Math.max(size, 1e-9), `positions differ by ${worst} m`);
    return worst;
}

/** Of many frames that are asked for at once the last one is shown. */
async function hurries(page, last) {
    await page.evaluate((n) => Promise.all(Array.from({ length: n + 1 }, (_, i) => window.moreau.setFrame(n - i))), last);
    assert.equal(await ask(page, "frame()"), 0);
    assert.ok(await page.evaluate(() => window.moreau.page.picture.frame === window.moreau.page.run.decoded(0)));
}

/** Turning, moving and zooming change what is seen; fitting brings it back. */
async function turns(page) {
    const box = await page.locator("#picture").boundingBox(), x = box.x + box.width / 2, y = box.y + box.height / 2;
    const home = await ask(page, "cameraMatrix()");
    const drag = async (button) => {
        await page.mouse.move(x, y);
        await page.mouse.down({ button });
        await page.mouse.move(x + 60, y + 30, { steps: 4 });
        await page.mouse.up({ button });
        return ask(page, "cameraMatrix()");
    };
    const turned = await drag("left");
    assert.notDeepEqual(turned, home);
    const moved = await drag("right");
    assert.notDeepEqual(moved, turned);
    await page.mouse.wheel(0, -300);
    await settled(page);
    assert.notDeepEqual(await ask(page, "cameraMatrix()"), moved);
    await page.click("#reset");
    assert.deepEqual(await ask(page, "cameraMatrix()"), home);
}

async function keys(page) {
    await page.locator("#scrubber").focus(); // which keeps its own keys only
    const theme = () => page.evaluate(() => document.documentElement.dataset.theme);
    const before = await theme();
    await page.keyboard.press("t");
    assert.notEqual(await theme(), before);
    await page.keyboard.press("t");
    await page.keyboard.press("?");
    assert.ok(await page.locator("#keys").isVisible());
    await page.keyboard.press("Escape");
    assert.ok(!(await page.locator("#keys").isVisible()));
    await page.keyboard.press("Escape");
    assert.equal((await ask(page, "selection()")).kind, null);
}

async function drive(browser) {
    const { page, context, complaints, seconds } = await open(browser, report);
    assert.ok(await page.evaluate(() => !!window.moreau.page.picture.gl), "there is no WebGL 2");
    assert.match(await page.locator("#verdict").innerText(), /Convergence/);
    await page.waitForTimeout(300);
    await turns(page);
    const last = await plays(page);
    await scrubs(page, last);
    await charts(page);
    await hurries(page, last);
    await ask(page, `setFrame(${Math.round(0.9 * last)})`);
    await colours(page);
    const body = await clicksBody(page);
    await ask(page, `setFrame(${last})`);
    const contact = await clicksContact(page);
    await ask(page, `setFrame(${Math.max(last - 1, 0)})`);
    const worst = expected ? await compares(page) : null;
    await keys(page);
    assert.deepEqual(complaints, []);
    console.log(`opened in ${seconds.toFixed(2)} s; played ${last + 1} frames; clicked body ${body} and contact ${contact ?? "none"}; ` +
        `positions ${worst === null ? "not compared" : `within ${worst.toExponential(1)} m`}; ${await ask(page, "framesDrawn()")} pictures`);
    await context.close();
}

/** Pictures of the page for people, and no sideways scrolling on a phone. */
async function photograph(browser) {
    mkdirSync(shots, { recursive: true });
    for (const colorScheme of ["light", "dark"])
        for (const [width, height] of [[1280, 720], [390, 844]]) {
            const { page, context, complaints } = await open(browser, report, { colorScheme, viewport: { width, height }, hasTouch: width < 500 });
            const last = (await ask(page, "frames()")) - 1;
            await ask(page, `setFrame(${Math.round(0.9 * last)})`);
            await ask(page, "colourBy('speed')");
            await settled(page);
            await page.screenshot({ path: `${shots}/${colorScheme}-${width}.png` });
            await ask(page, "forces(true)");
            await ask(page, "select('body', Math.floor(0.7 * window.moreau.page.run.n))");
            await settled(page);
            await page.screenshot({ path: `${shots}/${colorScheme}-${width}-forces.png`, fullPage: width < 500 });
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `the page is wider than ${width}`);
            assert.deepEqual(complaints, []);
            await context.close();
        }
}

/** Two fingers that part come nearer. */
async function pinches(browser) {
    const { page, context, complaints } = await open(browser, report, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
    const box = await page.locator("#picture").boundingBox(), x = box.x + box.width / 2, y = box.y + box.height / 2;
    const fingers = await context.newCDPSession(page), before = await ask(page, "page.picture.camera.distance");
    const touch = (type, apart) => fingers.send("Input.dispatchTouchEvent",
        { type, touchPoints: apart ? [{ x: x - apart, y, id: 0 }, { x: x + apart, y, id: 1 }] : [] });
    await touch("touchStart", 30);
    for (const apart of [40, 50, 60]) await touch("touchMove", apart);
    await touch("touchEnd", 0);
    await settled(page);
    const after = await ask(page, "page.picture.camera.distance");
    assert.ok(Math.abs(after / before - 0.5) < 0.05, `fingers twice as far apart changed the distance by ${after / before}`);
    assert.equal((await ask(page, "selection()")).kind, null, "a pinch selects nothing");
    assert.deepEqual(complaints, []);
    await context.close();
}

/** Without WebGL the page says so and still has its charts. */
async function without() {
    const browser = await launch(["--no-sandbox", "--disable-gpu", "--disable-3d-apis", "--disable-webgl", "--no-first-run"]);
    const { page } = await open(browser, report);
    assert.match(await page.locator("#note").innerText(), /WebGL/);
    await allCharts(page);
    await ask(page, "setFrame(1)");
    assert.equal(await ask(page, "chartTime()"), await ask(page, "time()"));
    await browser.close();
}

const browser = await launch();
try {
    await drive(browser);
    await pinches(browser);
    await without();
    if (shots) await photograph(browser);
    console.log("ok");
} finally {
    await browser.close();
}
