#!/usr/bin/env python3
"""The order of convergence of bodies of each shape that roll, stick and slide in lasting contact: the table of validation/13-order-of-convergence.

    benches/orders/run.py [PROGRAM [FOLDER]]

Each scene is run at 4, 2, 1, 1/2 and 1/4 ms (`moreau run --convergence 4`); the orders are those that the last two differences tell. Needs Python alone.
"""

import math
import subprocess
import sys
from pathlib import Path

PROGRAM = sys.argv[1] if len(sys.argv) > 1 else "target/release/moreau"
FOLDER = Path(sys.argv[2] if len(sys.argv) > 2 else "target/orders")

TILT = math.radians(25.0)
# Half sides of the boxes, m.
A, B, C = 0.15, 0.1, 0.06
EDGE = A * math.sin(TILT) + C * math.cos(TILT)
AXIS_Y = "orientation = { axis = [0.0, 1.0, 0.0], degrees = 25.0 }"
LYING = "orientation = { axis = [1.0, 0.0, 0.0], degrees = 90.0 }"
BOX = f"box.size = [{2 * A}, {2 * B}, {2 * C}]"
WEDGE = (
    f"polyhedron.points = [[{-A}, {-B}, {-C}], [{A}, {-B}, {-C}], [{A}, {B}, {-C}], [{-A}, {B}, {-C}], "
    f"[{-A}, {-B}, {C}], [{A}, {-B}, {C}], [{A}, {B}, {C}], [{-A}, {B}, {C}]]"
)
PAIR = (
    f"compound.parts = [{{ shape.box.size = [{A}, {2 * B}, {2 * C}], position = [{-A / 2}, 0.0, 0.0] }}, "
    f"{{ shape.box.size = [{A}, {2 * B}, {2 * C}], position = [{A / 2}, 0.0, 0.0] }}]"
)


def rim(radius, half, degrees, rate):
    """A disk that rolls steadily on its rim: position, orientation, velocity and spin (Euler's disk, centre at rest where it leans most)."""
    tilt = math.radians(degrees)
    return (
        f"position = [0.0, 0.0, {radius * math.sin(tilt) + half * math.cos(tilt)!r}]\n"
        f"orientation = {{ axis = [0.0, 1.0, 0.0], degrees = {degrees!r} }}\nspin = [{rate!r}, 0.0, 0.0]"
    )


