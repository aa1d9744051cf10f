"""Runs all rows and writes them: results.json, results.md, and the tables of docs/fidelity.md. Started by run.py."""

import argparse
import datetime
import json
import os
import platform
import re
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np

import settings
from engines import HERE, Engines
from experiments import EXPERIMENTS
from measures import Run

ENGINES = ["moreau", "MuJoCo", "Rapier", "Jolt"]


def main():
    words = argparse.ArgumentParser(description=__doc__)
    for name in ("--moreau", "--rapier", "--jolt", "--work", "--results", "--page"):
        words.add_argument(name, type=Path)
    words.add_argument("--budget", type=float, required=True)
    words.add_argument("--engines", nargs="+")
    words.add_argument("--only", nargs="+")
    args = words.parse_args()
    store = args.results / "results.json"
    old = json.loads(store.read_text()) if store.exists() else {"engines": {}, "rows": []}
    chosen = [e for e in EXPERIMENTS if not args.only or e.name in args.only]
    load = os.getloadavg()[0]
    engines = Engines(args.moreau, args.rapier, args.jolt, args.work, args.budget)
    new = [row(engines, e, *words) for e in chosen for words in settings.rows(e) if words[0] in args.engines]
    again = {(r["experiment"], r["engine"]) for r in new}
    kept = [r for r in old["rows"] if (r["experiment"], r["engine"]) not in again]
    about = {name: {"version": version(name, args), "date": str(datetime.date.today()), "machine": machine(load)} for name in args.engines}
    engines_known = old["engines"] | about
    results = {"engines": {name: engines_known[name] for name in ENGINES if name in engines_known}, "budget": args.budget, "rows": kept + new}
    rows = ",\n".join(json.dumps(r) for r in results["rows"])
    store.write_text(f'{{"engines": {json.dumps(results["engines"], indent=1)},\n"budget": {results["budget"]},\n"rows": [\n{rows}\n]}}\n')
    tables = {e.name: table(e, results) for e in EXPERIMENTS}
    tables |= {"summary": summary(results), "machine": head(results)}
    page = [f"# moreau beside MuJoCo, Rapier and Jolt\n\nMade by `benches/fidelity/run.py`. What is measured, and why: docs/fidelity.md.\n\n{tables['machine']}"]
    page += ["## In one table\n\n" + tables["summary"]] + [f"## {e.title}\n\n{tables[e.name]}" for e in EXPERIMENTS]
    (args.results / "results.md").write_text("\n".join(page))
    if args.page and args.page.exists():
        replace(args.page, tables)


def row(engines, experiment, engine, name, step, words):
    """One run, judged: measures, or a reason why there are none."""
    print(f"{experiment.name}: {engine}, {name}, {step:.3g} s ...", file=sys.stderr, flush=True)
    scene, answer = engines.run(engine, experiment, step, words)
    made = {"experiment": experiment.name, "engine": engine, "name": name, "step": step, "settings": words, "measures": None, "passed": False}
    if isinstance(answer, str):
        return made | {"reason": answer, "cost": None}
    numbers, seconds, reached, said = answer
    run = Run(scene, numbers)
    made |= {"cost": seconds / reached, "said": said}
    if reached < experiment.duration - 2 * step:
        return made | {"reason": f"{reached:.2g} s of {experiment.duration:g} in {engines.budget:g} s"}
    if run.broken():
        return made | {"reason": "diverged"}
    measured = {key: value if isinstance(value, bool) else float(value) for key, value in experiment.measure(run).items()}
    return made | {"measures": measured, "passed": bool(experiment.passed(measured))}


def of(results, experiment):
    """Rows of an experiment in the order of the settings."""
    order = {words[:3]: k for k, words in enumerate(settings.rows(experiment))}
    rows = [r for r in results["rows"] if r["experiment"] == experiment.name]
    return sorted(rows, key=lambda r: order.get((r["engine"], r["name"], r["step"]), len(order)))


