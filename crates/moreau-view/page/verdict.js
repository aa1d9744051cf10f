// The verdict: whether the run may be believed, in words first, with colour beside them.

const GRADES = { good: "✓", fair: "▲", bad: "✕" };

const worse = (a, b) => (["good", "fair", "bad"].indexOf(a) > ["good", "fair", "bad"].indexOf(b) ? a : b);

/** Good up to `good`, fair up to `fair`. What is not known is not good. */
const grade = (x, good, fair) => (x <= good ? "good" : x <= fair ? "fair" : "bad");

function convergence({ steps, unconverged_steps: bad }) {
    if (!bad) return ["good", "Convergence", `in all ${plural(steps, "step")}`];
    return [grade(bad, 0, 0.01 * steps), "Convergence", `not in ${bad} of ${plural(steps, "step")}`];
}

function residual(verdict, { tolerance, criterion }) {
    const worst = ["scaled", "strict"].includes(criterion) ? verdict.scaled_residual_max : verdict.eps_glob_max;
    return [grade(worst, tolerance, 10 * tolerance), "Residual", `≤ ${figures(worst)} (tolerance ${figures(tolerance)})`];
}

function penetration(verdict, bodies) {
    let least = Infinity;
    bodies.radius.forEach((r, i) => {
        if (r > 0 && bodies.free[i]) least = Math.min(least, r);
    });
    const deep = Math.max(verdict.penetration_max ?? NaN, 0);
    const part = Number.isFinite(least) ? ` (${figures(100 * (deep / least), 2)} % of a radius)` : "";
    return [grade(deep / least, 0.01, 0.05), "Overlap", `≤ ${quantity(deep, "m")}${part}`];
}

function balance({ balance_error_max: error, energy_scale: whole }) {
    const part = whole > 0 ? error / whole : error;
    const words = whole > 0 ? `closes to ${figures(100 * part, 2)} %` : `is off by ${quantity(error, "J")}`;
    return [grade(part, 1e-3, 1e-2), "Energy", `balance ${words}`];
}

const OVERALL = { good: "All checks passed", fair: "Passed with reservations", bad: "Not to be relied on" };

function showVerdict({ verdict, solver, bodies, live }) {
    if (!verdict.steps) return byId("verdict").replaceChildren(element("p", {}, "No step has been made."));
    const parts = [convergence(verdict), residual(verdict, solver), penetration(verdict, bodies), balance(verdict)];
    const whole = parts.map(([word]) => word).reduce(worse);
    const left = verdict.planned_steps - verdict.steps;
    const end = left > 0 ? ` ${live ? "So far" : "Ended early"}: ${verdict.steps} of ${plural(verdict.planned_steps, "step")}.` : "";
    byId("verdict").replaceChildren(
        element("p", { class: `overall ${whole}` }, element("b", {}, `${GRADES[whole]} ${OVERALL[whole]}.`), end),
        ...parts.map(([word, title, text]) => element("p", { class: `part ${word}` },
            element("span", { class: "grade" }, GRADES[word]), element("span", {}, element("b", {}, title), " ", text))),
    );
}

function showHeader(meta) {
    const { solver, verdict, bodies } = meta, free = bodies.free.reduce((sum, x) => sum + x, 0);
    document.title = `${meta.title} · moreau`;
    byId("title").textContent = meta.title;
    const words = [
        `${plural(free, "free body").replace("bodys", "bodies")} in ${meta.dimension === 3 ? "space" : "the plane"}`,
        `${solver.global} + ${solver.local}`, `tolerance ${figures(solver.tolerance)}`,
        `${figures(verdict.seconds?.total)} s on ${plural(verdict.threads ?? 1, "thread")}`, `moreau ${verdict.version}`,
    ];
    if (meta.thinned > 1) words.push(`1 frame in ${meta.thinned}`);
    byId("solver").textContent = words.join(" · ");
    showVerdict(meta);
}
