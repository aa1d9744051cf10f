// Pointer, keys and buttons.

/** Turning, moving and zooming of the picture; `click` gets the place of a press that did not move, in pixels of the canvas. */
function listenPicture(canvas, camera, changed, click) {
    const held = new Map();
    let moved = 0;
    const place = (event) => ({ x: event.offsetX, y: event.offsetY });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("pointerdown", (event) => {
        canvas.setPointerCapture(event.pointerId);
        held.set(event.pointerId, place(event));
        moved = held.size > 1 ? Infinity : 0;
    });
    canvas.addEventListener("pointermove", (event) => {
        const before = held.get(event.pointerId);
        if (!before) return;
        const now = place(event), h = canvas.clientHeight, dx = (now.x - before.x) / h, dy = (now.y - before.y) / h;
        moved += Math.hypot(now.x - before.x, now.y - before.y);
        held.set(event.pointerId, now);
        if (moved < 4) return;
        canvas.classList.add("dragging");
        if (held.size === 2) pinch(before, now, [...held].find(([id]) => id !== event.pointerId)[1]);
        else if (camera.flat || event.shiftKey || event.buttons & 6) camera.pan(dx, dy);
        else camera.orbit(dx, dy);
        changed();
    });
    const pinch = (before, now, other) => {
        const factor = Math.hypot(before.x - other.x, before.y - other.y) / Math.hypot(now.x - other.x, now.y - other.y);
        const h = canvas.clientHeight;
        camera.pan((now.x - before.x) / (2 * h), (now.y - before.y) / (2 * h));
        zoomAt(factor, { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 });
    };
    const zoomAt = (factor, { x, y }) =>
        camera.zoom(factor, (2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight);
    const release = (event) => {
        if (held.delete(event.pointerId) && event.type === "pointerup" && moved < 4 && event.button === 0) click(place(event));
        canvas.classList.remove("dragging");
        changed();
    };
    for (const kind of ["pointerup", "pointercancel"]) canvas.addEventListener(kind, release);
    canvas.addEventListener("wheel", (event) => {
        event.preventDefault();
        zoomAt(Math.exp(clamp(event.deltaY, -200, 200) * (event.ctrlKey ? 0.008 : 0.0016)), place(event));
        changed();
    }, { passive: false });
}

/** Keys that buttons, lists, boxes and sliders keep for themselves. */
const KEPT = {
    BUTTON: [" ", "Enter"], INPUT: [" "], RANGE: ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End"],
    SELECT: [" ", "Enter", "ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End"],
};

/** What each key does, by the name that the browser gives it. */
function listenKeys(actions) {
    document.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey || byId("keys").open) return;
        const { tagName, type } = event.target;
        if (KEPT[type === "range" ? "RANGE" : tagName]?.includes(event.key)) return;
        const action = actions[event.key] ?? actions[event.key.toLowerCase()];
        if (!action) return;
        event.preventDefault();
        action(event.shiftKey);
    });
}

/** Dark or light: as the system has it until it is told otherwise. */
function listenTheme(changed) {
    const system = matchMedia("(prefers-color-scheme: dark)");
    const put = (dark) => {
        document.documentElement.dataset.theme = dark ? "dark" : "light";
        changed();
    };
    let told = false;
    system.addEventListener("change", () => told || put(system.matches));
    put(system.matches);
    return () => {
        told = true;
        put(document.documentElement.dataset.theme !== "dark");
    };
}

/** The legend: what colours mean, and what ribbons mean while they are shown. */
function showLegend(picture) {
    const { scalars, run, chains, chainsShown } = picture, { title, unit } = COLOURINGS[scalars.name];
    const state = [scalars.name, scalars.high, scalars.hold, chainsShown, chainsShown && chains?.reference].join();
    if (state === showLegend.state) return;
    showLegend.state = state;
    const swatch = (colour, name) => element("span", {}, element("span", { class: "swatch", style: `background:${colour}` }), name);
    const rows = [];
    if (scalars.name === "material") rows.push(element("div", { class: "names" }, ...run.meta.materials.map((name, i) => swatch(NAMED[i % NAMED.length], name))));
    else
        rows.push(element("div", {}, `${title}${unit ? ` in ${unit}` : ""}${scalars.hold ? ", range held" : ""}`),
            element("div", { class: "ramp", style: `background:${rampGradient()}` }),
            element("div", { class: "ends" }, element("span", {}, figures(scalars.low)), element("span", {}, `≥ ${figures(scalars.high)}`)));
    if (chainsShown && chains)
        rows.push(element("div", { class: "names" }, ...STATUS.map((name, i) => swatch(STATUS_COLOURS[i], name))),
            element("div", { class: "ends" }, `full width: ${chains.reference > 1e-29 ? figures(chains.reference, 2) : "–"} N s`));
    byId("legend").replaceChildren(...rows);
}

function rampGradient() {
    const ramp = rampBytes(), stops = Array.from({ length: 17 }, (_, k) => ramp.slice(4 * Math.min(16 * k, 255), 4 * Math.min(16 * k, 255) + 3));
    return `linear-gradient(to right, ${stops.map((c) => `rgb(${c.join()})`).join(", ")})`;
}