def table(experiment, results):
    rows = of(results, experiment)
    lines = [f"| engine | settings | step, ms | {' | '.join(c[0] for c in experiment.columns)} | passed | cost, ms a second |"]
    lines.append("|---" * (5 + len(experiment.columns)) + "|")
    for r in rows:
        if r["measures"] is None:
            cells = [r["reason"]] + ["-"] * (len(experiment.columns) - 1)
        else:
            cells = [show(r["measures"]) for _, show in experiment.columns]
        cost = "-" if r["cost"] is None else f"{1e3 * r['cost']:.3g}"
        lines.append(f"| {r['engine']} | {r['name']} | {1e3 * r['step']:.3g} | {' | '.join(cells)} | {'yes' if r['passed'] else 'no'} | {cost} |")
    said = "".join(f"\n\n{label(r)} says: {r['said']}" for r in rows if r.get("said"))
    return "\n".join(lines) + f"\n\nPassed: {experiment.rule}. {verdict(experiment, rows)}{said}\n"


def label(r):
    return f"{r['engine']} ({r['name']}, {1e3 * r['step']:.3g} ms)"


def verdict(experiment, rows):
    """A sentence from the numbers: who is nearest to the answer, who is cheapest of those that passed."""
    rated = [r for r in rows if r["measures"] is not None and np.isfinite(experiment.error(r["measures"]))]
    passed = [r for r in rated if r["passed"]]
    if not passed:
        return "No run passed."
    best = {}
    # Errors of rounding are alike.
    for r in sorted(passed, key=lambda r: (max(experiment.error(r["measures"]), 1e-9), r["cost"])):
        best.setdefault(r["engine"], r)
    cheap = min(passed, key=lambda r: r["cost"])
    names = ", ".join(label(r) for r in best.values())
    failed = [name for name in engines_of(rows) if name not in best]
    without = f" No run of {' or '.join(failed)} passed." if failed else ""
    return f"Each engine's nearest run that passed, nearest first: {names}. The cheapest run that passed: {label(cheap)}, {1e3 * cheap['cost']:.3g} ms a second.{without}"


def engines_of(rows):
    return list(dict.fromkeys(r["engine"] for r in rows))


def summary(results):
    """A row an engine and kind of settings, a column an experiment: its headline figure, bold where it passed."""
    rows = {}
    for e in EXPERIMENTS:
        for r in of(results, e):
            step = "own step" if r["step"] == settings.OWN.get(r["engine"]) else "16.7 ms" if r["step"] > 0.01 else "0.2 ms" if r["step"] == 2e-4 else "common step"
            text = r["reason"] if r["measures"] is None else e.headline(r["measures"])
            rows.setdefault((r["engine"], r["name"], step), {})[e.name] = (f"**{text}**" if r["passed"] else text, r["passed"])
    lines = [f"| engine | settings, step | {' | '.join(e.short for e in EXPERIMENTS)} | passed |", "|---" * (3 + len(EXPERIMENTS)) + "|"]
    for (engine, name, step), cells in sorted(rows.items(), key=lambda item: ENGINES.index(item[0][0])):
        texts = [cells.get(e.name, ("", False))[0] for e in EXPERIMENTS]
        lines.append(f"| {engine} | {name}, {step} | {' | '.join(texts)} | {sum(c[1] for c in cells.values())} of {len(cells)} |")
    return "\n".join(lines) + "\n"


def head(results):
    lines = ["| engine | version | measured | machine |", "|---|---|---|---|"]
    lines += [f"| {name} | {e['version']} | {e['date']} | {e['machine']} |" for name, e in results["engines"].items()]
    return "\n".join(lines) + f"\n\nOne run may take {results['budget']:g} s of a processor. Command: `benches/fidelity/run.py`.\n"


def machine(load):
    models = (line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name"))
    return f"{next(models, platform.machine())}, {os.cpu_count()} cores of which a run has one, {load:.1f} busy before it began"


def version(engine, args):
    if engine == "moreau":
        return subprocess.run([args.moreau, "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]
    if engine == "MuJoCo":
        return mujoco.__version__
    if engine == "Rapier":
        lock = (HERE / "rapier/Cargo.lock").read_text()
        return "rapier3d-f64 " + lock.split('name = "rapier3d-f64"\nversion = "')[1].split('"')[0]
    return "JoltPhysics.js " + json.loads((HERE / "package.json").read_text())["dependencies"]["jolt-physics"]


def replace(page, tables):
    """Puts each table between its two marks."""
    text = page.read_text()
    for name, made in tables.items():
        begin, end = f"<!-- results: {name} -->", f"<!-- end: {name} -->"
        if begin in text:
            text = re.sub(f"{re.escape(begin)}.*?{re.escape(end)}", lambda _: f"{begin}\n{made}\n{end}", text, flags=re.S)
    page.write_text(text)


if __name__ == "__main__":
    main()
