// What each button, box and key does.

function listenPage(page) {
    const { playback, picture } = page, on = (id, kind, action) => byId(id).addEventListener(kind, action);
    byId("colour").append(...Object.entries(COLOURINGS).map(([name, { title }]) => element("option", { value: name }, title)));
    byId("rate").append(...RATES.map((rate) => element("option", { value: rate }, `${figures(rate)} ×`)));
    on("colour", "change", (event) => page.colourBy(event.target.value));
    on("forces", "change", (event) => page.forces(event.target.checked));
    on("faded", "change", (event) => {
        picture.faded = event.target.checked;
        picture.dirty = true;
    });
    const reset = () => {
        picture.camera.face();
        picture.camera.refit();
        picture.dirty = true;
    };
    on("reset", "click", reset);
    on("play", "click", () => page.toggle());
    const step = (by) => page.seek(() => playback.seekFrame(playback.index + by)).catch(tell);
    on("back", "click", () => step(-1));
    on("next", "click", () => step(1));
    on("scrubber", "input", (event) => page.seek(() => playback.seekFrame(Number(event.target.value))).catch(tell));
    on("rate", "change", (event) => (playback.rate = Number(event.target.value)));
    on("blending", "change", (event) => (playback.blending = event.target.checked));
    on("theme", "click", () => page.toggleTheme());
    const help = () => byId("keys").showModal();
    on("help", "click", help);
    listenPicture(byId("picture"), picture.camera, () => (picture.dirty = true), (place) => page.click(place));
    const names = Object.keys(COLOURINGS);
    listenKeys({
        " ": () => page.toggle(), ArrowLeft: (far) => step(far ? -10 : -1), ArrowRight: (far) => step(far ? 10 : 1),
        Home: () => step(-Infinity), End: () => step(Infinity), "[": () => playback.shiftRate(-1), "]": () => playback.shiftRate(1),
        c: () => page.colourBy(names[(names.indexOf(picture.scalars.name) + 1) % names.length]),
        f: () => page.forces(!picture.chainsShown), r: reset, t: () => page.toggleTheme(), "?": help,
        h: () => {
            picture.scalars.hold = !picture.scalars.hold;
            picture.fill();
            page.changed();
        },
        Escape: () => page.select(null, -1),
    });
}
