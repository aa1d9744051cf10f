#!/usr/bin/env python3
"""Bodies that land on a ground of many pieces and slide over ten of its seams, without friction and without a rebound.

    benches/seams/run.py [--program PATH] [--grounds a,b] [--drops 0,0.5] [--steps 1e-3] [--keep FOLDER]

Each scene has a ground, nine bodies that fall from a height (the drop) at 2 m/s along the pieces, and a time step. Once a body has landed it has to keep
2.0 m/s to 1e-6 and its height to 1e-6 m to the end. Prints a line a scene with the greatest errors; exit code 1 if one is too great.
Needs h5py.
"""

import argparse
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py

SPEED, GRAVITY = 2.0, 9.81
PIECE, WIDTH = 0.6, 16.0
# How long all slide after the slowest has landed, and how far that is: over ten seams.
WAY = 10.2 * PIECE
ALLOWED = 1e-6


def body(shape, position, more=""):
    return f'[[bodies]]\nshape.{shape}\nmaterial = "m"\nposition = {list(map(float, position))}\n{more}\n'


def fixed(shape, position, more=""):
    return body(shape, position, 'motion = "fixed"\n' + more)


def points(corners):
    return "[" + ", ".join(str([float(x) for x in corner]) for corner in corners) + "]"


def box(x, turn=""):
    return fixed(f"box = {{ size = [{PIECE}, {WIDTH}, 1.0] }}", [x, 0, -0.5], turn)


def field(x):
    row = str([0.0] * 4)
    heights = ", ".join([row] * 5)
    spacing = f"[{PIECE / 3!r}, {WIDTH / 4!r}]"
    return fixed(f"height_field = {{ spacing = {spacing}, heights = [{heights}] }}", [x - PIECE / 2, -WIDTH / 2, 0])


def mesh(x, count=3):
    xs = [PIECE * (i / count - 0.5) for i in range(count + 1)]
    ys = [WIDTH * (j / 7 - 0.5) for j in range(8)]
    corners = [(a, b, 0) for b in ys for a in xs]
    cells = [(j * len(xs) + i) for j in range(7) for i in range(count)]
    triangles = [t for c in cells for t in ([c, c + 1, c + len(xs) + 1], [c, c + len(xs) + 1, c + len(xs)])]
    return fixed(f"mesh = {{ points = {points(corners)}, triangles = {triangles} }}", [x, 0, 0])


def hull(x, skew=0.4):
    """A slab whose seams run askew."""
    a, b = PIECE / 2, WIDTH / 2
    corners = [(sx * a + sy * skew, sy * b, z) for sx in (-1, 1) for sy in (-1, 1) for z in (-0.5, 0.5)]
    return fixed(f"polyhedron = {{ points = {points(corners)} }}", [x, 0, -0.5])


def compound(places):
    """One body of boxes side by side."""
    middle = sum(places) / len(places)
    parts = ", ".join(
        f"{{ shape.box = {{ size = [{PIECE}, {WIDTH}, 1.0] }}, position = [{x - middle!r}, 0.0, 0.0] }}" for x in places
    )
    return fixed(f"compound = {{ parts = [{parts}] }}", [middle, 0, -0.5])


def pillar(x):
    """A cylinder that lies below the surface beside a box that bears: a neighbour that covers nothing of it, but ends at the same height."""
    low = fixed(f"box = {{ size = [{PIECE}, {WIDTH}, 0.5] }}", [x, 0, -0.25])
    return low + fixed(f"cylinder = {{ radius = 0.2, length = {WIDTH} }}", [x, 0, -0.2],
                       "orientation = { axis = [1.0, 0.0, 0.0], degrees = 90.0 }")


# Wide enough at both ends for the longest body.
PLACES = [PIECE * i for i in range(-3, 14)]
GROUNDS = {
    "boxes": lambda: "".join(map(box, PLACES)),
    "backwards": lambda: "".join(map(box, reversed(PLACES))),
    "fields": lambda: "".join(map(field, PLACES)),
    "meshes": lambda: "".join(map(mesh, PLACES)),
    "hulls": lambda: "".join(map(hull, PLACES)),
    "mixed": lambda: "".join((box, mesh, field)[i % 3](x) for i, x in enumerate(PLACES)),
    "compound": lambda: compound(PLACES),
    "compounds": lambda: compound(PLACES[:4]) + compound(PLACES[4:7]) + compound(PLACES[7:]),
    "on-cylinders": lambda: "".join(map(pillar, PLACES)),
}
LYING = "orientation = { axis = [0.0, 1.0, 0.0], degrees = 90.0 }"
ACROSS = "orientation = { axis = [1.0, 0.0, 0.0], degrees = 90.0 }"
YAW = "orientation = { axis = [0.0, 0.0, 1.0], degrees = 30.0 }"
PRISM = points([(x, y, z) for x, y in ((-0.1, -0.1), (0.12, -0.08), (0.1, 0.1), (0.0, 0.13), (-0.09, 0.07)) for z in (-0.1, 0.1)])
# Each with half its height.
BODIES = [
    ("ball = { radius = 0.1 }", 0.1, ""),
    ("capsule = { radius = 0.1, length = 0.3 }", 0.1, LYING),
    ("capsule = { radius = 0.1, length = 0.3 }", 0.1, ACROSS),
    ("box = { size = [0.2, 0.2, 0.2] }", 0.1, ""),
    ("box = { size = [0.2, 0.2, 0.2] }", 0.1, YAW),
    ("cylinder = { radius = 0.1, length = 0.2 }", 0.1, ""),
    ("cylinder = { radius = 0.1, length = 0.2 }", 0.1, ACROSS),
    ("box = { size = [1.3, 0.3, 0.1] }", 0.05, ""),
    (f"polyhedron = {{ points = {PRISM} }}", 0.1, ""),
]


