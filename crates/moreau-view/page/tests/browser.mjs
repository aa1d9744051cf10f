// A browser without network that draws in software, and a page in it whose complaints are kept.

import { pathToFileURL } from "node:url";
import { resolve } from "node:path";
import { chromium } from "playwright-core";

const FLAGS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync"];

export const launch = (flags = FLAGS) =>
    chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true, args: flags });

/** Opens a report; `complaints` grows by each error, warning and request of the page. */
export async function open(browser, report, options = {}) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, colorScheme: "light", ...options });
    await context.setOffline(true);
    const page = await context.newPage(), complaints = [], address = pathToFileURL(resolve(report)).href;
    page.on("console", (message) => {
        if (["error", "warning"].includes(message.type())) complaints.push(`${message.type()}: ${message.text()}`);
    });
    page.on("pageerror", (error) => complaints.push(`error: ${error.stack}`));
    page.on("request", (request) => {
        // A blob is the page's own text.
        if (request.url() !== address && !/^(data:,|blob:)/.test(request.url())) complaints.push(`request: ${request.url().slice(0, 200)}`);
    });
    const began = performance.now();
    await page.goto(address);
    await page.waitForFunction(() => window.moreau);
    await page.evaluate(() => window.moreau.ready);
    return { page, context, complaints, seconds: (performance.now() - began) / 1000 };
}
