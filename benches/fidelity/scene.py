"""Reads a scene file of moreau into plain numbers that every engine is given.

Only what the scenes of this folder use is understood; all else is an error.
"""

import json
import math
import tomllib


def read(path):
    """Returns the scene as a dictionary: gravity, friction, bodies, joints, step (s), steps."""
    with open(path, "rb") as file:
        words = tomllib.load(file)
    law = words["default_law"]
    bodies = [body(entry, words["materials"]) for entry in words["bodies"]]
    names = [entry["name"] for entry in words["bodies"]]
    return {
        "title": words["title"],
        "gravity": words["gravity"],
        "friction": law["coulomb"]["friction"] if "coulomb" in law else 0.0,
        # Where a scene is about joints alone, nothing touches.
        "collide": "coulomb" in law,
        "names": names,
        "bodies": bodies,
        "joints": [joint(entry, names, bodies) for entry in words.get("joints", [])],
        "step": words["time"]["step"],
        "steps": words["time"]["steps"],
    }


def body(entry, materials):
    known = {"name", "shape", "material", "position", "orientation", "velocity", "spin", "force", "motion"}
    assert set(entry) <= known, set(entry) - known
    (kind, sizes), = entry["shape"].items()
    shapes = {
        "box": lambda s: s["size"],
        "ball": lambda s: s["radius"],
        "capsule": lambda s: [s["radius"], s["length"]],
        "cylinder": lambda s: [s["radius"], s["length"]],
        "half_space": lambda s: s["normal"],
    }
    zero = [0.0, 0.0, 0.0]
    return {
        "shape": {kind: shapes[kind](sizes)},
        "density": materials[entry["material"]]["density"],
        "fixed": kind == "half_space" or entry.get("motion") == "fixed",
        "position": entry["position"],
        "quaternion": quaternion(entry.get("orientation")),
        "velocity": entry.get("velocity", zero),
        "spin": entry.get("spin", zero),
        "force": entry.get("force", zero),
    }


def quaternion(orientation):
    """w, x, y, z."""
    if orientation is None:
        return [1.0, 0.0, 0.0, 0.0]
    half = math.radians(orientation["degrees"]) / 2
    length = math.hypot(*orientation["axis"])
    return [math.cos(half)] + [math.sin(half) * x / length for x in orientation["axis"]]


def joint(entry, names, bodies):
    """Returns a ball joint, or a slider with its axis; `a` is None for the world."""
    (kind, what), = entry["kind"].items()
    a, b = ([None] + [names.index(name) for name in entry["between"]])[-2:]
    if kind == "ball":
        return {"a": a, "b": b, "anchor": what["anchor"], "axis": None}
    assert kind == "slider", kind
    return {"a": a, "b": b, "anchor": bodies[b]["position"], "axis": what["axis"]}


def write(scene, settings, step, duration, sample, path):
    """Writes the scene for an engine: with a time step, and a state noted each `sample` seconds."""
    steps = round(duration / step)
    every = max(1, round(sample / step))
    with open(path, "w") as file:
        json.dump(scene | {"step": step, "steps": steps, "every": every, "settings": settings}, file)
    return steps, every
