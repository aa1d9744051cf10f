#!/usr/bin/env python3
"""What the default tolerance does from micrometres to kilometres: the table of docs/choosing.md.

    benches/defaults/run.py [PROGRAM [FOLDER]]        needs h5py

Rest: five cubes on each other. Slide: a cube on a slope of 30 degrees. Settle: 150 balls in a box. Friction 0.3; steps grow with the root of the size.
"""

import json
import math
import shutil
import subprocess
import sys
from pathlib import Path

import h5py

PROGRAM = sys.argv[1] if len(sys.argv) > 1 else "target/release/moreau"
FOLDER = Path(sys.argv[2] if len(sys.argv) > 2 else "target/defaults")
GRAVITY, FRICTION, SLOPE = 9.81, 0.3, math.pi / 6
STEPS = {"rest": 4000, "slide": 2000, "settle": 4000}

HEAD = """dimension = 3
gravity = [{x!r}, 0.0, {z!r}]
time = {{ step = {h!r}, steps = {steps} }}
solver.tolerance = {tolerance}
materials.stone.density = 2000.0
default_law.coulomb = {{ friction = {friction} }}
output = {{ every = {steps}, precision = "double", kinds = ["steps", "trajectory"] }}
"""
GROUND = """
[[bodies]]
motion = "fixed"
shape.half_space = { normal = [0.0, 0.0, 1.0] }
material = "stone"
position = [0.0, 0.0, 0.0]
"""
CUBE = """
[[bodies]]
shape.box = {{ size = [{size!r}, {size!r}, {size!r}] }}
material = "stone"
position = [0.0, 0.0, {height!r}]
"""
BALLS = """
[[containers]]
min = [0.0, 0.0, 0.0]
max = [{side!r}, {side!r}, {high!r}]
open = ["+z"]
material = "stone"

[[generate]]
material = "stone"
radii.uniform = {{ min = {least!r}, max = {most!r} }}
count = 150
seed = 1
packing = {{ min = [0.0, 0.0, 0.0], max = [{side!r}, {side!r}, {filled!r}], tries = 20000 }}
"""


def scene(kind, size, tolerance):
    """Returns the text of a scene and the length of its step."""
    h = (2e-3 if kind == "settle" else 1e-3) * math.sqrt(size)
    slope = SLOPE if kind == "slide" else 0.0
    head = HEAD.format(
        x=GRAVITY * math.sin(slope), z=-GRAVITY * math.cos(slope), h=h, steps=STEPS[kind], tolerance=tolerance, friction=FRICTION
    )
    if kind == "settle":
        lengths = {"side": 6.0, "high": 40.0, "least": 0.4, "most": 0.5, "filled": 12.0}
        return head + BALLS.format(**{name: size * length for name, length in lengths.items()}), h
    cubes = range(5) if kind == "rest" else range(1)
    return head + GROUND + "".join(CUBE.format(size=size, height=(0.5 + i) * size) for i in cubes), h


def finding(kind, size, h, trajectory, summary):
    """Returns what the table says of a run."""
    frames, bodies = len(trajectory["frames/time"]), len(trajectory["bodies/mass"])
    position = trajectory["frames/position"][:].reshape(frames, bodies, -1)
    if kind == "rest":
        return f"top sank {(position[0, -1, 2] - position[-1, -1, 2]) / size:.1e} L"
    if kind == "slide":
        way = 0.5 * GRAVITY * (math.sin(SLOPE) - FRICTION * math.cos(SLOPE)) * (h * STEPS[kind]) ** 2
        return f"error of the way {position[-1, -1, 0] / way - 1.0:.1e}"
    created = summary["energy"]["created"]
    return f"created {created['total'] / created['turnover']:.1e}"


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    for kind in STEPS:
        for tolerance in ("1e-3", "1e-4", "1e-5"):
            for size in (1e-6, 1e-3, 1.0, 1e3):
                text, h = scene(kind, size, tolerance)
                name = f"{kind}_{tolerance}_{size:g}"
                (FOLDER / f"{name}.toml").write_text(text)
                shutil.rmtree(FOLDER / name, ignore_errors=True)
                subprocess.run([PROGRAM, "run", FOLDER / f"{name}.toml", "--out", FOLDER / name, "--quiet"], check=True)
                summary = json.loads((FOLDER / name / "summary.json").read_text())
                with h5py.File(FOLDER / name / "trajectory.h5") as trajectory:
                    found = finding(kind, size, h, trajectory, summary)
                print(
                    f"{kind:6} {tolerance} {size:8g} m: {found}, {summary['sweeps_mean']:.1f} sweeps a step, "
                    f"overlap {summary['overlap_max']:.1e}, {summary['unconverged_steps']} steps unconverged",
                    flush=True,
                )


main()
