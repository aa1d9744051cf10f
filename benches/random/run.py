#!/usr/bin/env python3
"""Random small scenes, each run and held to what moreau promises of any scene.

    benches/random/run.py [--program PATH] [--count N] [--seed S] [--keep FOLDER]

A scene has two to nine bodies of one size from a micrometre to a kilometre and a law, and often drives, joints, ratios of mass up to a million. It is held
to four things:

- a run ends well, or with a message; no number of it is NaN or infinite;
- the ledger closes to 1e-9 of its largest number;
- energy that appears (kinetic, potential and dissipated, less the work of drives and loads) is reported as created;
- no overlap is deeper than a thousandth of the smaller radius, unless steps are reported that did not converge.

Prints a line for each scene that fails one, and a summary; exit code 1 if any does. Needs Python alone.
"""

import argparse
import csv
import json
import math
import random
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

OVERLAP = 1.001e-3
LEDGER = 1e-9


def vector(numbers):
    return "[" + ", ".join(repr(float(x)) for x in numbers) + "]"


def shape(rng, dimension, size):
    """Returns a shape in a ball of radius `size`."""
    a, b = size * rng.uniform(0.3, 0.55), size * rng.uniform(0.3, 0.55)
    if dimension == 2:
        return rng.choice([
            f"disk = {{ radius = {0.9 * size!r} }}",
            f"box = {{ size = {vector([2 * a, 2 * b])} }}",
            f"capsule = {{ radius = {0.4 * size!r}, length = {size!r} }}",
            f"polygon = {{ vertices = [{vector([-a, -b])}, {vector([a, -b])}, {vector([0.4 * a, b])}, {vector([-0.6 * a, b])}] }}",
        ])
    return rng.choice([
        f"ball = {{ radius = {0.9 * size!r} }}",
        f"box = {{ size = {vector([2 * a, 2 * b, 1.2 * size])} }}",
        f"capsule = {{ radius = {0.4 * size!r}, length = {size!r} }}",
        f"cylinder = {{ radius = {0.5 * size!r}, length = {0.9 * size!r} }}",
    ])


def law(rng):
    acts = rng.choice(["", "", "", ', acts = "closed"'])
    restitution = rng.choice([0.0, 0.0, 0.3, 0.8, 1.0])
    kind = rng.random()
    if kind < 0.15:
        return f"frictionless = {{ restitution = {restitution}{acts} }}"
    if kind < 0.2:
        return f"sticking = {{ restitution = 0.0{acts} }}"
    return f"coulomb = {{ friction = {rng.choice([0.1, 0.3, 0.6, 1.0])}, restitution = {restitution}{acts} }}"


