"""The pile that all engines drop: balls on a loose lattice over a box without a lid, the same numbers for each."""

import numpy as np

DENSITY, FRICTION, GRAVITY = 2500.0, 0.3, 9.81
SPACING, LAYERS = 0.26, 8


def balls(count):
    """Radii and centres of `count` balls of 8 to 12 cm, shaken by 1 cm off a cubic lattice, and the width of their box."""
    columns = round((count / LAYERS) ** 0.5)
    layers = -(-count // columns**2)
    random = np.random.default_rng(1)
    lattice = np.array([(i, j, k) for k in range(layers) for i in range(columns) for j in range(columns)][:count])
    centres = (lattice + 0.5) * SPACING + random.uniform(-0.01, 0.01, (count, 3))
    return random.uniform(0.08, 0.12, count), centres, columns * SPACING


def walls(width):
    """Points and inward normals of the floor and the four walls."""
    return [
        ((0, 0, 0), (0, 0, 1)),
        ((0, 0, 0), (1, 0, 0)),
        ((0, 0, 0), (0, 1, 0)),
        ((width, width, 0), (-1, 0, 0)),
        ((width, width, 0), (0, -1, 0)),
    ]


def scene(radii, centres, width, step, steps, every, solver):
    """The scene file for moreau; `solver` is TOML for its table of that name."""
    text = f"""dimension = 3
gravity = [0.0, 0.0, {-GRAVITY}]
time = {{ step = {step!r}, steps = {steps} }}
solver = {solver}
output = {{ every = {every} }}
materials.stone.density = {DENSITY}
default_law.coulomb = {{ friction = {FRICTION}, restitution = 0.0, acts = "approach" }}
"""
    for point, normal in walls(width):
        text += body(f"half_space = {{ normal = {floats(normal)} }}", point)
    for radius, centre in zip(radii.tolist(), centres.tolist()):
        text += body(f"ball = {{ radius = {radius!r} }}", centre)
    return text


def body(shape, position):
    return f'\n[[bodies]]\nshape.{shape}\nmaterial = "stone"\nposition = {floats(position)}\n'


def floats(numbers):
    return [float(x) for x in numbers]


def mjcf(radii, centres, width, step):
    """The model for MuJoCo: all options are its own but the step."""
    surface = f'friction="{FRICTION} 0.005 0.0001" density="{DENSITY}"'
    text = f'<mujoco><option timestep="{step!r}" gravity="0 0 {-GRAVITY}"/><size memory="4G"/><worldbody>\n'
    for point, normal in walls(width):
        text += f'<geom type="plane" size="0 0 1" pos="{words(point)}" zaxis="{words(normal)}" {surface}/>\n'
    for radius, centre in zip(radii.tolist(), centres.tolist()):
        text += f'<body pos="{words(centre)}"><freejoint/><geom type="sphere" size="{radius!r}" {surface}/></body>\n'
    return text + "</worldbody></mujoco>\n"


def words(numbers):
    return " ".join(repr(float(x)) for x in numbers)
