// Puts a page together as the program does: style, scripts in the order of ORDER, and the data of a run.

import { readFileSync } from "node:fs";
import { deflateSync } from "node:zlib";

const folder = new URL("../", import.meta.url);
const read = (name) => readFileSync(new URL(name, folder), "utf8");

/** The files of the script, in their order. */
export const scripts = () => read("ORDER").split("\n").filter((line) => line.trim());

/** The page with `blocks`, arrays of raw bytes; without meta data it is the page that is served. */
export function assemble(meta, blocks = []) {
    const data = meta
        ? [`<script type="application/json" id="meta">${JSON.stringify(meta).replaceAll("<", "\\u003c")}</script>`,
            ...blocks.map((raw, k) => `<script type="application/octet-stream" id="block-${k}">${deflateSync(raw, { level: 4 }).toString("base64")}</script>`)]
        : [];
    // Functions, because a dollar in a text that replaces has a meaning.
    return read("page.html")
        .replace("<!--style-->", () => `<style>\n${read("style.css")}</style>`)
        .replace("<!--data-->", () => data.join("\n"))
        .replace("<!--script-->", () => `<script type="module">\n${scripts().map(read).join("\n")}</script>`);
}
