// The verdict: whether the run may be believed, in words first, with colour beside them.

const GRADES = { good: "✓", bad: "✕", note: "·" };

const OVERALL = { good: "All checks passed", bad: "Not to be relied on" };

/** The residual beside its tolerance: a remark, since the checks judge whether the solver met its criterion. */
function residual(verdict, { tolerance, criterion }) {
    const worst = ["scaled", "strict"].includes(criterion) ? verdict.scaled_residual_max : verdict.eps_glob_max;
    return ["note", "Residual", `≤ ${figures(worst)} (tolerance ${figures(tolerance)})`];
}

/** Shows the judgement that the terminal and summary.json give; the page judges nothing itself. */
function showVerdict({ verdict, solver, live }) {
    if (!verdict.steps) return byId("verdict").replaceChildren(element("p", {}, "No step has been made."));
    const checks = verdict.checks.map(({ name, passed, text }) => [passed ? "good" : "bad", name, text]);
    const parts = [...checks, residual(verdict, solver)], whole = verdict.reliable ? "good" : "bad";
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