def scene(ground, drop, h, acts, tolerance):
    """Returns a scene and the time when all have landed."""
    fall = (2 * drop / GRAVITY) ** 0.5
    landed = fall + 0.05 + 4 * h
    time = landed + WAY / SPEED
    # One step in so many is looked at.
    every = max(1, round(0.02 / h))
    text = f"""dimension = 3
gravity = [0.0, 0.0, {-GRAVITY}]
time = {{ step = {h!r}, steps = {round(time / h)} }}
solver = {{ tolerance = {tolerance!r} }}
materials.m.density = 1000.0
default_law.coulomb = {{ friction = 0.0, acts = "{acts}" }}
output = {{ every = {every}, precision = "double", kinds = ["steps", "trajectory"] }}
""" + GROUNDS[ground]()
    for i, (shape, half, turn) in enumerate(BODIES):
        x, y = -0.15 + 0.031 * i - SPEED * fall, 1.5 * (i - len(BODIES) // 2)
        text += f'[[bodies]]\nname = "b{i}"\nshape.{shape}\nmaterial = "m"\nposition = [{x!r}, {y!r}, {half + drop!r}]\nvelocity = [{SPEED}, 0.0, 0.0]\n{turn}\n'
    return text, landed


def judge(folder, landed):
    """Returns the greatest change of speed and of height, and the body of the worst, of frames after the landing."""
    with h5py.File(folder / "trajectory.h5") as file:
        frames = len(file["frames/time"])
        take = lambda name: file[f"frames/{name}"][:].reshape(frames, -1, 3)[:, -len(BODIES):]
        time, position, velocity = file["frames/time"][:], take("position"), take("velocity")
    after = time > landed
    speed = abs(velocity[after] - [SPEED, 0.0, 0.0]).max(axis=(0, 2))
    height = position[after][:, :, 2]
    change = height.max(axis=0) - height.min(axis=0)
    fault = [max(a, b) for a, b in zip(speed, change)]
    return speed.max(), change.max(), fault.index(max(fault))


def run(program, folder, name, text, landed):
    path = folder / f"{name}.toml"
    path.write_text(text)
    words = [program, "run", path, "--out", folder / name, "--force", "--quiet", "--threads", "1"]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        return f"{name}: {done.stderr.strip()}", False
    speed, change, worst = judge(folder / name, landed)
    shutil.rmtree(folder / name)
    right = speed <= ALLOWED and change <= ALLOWED
    return f"{name:32} speed {speed:.1e} m/s, height {change:.1e} m" + ("" if right else f"  WRONG, body {worst}"), right


def numbers(text):
    return [float(x) for x in text.split(",")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="target/release/moreau")
    parser.add_argument("--grounds", default=",".join(GROUNDS), type=lambda text: text.split(","))
    parser.add_argument("--drops", default="0,0.05,0.5", type=numbers)
    parser.add_argument("--steps", default="1e-2,1e-3,1e-4", type=numbers)
    parser.add_argument("--acts", default="approach", choices=["approach", "closed"])
    parser.add_argument("--tolerance", default=1e-9, type=float)
    parser.add_argument("--keep", type=Path, help="the folder for scenes, in place of one that is removed")
    args = parser.parse_args()
    folder = args.keep or Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    cases = [(f"{ground}-{drop:g}-{h:g}", *scene(ground, drop, h, args.acts, args.tolerance)) for h in args.steps for ground in args.grounds for drop in args.drops]
    with ThreadPoolExecutor(2) as pool:
        results = pool.map(lambda case: run(args.program, folder, *case), cases)
        wrong = 0
        for line, right in results:
            print(line, flush=True)
            wrong += not right
    if args.keep is None:
        shutil.rmtree(folder)
    print(f"{len(cases)} scenes, {wrong} wrong")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
