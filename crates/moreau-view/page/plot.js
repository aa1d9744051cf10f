// One chart over time: lines of columns of numbers, drawn once for its size; the cursor lies over it.

const PLOT = { left: 52, right: 8, top: 6, bottom: 16, height: 92 };

/** Evenly spaced round numbers within a range, about `count` of them. */
function ticks(low, high, count) {
    const step = roundUp((high - low) / count), first = Math.ceil(low / step - 1e-9);
    const found = [];
    for (let k = first; k * step <= high + 1e-9 * step; k++) found.push(k * step);
    return found;
}

/** Powers of ten within a range, not more than about `count`. */
function decades(low, high, count) {
    const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
    const every = Math.max(1, Math.ceil((last - first) / count)), found = [];
    for (let e = first; e <= last; e += every) found.push(10 ** e);
    return found;
}

class Plot {
    /** `series` is a list of { name, colour, values } at `times`; with `log`, what is not positive is not drawn; `bound` is a dashed line. */
    constructor({ title, unit = "", log = false, bound = NaN, times, series }) {
        Object.assign(this, { title, unit, log, bound, times, series });
        this.canvas = element("canvas", { role: "img", "aria-label": `${title} over time` });
        this.readouts = series.map(() => element("span", { class: "value" }));
        const keys = series.map((s, i) => element("span", { class: "key" },
            element("span", { class: "swatch", style: `background:${s.colour}` }), s.name ? `${s.name} ` : "", this.readouts[i]));
        this.place = element("figure", { class: "plot" },
            element("figcaption", {}, element("b", {}, title), unit ? ` ${unit} ` : " ", ...keys), this.canvas);
    }

    range() {
        let low = Infinity, high = -Infinity;
        if (this.bound > 0) low = high = this.bound;
        for (const { values } of this.series)
            for (const y of values) {
                if (y === null || !Number.isFinite(y) || (this.log && !(y > 0))) continue;
                if (y < low) low = y;
                if (y > high) high = y;
            }
        if (low > high) return this.log ? [0.1, 1] : [0, 1];
        if (this.log) return [Math.max(low / 1.5, 1e-9 * high), Math.max(high * 1.5, low * 5)];
        [low, high] = [Math.min(low, 0), Math.max(high, 0)];
        if (low === high) high = low + (Math.abs(low) || 1);
        return [low, high + 0.04 * (high - low)];
    }

    /** Draws all again between the times `start` and `end`. */
    draw(start, end, ink) {
        const { canvas } = this, width = canvas.clientWidth, height = PLOT.height;
        if (!width) return;
        const ratio = window.devicePixelRatio;
        [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
        const pen = canvas.getContext("2d"), [low, high] = this.range();
        pen.scale(ratio, ratio);
        const w = width - PLOT.left - PLOT.right, h = height - PLOT.top - PLOT.bottom;
        const part = this.log ? (y) => Math.max(Math.log(y / low), 0) / Math.log(high / low) : (y) => (y - low) / (high - low);
        const toX = (t) => PLOT.left + (w * (t - start)) / (end - start || 1), toY = (y) => PLOT.top + h * (1 - part(y));
        this.grid(pen, { low, high, start, end, w, h, toX, toY }, ink);
        pen.save();
        pen.beginPath();
        pen.rect(PLOT.left, 0, w, height);
        pen.clip();
        for (const { values, colour } of this.series) this.line(pen, this.times, values, toX, toY, colour);
        if (this.bound > 0) {
            pen.setLineDash([4, 3]);
            this.line(pen, [start, end], [this.bound, this.bound], toX, toY, ink.text);
        }
        pen.restore();
    }

    grid(pen, { low, high, start, end, w, h, toX, toY }, ink) {
        pen.font = ink.font;
        pen.fillStyle = ink.text;
        pen.strokeStyle = ink.grid;
        pen.lineWidth = 1;
        pen.textAlign = "right";
        pen.textBaseline = "middle";
        pen.beginPath();
        for (const y of this.log ? decades(low, high, 3) : ticks(low, high, 3)) {
            pen.moveTo(PLOT.left, Math.round(toY(y)) + 0.5);
            pen.lineTo(PLOT.left + w, Math.round(toY(y)) + 0.5);
            pen.fillText(this.log ? `10${superscript(Math.round(Math.log10(y)))}` : figures(y), PLOT.left - 6, toY(y));
        }
        pen.textBaseline = "top";
        const marks = ticks(start, end, 4);
        marks.forEach((t, i) => {
            pen.moveTo(Math.round(toX(t)) + 0.5, PLOT.top + h);
            pen.lineTo(Math.round(toX(t)) + 0.5, PLOT.top + h + 3);
            pen.textAlign = i === 0 && t === start ? "left" : toX(t) > PLOT.left + w - 12 ? "right" : "center";
            pen.fillText(`${figures(t)}${i === marks.length - 1 ? " s" : ""}`, toX(t), PLOT.top + h + 4);
        });
        pen.stroke();
    }

    /** A line; where more than one value falls in a pixel it runs from their least to their greatest, so that no peak is lost. */
    line(pen, times, values, toX, toY, colour) {
        pen.strokeStyle = colour;
        pen.lineWidth = 1.4;
        pen.lineJoin = "round";
        pen.beginPath();
        let column = NaN, least = NaN, most = NaN, pen_down = false;
        const flush = () => {
            if (Number.isNaN(column)) return;
            if (pen_down) pen.lineTo(column, least);
            else pen.moveTo(column, least);
            if (most !== least) pen.lineTo(column, most);
            else if (!pen_down) pen.lineTo(column + 0.01, least);
            pen_down = true;
        };
        for (let i = 0; i < values.length; i++) {
            const y = values[i];
            if (y === null || !Number.isFinite(y) || (this.log && !(y > 0))) continue;
            const x = Math.round(2 * toX(times[i])) / 2, place = toY(y);
            if (x === column) {
                if (place < least) least = place;
                if (place > most) most = place;
                continue;
            }
            flush();
            [column, least, most] = [x, place, place];
        }
        flush();
        pen.stroke();
    }

    /** Writes the values of row `i` beside the title. */
    read(i) {
        this.series.forEach(({ values }, k) => write(this.readouts[k], figures(values[i])));
    }
}
