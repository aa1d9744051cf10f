// What is selected, with its numbers.

class Panel {
    constructor(picture, select) {
        this.picture = picture;
        this.run = picture.run;
        this.select = select;
        this.place = byId("selection");
        this.shown = {};
    }

    name(i) {
        return this.run.bodies.name[i] ?? `body ${i}`;
    }

    /** A link to a body. */
    link(i) {
        return element("button", { class: "link", type: "button", onclick: () => this.select("body", i) }, this.name(i));
    }

    bodyRows(i) {
        const { run, picture } = this, { bodies, meta } = run, D = run.dimension, frame = picture.frame;
        const touching = Array.from({ length: frame.contacts }, (_, k) => k).filter((k) => frame.a[k] === i || frame.b[k] === i);
        const spin = D === 3 ? 3 : 1, figure = meta.shapes[bodies.shape[i]];
        return [
            ["Material", meta.materials[bodies.material[i]]],
            ["Shape", `${shapeName(figure, D)}${bodies.radius[i] > 0 ? `, radius ${quantity(bodies.radius[i], "m")}` : ""}`],
            ["Mass", bodies.mass[i] === null ? "–" : `${figures(bodies.mass[i])} kg`],
            ["State", ["not there now", "fixed or driven", "free"][frame.motion[i]]],
            ["Position", `${tuple(frame.position, D * i, D)} m`],
            ["Velocity", `${tuple(frame.velocity, D * i, D)} m/s`],
            ["Speed", `${figures(lengthAt(frame.velocity, i, D))} m/s`],
            ["Spin", `${tuple(frame.spin, spin * i, spin)} rad/s`],
            [figure.ball ? "Kinetic energy" : "Kinetic, no spin", `${figures(kineticEnergy(run, frame, i))} J`],
            ["Coordination", String(picture.scalars.touching[i])],
            ["Contacts", touching.length ? this.contactLinks(i, touching) : "none"],
        ];
    }

    /** Links to the first contacts of body `i`. */
    contactLinks(i, touching) {
        const { a, b } = this.picture.frame;
        const links = touching.slice(0, 12).flatMap((k) => [
            element("button", { class: "link", type: "button", onclick: () => this.select("contact", k) },
                `with ${this.name(a[k] === i ? b[k] : a[k])}`), " "]);
        return element("span", {}, ...links, touching.length > 12 ? `and ${touching.length - 12} more` : "");
    }

    contactRows(k) {
        const { run, picture } = this, D = run.dimension, frame = picture.frame;
        let push = 0, square = 0;
        for (let i = D * k; i < D * (k + 1); i++) {
            push += frame.impulse[i] * frame.normal[i];
            square += frame.impulse[i] ** 2;
        }
        const along = Math.sqrt(Math.max(square - push * push, 0));
        return [
            ["Bodies", element("span", {}, this.link(frame.a[k]), " and ", this.link(frame.b[k]))],
            ["Status", STATUS[frame.status[k]]],
            ["Gap", quantity(frame.gap[k], "m")],
            ["Normal impulse", `${figures(push)} N s`],
            ["Tangential impulse", `${figures(along)} N s`],
            ["Tangential / normal", push > 0 ? figures(along / push) : "–"],
            ["Point", `${tuple(frame.point, D * k, D)} m`],
            ["Normal", tuple(frame.normal, D * k, D)],
        ];
    }

    /** Writes the panel again if what it shows may have changed. */
    update() {
        const { kind, index, lost } = this.picture.selection, { frame } = this.picture;
        if (this.shown.kind === kind && this.shown.index === index && this.shown.frame === frame) return;
        this.shown = { kind, index, frame };
        if (!kind) {
            this.place.replaceChildren(element("p", { class: "hint" }, "Click a body, or with forces shown a contact, for its numbers."));
            return;
        }
        const title = kind === "body" ? this.name(index) : lost ? "No longer in contact" : `Contact ${index}`;
        const rows = kind === "body" ? this.bodyRows(index) : lost ? [] : this.contactRows(index);
        const close = element("button", { class: "close", type: "button", "aria-label": "Select nothing", onclick: () => this.select(null, -1) }, "×");
        const list = rows.flatMap(([term, value]) => [element("dt", {}, term), element("dd", {}, value)]);
        this.place.replaceChildren(element("h2", {}, title, close), element("dl", {}, ...list));
    }
}

function shapeName(figure, D) {
    if (figure.ball) return D === 3 ? "ball" : "disk";
    if (figure.plane) return D === 3 ? "half-space" : "half-plane";
    return D === 3 ? plural(figure.polygons.length, "face") : plural(figure.vertices.length, "corner");
}

/** The contact of the same pair in another frame that is nearest to where it was, or -1. */
function sameContact(from, k, to, D) {
    let best = Infinity, found = -1;
    for (let j = 0; j < to.contacts; j++) {
        const same = to.a[j] === from.a[k] && to.b[j] === from.b[k], swapped = to.a[j] === from.b[k] && to.b[j] === from.a[k];
        if (!same && !swapped) continue;
        let square = 0;
        for (let i = 0; i < D; i++) square += (to.point[D * j + i] - from.point[D * k + i]) ** 2;
        if (square < best) [best, found] = [square, j];
    }
    return found;
}
