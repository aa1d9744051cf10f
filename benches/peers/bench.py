"""Drops one pile in moreau, Rapier and MuJoCo and writes a table: time a step, and how good the answers are by one measure.

Started by run.sh, which says what is needed.
"""

import argparse
import csv
import os
import platform
import signal
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np

import mujoco_pile
import pile
import vtp
from measure import Measure

NEWTON_AT_MOST = 1000  # balls; one step of MuJoCo's default solver takes tens of seconds where 5000 balls land


def main():
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("--moreau", type=Path, required=True, help="the program")
    words.add_argument("--rapier", type=Path, required=True, help="the program built in rapier/")
    words.add_argument("--work", type=Path, required=True, help="a folder for files between the programs")
    words.add_argument("--balls", type=int, nargs="+", default=[500, 5000], help="one pile for each number")
    words.add_argument("--steps", type=int, default=480)
    words.add_argument("--step", type=float, default=1 / 240)
    words.add_argument("--budget", type=float, nargs="+", default=[20.0, 36.0], help="seconds for each run, one number a pile")
    words.add_argument("--global", dest="method", default="accelerated", help="moreau's global solver")
    words.add_argument("--tolerances", nargs="+", default=["1e-7", "1e-5", "1e-3"], help="moreau's, of the scaled residual")
    args = words.parse_args()
    if len(args.budget) != len(args.balls):
        words.error("as many numbers after --budget as after --balls")
    head(args)
    for count, budget in zip(args.balls, args.budget):
        table(args, count, budget)


def head(args):
    version = subprocess.run([args.moreau, "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]
    lock = (Path(__file__).parent / "rapier/Cargo.lock").read_text().split('name = "rapier3d-f64"\nversion = "')[1].split('"')[0]
    models = (line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name"))
    cpu = next(models, platform.machine())
    print("# moreau beside Rapier and MuJoCo\n")
    print(f"{cpu}, {os.cpu_count()} cores of which each run has one thread, {os.getloadavg()[0]:.1f} busy before it began.")
    print(f"moreau {version}, rapier3d-f64 {lock}, MuJoCo {mujoco.__version__}, Python {platform.python_version()}.")
    print(f"Made by benches/peers/run.sh {' '.join(options())}".rstrip() + ".\n")
    print((Path(__file__).parent / "about.md").read_text().format(step=args.step, steps=args.steps), end="")


def options():
    """The words of the command that are not places."""
    words, places = sys.argv[1:], ("--moreau", "--rapier", "--work")
    return [w for i, w in enumerate(words) if w not in places and (i == 0 or words[i - 1] not in places)]


def table(args, count, budget):
    radii, centres, width = pile.balls(count)
    measure = Measure(radii, width, args.step)
    every = max(1, args.steps // 40)
    third = args.steps // 3
    print(f"## {count} balls in a box {width:.2f} m wide, at most {budget:g} s a run\n")
    print("| engine | ms a step: fall | landing | rest | deepest overlap / r | at rest: overlap / r | approach / gh | kinetic / mgr | creep / r "
          "| energy gained / mgr |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name, run in engines(args, budget, radii, centres, width, every):
        print(f"{count} balls: {name} ...", file=sys.stderr, flush=True)
        states, seconds = run()
        thirds = [seconds[k * third : (k + 1) * third] for k in range(3)]
        times = [f"{1e3 * np.median(part):.3g}" if len(part) >= third // 4 else "-" for part in thirds]
        done = len(seconds) >= args.steps
        note = "" if done else f", {len(seconds)} steps in the time given"
        print(f"| {name}{note} | {' | '.join(times + judged(measure, states, done))} |", flush=True)
    print()


def judged(measure, states, done):
    """The cells of a row that tell of the answer; who did not come to the end was not at rest."""
    deepest = max(measure.overlap(state) for state in states)
    gained = np.diff([measure.energy(state) for state in states]).max(initial=0.0)
    if not done:
        return [f"{deepest:.1e}", "-", "-", "-", "-", f"{gained:.1e}"]
    rest = states[-(len(states) // 8) :]
    worst = [max(map(f, rest)) for f in (measure.overlap, measure.approach, measure.kinetic)]
    return [f"{x:.1e}" for x in (deepest, *worst, measure.creep(rest[0], rest[-1]), gained)]


def engines(args, budget, radii, centres, width, every):
    """Names, and what runs them: states and seconds."""
    count = len(radii)
    for tolerance in args.tolerances:
        solver = f'{{ global = "{args.method}", start = "warm", criterion = "scaled", tolerance = {tolerance} }}'
        scene = pile.scene(radii, centres, width, args.step, args.steps, every, solver)
        yield f"moreau, {tolerance}", lambda scene=scene, tolerance=tolerance: moreau(args, budget, scene, f"{count}-{tolerance}")
    yield "Rapier", lambda: rapier(args, budget, radii, centres, width, every)
    settings = [args.step, args.steps, every, budget]
    if count <= NEWTON_AT_MOST:
        yield "MuJoCo, Newton (its default)", lambda: mujoco_pile.run(radii, centres, width, *settings, None)
    yield "MuJoCo, CG", lambda: mujoco_pile.run(radii, centres, width, *settings, "CG")


def moreau(args, budget, scene, name):
    """Asked to stop when its time is over, it keeps what it has."""
    out = args.work / f"moreau-{name}"
    file = out.with_suffix(".toml")
    file.write_text(scene)
    words = [args.moreau, "run", file, "--out", out, "--force", "--quiet", "--threads", "1"]
    child = subprocess.Popen(words, stderr=subprocess.PIPE, text=True)
    try:
        child.wait(budget)
    except subprocess.TimeoutExpired:
        child.send_signal(signal.SIGINT)
    error = child.communicate()[1]
    if child.returncode not in (0, 130):
        sys.exit(f"moreau: {error}")
    with open(out / "steps.csv") as table:
        rows = list(csv.DictReader(table))
    unconverged = sum(row["converged"] == "0" for row in rows)
    if unconverged:
        print(f"moreau did not converge in {unconverged} of {len(rows)} steps", file=sys.stderr)
    frames = [vtp.arrays(path) for path in sorted((out / "vtk").glob("bodies_*.vtp"))]
    states = [np.hstack([f["Points"], f["velocity"], f["spin"]])[f["radius"] > 0] for f in frames]
    return np.array(states), np.array([float(row["seconds_step"]) for row in rows])


def rapier(args, budget, radii, centres, width, every):
    balls, out = args.work / "balls.csv", args.work / f"rapier-{len(radii)}"
    balls.write_text("".join(f"{r!r},{x!r},{y!r},{z!r}\n" for r, (x, y, z) in zip(radii.tolist(), centres.tolist())))
    words = [balls, width, args.step, args.steps, every, budget, out]
    subprocess.run([args.rapier, *map(str, words)], check=True)
    states = np.fromfile(f"{out}.states", "<f8").reshape(-1, len(radii), 9)
    return states, np.loadtxt(f"{out}.seconds", ndmin=1)


if __name__ == "__main__":
    main()