# Name, what it does, shape, friction, the rest of the body.
SPACE = [
    ("ball", "rolls", "ball.radius = 0.1", 1.0, "position = [0.0, 0.0, 0.1]\nvelocity = [1.0, 0.0, 0.0]\nspin = [0.0, 10.0, 3.0]\n"
     "drive = [{ force = [0.0, { sine = { amplitude = 20.0, frequency = 2.0 } }, 0.0] }]"),
    ("ball", "slides", "ball.radius = 0.1", 0.1, "position = [0.0, 0.0, 0.1]\nvelocity = [2.0, 0.5, 0.0]\nspin = [0.0, 0.0, 5.0]"),
    ("box", "turns about an edge that sticks", BOX, 1.0, f"position = [0.0, 0.0, {EDGE!r}]\n{AXIS_Y}"),
    ("box", "turns about an edge that slides", BOX, 0.1, f"position = [0.0, 0.0, {EDGE!r}]\n{AXIS_Y}\nvelocity = [3.0, 0.0, 0.0]"),
    ("box", "slides on a face and turns", BOX, 0.2, f"position = [0.0, 0.0, {C}]\nvelocity = [2.0, 0.0, 0.0]\nspin = [0.0, 0.0, 2.0]"),
    ("polyhedron", "turns about an edge that sticks", WEDGE, 1.0, f"position = [0.0, 0.0, {EDGE!r}]\n{AXIS_Y}"),
    ("polyhedron", "turns about an edge that slides", WEDGE, 0.1, f"position = [0.0, 0.0, {EDGE!r}]\n{AXIS_Y}\nvelocity = [3.0, 0.0, 0.0]"),
    ("compound", "turns about an edge that sticks", PAIR, 1.0, f"position = [0.0, 0.0, {EDGE!r}]\n{AXIS_Y}"),
    ("capsule", "rolls", "capsule = { radius = 0.05, length = 0.2 }", 1.0,
     f"position = [0.0, 0.0, 0.05]\n{LYING}\nvelocity = [1.0, 0.0, 0.0]\nspin = [0.0, 20.0, 0.0]\n"
     "drive = [{ force = [{ sine = { amplitude = 10.0, frequency = 2.0 } }, 0.0, 0.0] }]"),
    ("capsule", "slides and turns", "capsule = { radius = 0.05, length = 0.2 }", 0.2,
     f"position = [0.0, 0.0, 0.05]\n{LYING}\nvelocity = [2.0, 1.0, 0.0]\nspin = [0.0, 0.0, 2.0]"),
    ("cylinder", "rolls on its side", "cylinder = { radius = 0.05, length = 0.2 }", 1.0,
     f"position = [0.0, 0.0, 0.05]\n{LYING}\nvelocity = [1.0, 0.0, 0.0]\nspin = [0.0, 20.0, 0.0]\n"
     "drive = [{ force = [{ sine = { amplitude = 10.0, frequency = 2.0 } }, 0.0, 0.0] }]"),
    ("cylinder", "slides on its side and turns", "cylinder = { radius = 0.05, length = 0.2 }", 0.2,
     f"position = [0.0, 0.0, 0.05]\n{LYING}\nvelocity = [2.0, 1.0, 0.0]\nspin = [0.0, 0.0, 2.0]"),
    ("cylinder", "falls over on its rim, which sticks", "cylinder = { radius = 0.05, length = 0.3 }", 1.0,
     f"position = [0.0, 0.0, {0.05 * math.sin(0.3) + 0.15 * math.cos(0.3)!r}]\norientation = {{ axis = [0.0, 1.0, 0.0], degrees = {math.degrees(0.3)!r} }}\n"
     "spin = [0.2, 0.0, 0.0]"),
]
PLANE = [
    ("disk", "rolls", "disk.radius = 0.1", 1.0, "position = [0.0, 0.1]\nvelocity = [1.0, 0.0]\nspin = -10.0\n"
     "drive = [{ force = [{ sine = { amplitude = 100.0, frequency = 2.0 } }, 0.0] }]"),
    ("disk", "slides", "disk.radius = 0.1", 0.1, "position = [0.0, 0.1]\nvelocity = [2.0, 0.0]"),
    ("box", "turns about a corner that sticks", f"box.size = [{2 * A}, {2 * C}]", 1.0, f"position = [0.0, {EDGE!r}]\norientation = {-TILT!r}"),
    ("box", "turns about a corner that slides", f"box.size = [{2 * A}, {2 * C}]", 0.1,
     f"position = [0.0, {EDGE!r}]\norientation = {-TILT!r}\nvelocity = [3.0, 0.0]"),
    ("polygon", "turns about a corner that sticks", f"polygon.vertices = [[{-A}, {-C}], [{A}, {-C}], [{A}, {C}], [{-A}, {C}]]", 1.0,
     f"position = [0.0, {EDGE!r}]\norientation = {-TILT!r}"),
    ("capsule", "rolls on its end", "capsule = { radius = 0.05, length = 0.2 }", 1.0,
     f"position = [0.0, {0.05 + 0.1 * math.sin(0.6)!r}]\norientation = 0.6"),
]


def scene(dimension, shape, friction, body):
    up = [0.0] * (dimension - 1) + [1.0]
    ground = "half_space" if dimension == 3 else "half_plane"
    return (
        f"dimension = {dimension}\ngravity = {[-9.81 * x for x in up]}\ntime = {{ step = 4e-3, steps = 30 }}\nsolver.tolerance = 1e-12\n"
        f"materials.m.density = 1000.0\ndefault_law.coulomb.friction = {friction}\n[[bodies]]\nmotion = \"fixed\"\nshape.{ground}.normal = {up}\n"
        f"material = \"m\"\nposition = {[0.0] * dimension}\n[[bodies]]\nname = \"it\"\nmaterial = \"m\"\nshape.{shape}\n{body}\n"
    )


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    print("| | shape | | position, m | order | velocity, m/s | order |\n|---|---|---|---|---|---|---|")
    for dimension, scenes in ((3, SPACE), (2, PLANE)):
        for i, (name, does, shape, friction, body) in enumerate(scenes):
            file = FOLDER / f"{dimension}-{i:02}-{name}.toml"
            file.write_text(scene(dimension, shape, friction, body))
            ran = subprocess.run(
                [PROGRAM, "run", file, "--convergence", "4", "--out", FOLDER / file.stem], capture_output=True, text=True, check=False
            )
            if ran.returncode:
                sys.exit(f"{file}: {ran.stderr}")
            last = ran.stdout.strip().splitlines()[-1].split()
            print(f"| {dimension}D | {name} | {does} | {last[3]} | {last[4]} | {last[5]} | {last[6]} |", flush=True)


main()
