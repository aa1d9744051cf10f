// The charts of a run. They share their time axis and a cursor at the time that the picture shows.

/** What is drawn: a chart's lines name columns of the steps or, where the run has them, of its granular measures. */
function chartList({ steps, measures = {}, solver }) {
    const of = (table) => (name, column, colour) => ({ name, colour: NAMED_INK[colour], values: table[column] ?? [] });
    const ofSteps = stepCharts(of(steps), solver.tolerance), ofMeasures = measures.time?.length ? measureCharts(of(measures)) : [];
    return [...ofSteps.map((chart) => ({ ...chart, times: steps.time })), ...ofMeasures.map((chart) => ({ ...chart, times: measures.time }))];
}

function measureCharts(line) {
    return [
        { title: "Coordination", unit: "contacts per body", series: [line("all", "coordination", 0), line("without rattlers", "coordination_without_rattlers", 1)] },
        { title: "Solid fraction", series: [line("", "solid_fraction", 0)] },
        { title: "Anisotropy of contacts", series: [line("", "fabric_anisotropy", 3)] },
        { title: "Pressure", unit: "Pa or N/m", series: [line("", "pressure", 5)] },
        { title: "Mean normal force", unit: "N", series: [line("", "mean_normal_force", 1)] },
        { title: "Share of sliding contacts", series: [line("", "sliding_share", 2)] },
    ];
}

function stepCharts(line, tolerance) {
    return [
        { title: "Sweeps", unit: "per step", series: [line("", "sweeps", 0)] },
        {
            title: "Residual", unit: "(dashed: tolerance)", log: true, bound: tolerance,
            series: [line("motion", "eps_motion", 0), line("bipotential", "eps_bipotential", 1),
                line("penetration", "eps_penetration", 2), line("scaled", "scaled_residual", 3)],
        },
        { title: "Penetration", unit: "m", series: [line("", "penetration", 5)] },
        {
            title: "Energy", unit: "J",
            series: [line("kinetic", "kinetic", 0), line("potential", "potential", 2), line("work", "work", 3), line("dissipated", "dissipated", 1),
                line("by impacts", "impact", 4), line("by friction", "friction", 5)],
        },
        {
            title: "Energy created", unit: "J per step",
            series: [line("by contacts", "created_contacts", 0), line("by joints", "created_joints", 1),
                line("by corrections", "created_correction", 2), line("by the scheme", "created_scheme", 3)],
        },
        { title: "Balance error", unit: "J", series: [line("", "balance_error", 5)] },
        { title: "Contacts", series: [line("all", "contacts", 0), line("with impulse", "active", 1)] },
        {
            title: "Time", unit: "s per step",
            series: [line("detect", "seconds_detect", 2), line("localise", "seconds_localise", 1), line("solve", "seconds_solve", 0),
                line("step", "seconds_step", 3)],
        },
    ];
}

/** Colours of lines that can be read on light and on dark ground. */
const NAMED_INK = ["#3b8fd6", "#d98a00", "#0f9d78", "#b866a6", "#56b4e9", "#dd5f1a"];

class Charts {
    constructor(run, seek) {
        this.run = run;
        this.seek = seek;
        this.place = byId("charts");
        this.cursor = element("div", { class: "cursor" });
        this.renew();
        new ResizeObserver(() => this.draw()).observe(this.place);
    }

    /** Takes the run's steps again, which have grown. */
    renew() {
        const { steps, frames } = this.run.meta, list = chartList(this.run.meta);
        this.start = Math.min(steps.time[0] ?? 0, frames.time[0] ?? 0);
        this.end = Math.max(steps.time.at(-1) ?? 1, frames.time.at(-1) ?? 1);
        // Measures may come later than steps: then there are more charts than before.
        if (this.plots?.length === list.length) {
            list.forEach(({ series, times }, i) => Object.assign(this.plots[i], { series, times }));
        } else {
            this.plots = list.map((given) => new Plot(given));
            this.plots.forEach((plot) => this.listen(plot.canvas));
            this.place.replaceChildren(...this.plots.map((plot) => plot.place), this.cursor);
        }
        this.draw();
    }

    draw() {
        const style = getComputedStyle(document.documentElement), get = (name) => style.getPropertyValue(name).trim();
        const ink = { text: get("--quiet"), grid: get("--rule"), font: "10.5px system-ui, sans-serif" };
        for (const plot of this.plots) plot.draw(this.start, this.end, ink);
        if (this.time !== undefined) this.show(this.time);
    }

    /** A press on a chart, and dragging from there, moves the time. */
    listen(canvas) {
        const seek = (event) => {
            const box = canvas.getBoundingClientRect();
            const x = (event.clientX - box.left - PLOT.left) / (box.width - PLOT.left - PLOT.right);
            this.seek(this.start + clamp(x, 0, 1) * (this.end - this.start));
        };
        canvas.addEventListener("pointerdown", (event) => {
            if (event.button !== 0) return;
            if (event.pointerType === "mouse") canvas.setPointerCapture(event.pointerId);
            seek(event);
        });
        canvas.addEventListener("pointermove", (event) => {
            if (event.buttons & 1 && event.pointerType === "mouse") seek(event);
        });
    }

    /** Puts the cursor at a time; values are read at the last step until there. */
    show(time) {
        this.time = time;
        const width = this.plots[0].canvas.clientWidth - PLOT.left - PLOT.right;
        const x = this.plots[0].canvas.offsetLeft + PLOT.left + (width * (time - this.start)) / (this.end - this.start || 1);
        this.cursor.style.transform = `translateX(${x.toFixed(1)}px)`;
        const now = performance.now(), due = 100 - (now - (this.read ?? -1e9));
        clearTimeout(this.later);
        if (due > 0) this.later = setTimeout(() => this.show(this.time), due);
        else this.readAt(time, now);
    }

    /** Text is slow to lay out, so it follows ten times a second at most. */
    readAt(time, now) {
        this.read = now;
        const end = time + 1e-9 * (this.end - this.start);
        for (const plot of this.plots) plot.read(lastBelow(plot.times, end));
    }
}