def scene(rng):
    """Returns the text of a scene."""
    dimension = rng.choice([2, 3])
    size = 10.0 ** rng.uniform(-6.0, 3.0)
    falls = math.sqrt(size / 9.81)
    up = dimension - 1
    spread = 10.0 ** rng.uniform(0.0, 6.0)
    # In a step a body that has fallen by a few sizes goes 0.05 of them or less.
    h = falls * 10.0 ** rng.uniform(-3.0, -1.7)
    gravity = [0.0] * dimension
    gravity[up] = -9.81
    lines = [
        f"dimension = {dimension}",
        f"gravity = {vector(gravity)}",
        f"time = {{ step = {h!r}, steps = 300 }}",
        f'solver = {{ global = "{rng.choice(["accelerated", "accelerated", "auto", "nlgs"])}", max_sweeps = 20000 }}',
        "materials.light.density = 1000.0",
        f"materials.heavy.density = {1000.0 * spread!r}",
        f"default_law.{law(rng)}",
        'output = { every = 300, kinds = ["steps"] }',
    ]
    normal = [0.0] * dimension
    normal[up] = 1.0
    ground = "half_plane" if dimension == 2 else "half_space"
    lines += ["[[bodies]]", 'name = "ground"', f"shape.{ground}.normal = {vector(normal)}", 'material = "light"',
              f"position = {vector([0.0] * dimension)}", 'motion = "fixed"']
    count = rng.randrange(1, 9)
    places = []
    for i in range(count):
        place = [size * 2.3 * (i % 3 + rng.uniform(-0.1, 0.1)), size * 2.3 * (i // 3) + size * rng.uniform(1.05, 1.3)]
        if dimension == 3:
            place.insert(1, size * rng.uniform(-0.2, 0.2))
        places.append(place)
        lines += ["[[bodies]]", f'name = "b{i}"', f"shape.{shape(rng, dimension, size)}",
                  f'material = "{rng.choice(["light", "light", "heavy"])}"', f"position = {vector(place)}",
                  f"velocity = {vector(rng.gauss(0.0, 1.5 * size / falls) for _ in range(dimension))}"]
        if dimension == 3:
            lines += [f"orientation = {{ axis = {vector(rng.gauss(0, 1) for _ in range(3))}, degrees = {rng.uniform(0, 180)!r} }}",
                      f"spin = {vector(rng.gauss(0.0, 1.0 / falls) for _ in range(3))}"]
        else:
            lines += [f"orientation = {rng.uniform(0, 3)!r}", f"spin = {rng.gauss(0.0, 1.0 / falls)!r}"]
    if rng.random() < 0.3:
        # A paddle beside them swings about its middle.
        place = [-2.8 * size] + [0.0] * (dimension - 2) + [3.0 * size]
        sides = [0.5 * size] + [4.0 * size] * (dimension - 1)
        sine = f"{{ sine = {{ amplitude = {rng.uniform(0.1, 0.5) / falls!r}, frequency = {rng.uniform(0.05, 0.3) / falls!r} }} }}"
        lines += ["[[bodies]]", 'name = "paddle"', f"shape.box.size = {vector(sides)}", 'material = "light"',
                  f"position = {vector(place)}", "[[bodies.drive]]", f"spin = {sine}"]
        lines += ["axis = [0.0, 1.0, 0.0]"] if dimension == 3 else []
    if rng.random() < 0.35 and count > 1:
        for i in range(rng.randrange(1, count)):
            middle = [0.5 * (a + b) for a, b in zip(places[i], places[i + 1])]
            kind = rng.choice(["ball", "hinge", "fixed", "slider", "distance"])
            axis = f"axis = {vector([0.0, 1.0, 0.0][:dimension] if dimension == 3 else [0.0, 1.0])}"
            text = {
                "ball": f"kind.{'ball' if dimension == 3 else 'hinge'} = {{ anchor = {vector(middle)} }}",
                "hinge": f"kind.hinge = {{ anchor = {vector(middle)}{', ' + axis if dimension == 3 else ''} }}",
                "fixed": "kind.fixed = {}",
                "slider": f"kind.slider = {{ {axis} }}",
                "distance": f"kind.distance = {{ from = {vector(places[i])}, to = {vector(places[i + 1])} }}",
            }[kind]
            lines += ["[[joints]]", text, f'between = ["b{i}", "b{i + 1}"]']
    return "\n".join(lines) + "\n"


def faults(folder):
    """Returns what is wrong with a finished run."""
    summary = json.loads((folder / "summary.json").read_text())
    with open(folder / "steps.csv", encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    numbers = [float(x) for row in rows for x in row.values() if x]
    found = []
    if not all(math.isfinite(x) for x in numbers):
        found.append("a number is not finite")
    energy = summary["energy"]
    scale = max((abs(float(row[name])) for row in rows for name in ("kinetic", "potential", "work", "dissipated")), default=0.0)
    if summary["energy"]["balance_error_max"] > LEDGER * scale:
        found.append(f"the ledger is open by {energy['balance_error_max']:.1e} of {scale:.1e} J")
    created = energy["created"]["total"]
    gained = max((-float(row["dissipated"]) for row in rows), default=0.0)
    if gained > created + 1e-9 * scale:
        found.append(f"{gained:.1e} J appeared, {created:.1e} J are reported")
    # Words, and not numbers alone, where it is more than rounding.
    if created > 1e-2 * energy["created"]["turnover"] and summary["verdict"]["reliable"]:
        found.append(f"{created:.1e} J were created, the verdict does not say so")
    if summary["overlap_max"] > OVERLAP and summary["unconverged_steps"] == 0:
        found.append(f"overlap {summary['overlap_max']:.1e}")
    return found, summary


def run(program, folder, seed):
    text = scene(random.Random(seed))
    path, out = folder / f"{seed}.toml", folder / str(seed)
    path.write_text(text)
    shutil.rmtree(out, ignore_errors=True)
    try:
        ran = subprocess.run(
            [program, "run", path, "--out", out, "--quiet", "--threads", "1"], capture_output=True, text=True, timeout=300, check=False
        )
    except subprocess.TimeoutExpired:
        return seed, "slow", ["not done in 300 s"]
    if ran.returncode not in (0, 4):
        return seed, "failed", [f"exit code {ran.returncode}: {ran.stderr.strip()[:200]}"]
    if ran.returncode == 4:
        return seed, "ended with a message", [] if ran.stderr.startswith("error: ") else [ran.stderr[:200]]
    found, summary = faults(out)
    kind = "relied on" if summary["verdict"]["reliable"] else "said to be wrong"
    return seed, kind, found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="target/release/moreau")
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--keep", type=Path)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = given.keep or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        kinds, bad = {}, 0
        with ThreadPoolExecutor(given.jobs) as pool:
            seeds = range(given.seed, given.seed + given.count)
            for seed, kind, found in pool.map(lambda seed: run(given.program, folder, seed), seeds):
                kinds[kind] = kinds.get(kind, 0) + 1
                bad += bool(found)
                if found:
                    print(f"scene {seed} ({kind}): {'; '.join(found)}", flush=True)
    print(f"{given.count} scenes: " + ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items())) + f"; {bad} break a promise")
    sys.exit(bad > 0)


main()
