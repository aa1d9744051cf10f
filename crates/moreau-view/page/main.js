// Opens the page, and tells its tests about it.

const page = new Page();
const ready = page.open();
ready.catch(tell);

/** For tests and for those who look behind the page. */
window.moreau = {
    ready,
    page,
    frame: () => page.playback.index,
    frames: () => page.run.frames,
    time: () => page.playback.time,
    setFrame: async (i) => {
        await page.seek(() => page.playback.seekFrame(i));
        await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
    },
    position: (i) => page.picker.position(i).slice(0, page.run.dimension),
    play: () => page.playback.play(),
    pause: () => page.playback.pause(),
    playing: () => page.playback.playing,
    colourBy: (name) => page.colourBy(name),
    forces: (on) => page.forces(on),
    select: (kind, index) => page.select(kind, index),
    selection: () => ({ kind: page.picture.selection.kind, index: page.picture.selection.index }),
    fps: () => page.pace.fps(),
    framesDrawn: () => page.picture.drawn,
    chartTime: () => page.charts.time,
    cameraMatrix: () => [...page.picture.camera.matrix],
    /** Where a point of the scene is on the page, in CSS pixels of the window. */
    project: (p) => {
        const box = byId("picture").getBoundingClientRect(), place = page.picture.camera.project([p[0], p[1], p[2] ?? 0]);
        return place && [box.left + 0.5 * (1 + place[0]) * box.width, box.top + 0.5 * (1 - place[1]) * box.height];
    },
    contactEnds: (k) => page.picker.ends(k),
};
