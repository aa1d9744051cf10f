"""What states tell of an answer, whoever gave it: places, rotations, velocities and spins at given times, and nothing else.

A run is `time` (frames) and `state` (frames, bodies, 13): position, quaternion w x y z, velocity, spin in the world. Functions return
numbers; what a row shows of them is in experiments.py.
"""

import numpy as np


class Run:
    """States of one run and the scene that they belong to."""

    def __init__(self, scene, numbers):
        bodies = len(scene["bodies"])
        table = np.asarray(numbers).reshape(-1, 1 + 13 * bodies)
        self.scene, self.time, self.state = scene, table[:, 0], table[:, 1:].reshape(-1, bodies, 13)
        self.place, self.velocity, self.spin = self.state[..., :3], self.state[..., 7:10], self.state[..., 10:13]

    def broken(self):
        """True if a number of a free body is missing, or the body is further away than forces could bring it."""
        place = self.state[:, [k for k, body in enumerate(self.scene["bodies"]) if not body["fixed"]]]
        return not np.isfinite(place).all() or np.abs(place[..., :3]).max() > 1e6

    def of(self, name):
        return self.scene["names"].index(name)

    def turn(self):
        """Rotation matrices (frames, bodies, 3, 3)."""
        w, x, y, z = np.moveaxis(self.state[..., 3:7] / np.linalg.norm(self.state[..., 3:7], axis=-1, keepdims=True), -1, 0)
        rows = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
        return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)

    def energy(self):
        """Kinetic and potential energy of all bodies that move, J, in each frame."""
        masses = np.array([mass(b) for b in self.scene["bodies"]])
        inertias = np.array([inertia(b) for b in self.scene["bodies"]])
        local = np.einsum("fbji,fbj->fbi", self.turn(), self.spin)
        kinetic = 0.5 * (masses * (self.velocity**2).sum(-1) + (inertias * local**2).sum(-1))
        return (kinetic - masses * (self.place @ np.array(self.scene["gravity"]))).sum(-1)

    def until(self, start, end):
        """The frames between two times."""
        return (self.time >= start - 1e-9) & (self.time <= end + 1e-9)


def mass(body):
    """kg; 0 of what does not move."""
    if body["fixed"]:
        return 0.0
    (kind, s), = body["shape"].items()
    volume = {
        "box": lambda: np.prod(s),
        "ball": lambda: 4 / 3 * np.pi * s**3,
        "capsule": lambda: np.pi * s[0] ** 2 * (s[1] + 4 / 3 * s[0]),
        "cylinder": lambda: np.pi * s[0] ** 2 * s[1],
    }[kind]()
    return body["density"] * volume


def inertia(body):
    """Moments about the axes of the body, kg m². A capsule's is not asked for in any scene."""
    (kind, s), = body["shape"].items()
    m = mass(body)
    if body["fixed"] or kind == "capsule":
        return np.zeros(3)
    if kind == "box":
        squares = np.square(s)
        return m / 12 * (squares.sum() - squares)
    if kind == "ball":
        return np.full(3, 0.4 * m * s**2)
    across = m * (3 * s[0] ** 2 + s[1] ** 2) / 12
    return np.array([across, across, m * s[0] ** 2 / 2])


def slide(run):
    """How far the box rose above its start, how far it came, and where it should have stopped."""
    place = run.place[:, run.of("box")]
    return {"lift": (place[:, 2] - place[0, 2]).max(), "distance": place[-1, 0] - place[0, 0], "exact": 6.0**2 / (2 * 0.5 * 9.81)}


def slip(run, name, holders):
    """How far a body sank against those that hold it, in all and over the second half; dropped is what sank by more than 3 cm."""
    held = run.place[:, run.of(name), 2] - sum(run.place[:, run.of(h), 2] for h in holders) / len(holders)
    half = len(held) // 2
    return {"slip": held[0] - held[-1], "late": held[half] - held[-1], "dropped": bool(held[0] - held[-1] > 0.03)}


def stack(run, names, edge):
    """Cubes on each other: whether they stand, how far the top moved sideways, the deepest overlap of the last second.

    They stand if none has moved by half an edge over the one below, in any direction.
    """
    place = run.place[:, [run.of(n) for n in names]]
    drift = np.linalg.norm(place[-1, -1, :2] - place[0, -1, :2])
    ground = np.zeros((len(place), 1, 3)) + [*place[0, 0, :2], -edge / 2]
    steps = np.diff(np.concatenate([ground, place], axis=1), axis=1)
    overlap = edge - steps[run.time >= run.time[-1] - 1.0][..., 2]
    beside = np.linalg.norm(steps[-1, 1:, :2], axis=-1)
    stands = beside.max() < edge / 2 and np.abs(overlap).max() < edge / 2
    return {"stands": bool(stands), "drift": drift, "overlap": overlap.max()}


def chain(run):
    """The widest opening of a joint, and energy made and lost, as a part of what the fall of the whole chain could give."""
    turn, widest = run.turn(), 0.0
    for joint in run.scene["joints"]:
        ends = []
        for k in (joint["a"], joint["b"]):
            anchor = np.array(joint["anchor"])
            if k is not None:
                anchor = run.place[:, k] + turn[:, k] @ (anchor - np.array(run.scene["bodies"][k]["position"]))
            ends.append(anchor)
        widest = max(widest, np.linalg.norm(ends[1] - ends[0], axis=-1).max())
    energy = run.energy()
    scale = sum(mass(b) for b in run.scene["bodies"]) * 9.81 * 1.05
    return {"opening": widest, "made": (energy.max() - energy[0]) / scale, "change": (energy[-1] - energy[0]) / scale}


def disk(run):
    """Height, tilt and energy at the end (mean of the last tenth of a second), of the start."""
    k = run.of("disk")
    late = run.time >= run.time[-1] - 0.1
    height, energy = run.place[:, k, 2], run.energy()
    tilt = np.degrees(np.arccos(np.clip(np.abs(run.turn()[:, k, 2, 2]), 0.0, 1.0)))
    return {"height": height[late].mean() / height[0], "tilt": tilt[late].mean(), "energy": energy[late].mean() / energy[0]}


def joint(run):
    """Speed at the end, the gap to the ground before the joint, how far the box is thrown up behind it, and its largest tilt."""
    k = run.of("box")
    height = run.place[:, k, 2]
    before = height[run.until(0.55, 0.65)].mean()
    after = run.time > 0.65
    tilt = np.degrees(np.arccos(np.clip(run.turn()[after, k, 2, 2], -1.0, 1.0)))
    return {"speed": run.velocity[-1, k, 0], "gap": before - 0.1, "throw": height[after].max() - before, "tilt": tilt.max()}
