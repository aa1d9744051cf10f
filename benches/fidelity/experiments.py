"""The experiments: scene, time, what is measured, how a row shows it, and what counts as passed."""

from dataclasses import dataclass
from typing import Callable

import numpy as np

import measures

CUBES = [f"c{k}" for k in range(20)]


@dataclass
class Experiment:
    """One scene. `columns` are pairs of a heading and a function of the measures; `headline` is the heading of the summary's column."""

    name: str
    title: str
    duration: float
    measure: Callable
    columns: list
    short: str
    headline: Callable
    error: Callable
    passed: Callable
    rule: str
    step: float = 1e-3
    sample: float = 1e-2


def shown(x, digits=3, sign=""):
    """A number for a table: plain between a thousandth and a hundred thousand; what is below a millionth is said to be."""
    size = abs(x)
    if size == 0:
        return "0"
    if size < 1e-6:
        return "< 1e-6"
    if size < 1e-3 or size >= 1e5:
        return f"{x:{sign}.{digits - 1}e}"
    places = max(0, digits - 1 - int(np.floor(np.log10(size))))
    return f"{x:{sign}.{places}f}"


def mm(key):
    return lambda m: shown(1e3 * m[key])


def percent(key):
    return lambda m: shown(100 * m[key])


def yes(key):
    return lambda m: "yes" if m[key] else "no"


def held(m):
    return "dropped" if m["dropped"] else f"{shown(1e3 * m['slip'], 2)} mm"


def stood(m):
    return f"{shown(1e3 * m['overlap'], 2)} mm" if m["stands"] else "fell"


def rolled(m):
    """Below a degree the disk lies flat; a centre below the ground has sunk through it."""
    if m["height"] < 0:
        return "sank through"
    return "fell flat" if m["tilt"] < 1 else f"{m['tilt']:.2f}°, {shown(100 * (m['energy'] - 1), 2, '+')} %"


def fixed(key, places):
    return lambda m: f"{round(m[key], places) + 0.0:.{places}f}"


def stack(names):
    return lambda run: measures.stack(run, names, 1.0)


def slipped(key):
    return lambda m: "dropped" if m["dropped"] else shown(1e3 * m[key])


SLIP = [("slip in 10 s, mm", slipped("slip")), ("of it in the last 5 s, mm", slipped("late"))]
STAND = [("stands", yes("stands")), ("deepest overlap, mm", mm("overlap")), ("drift of the top, mm", mm("drift"))]
SLIP_RULE = "slip below 1 mm"
STAND_RULE = "it stands, overlap below 1 % of an edge, drift of the top below 10 mm"


def slips(name, title, body, holders):
    measure = lambda run: measures.slip(run, body, holders)
    passed = lambda m: abs(m["slip"]) < 1e-3
    return Experiment(name, title, 10.0, measure, SLIP, f"{name}: slip", held, lambda m: abs(m["slip"]), passed, SLIP_RULE)


def stands(name, title, names, short):
    passed = lambda m: m["stands"] and m["overlap"] < 0.01 and m["drift"] < 0.01
    error = lambda m: m["overlap"] if m["stands"] else float("inf")
    return Experiment(name, title, 10.0, stack(names), STAND, short, stood, error, passed, STAND_RULE)


EXPERIMENTS = [
    Experiment(
        "slide", "A box launched flat", 2.0, measures.slide,
        [("lift, mm", mm("lift")), ("stopping distance, m", fixed("distance", 5)),
         ("error, mm", lambda m: shown(1e3 * (m["distance"] - m["exact"]), sign="+"))],
        "slide: lift", lambda m: f"{shown(1e3 * m['lift'], 2)} mm",
        lambda m: max(m["lift"], abs(m["distance"] - m["exact"])),
        lambda m: m["lift"] < 1e-3 and abs(m["distance"] / m["exact"] - 1) < 0.01,
        "lift below 1 mm, stopping distance within 1 %", sample=2e-3,
    ),
    slips("pinch", "A capsule pinched between two pads", "capsule", ["left", "right"]),
    slips("wall", "A cube held to a wall", "cube", ["wall"]),
    stands("tower", "A tower of twenty cubes", CUBES, "tower: overlap"),
    Experiment(
        "chain", "A chain with a heavy end", 2.0, measures.chain,
        [("joints open by, mm", mm("opening")), ("energy made, %", percent("made")), ("energy at the end, %", lambda m: shown(100 * m["change"], sign="+"))],
        "chain: opening, energy", lambda m: f"{shown(1e3 * m['opening'], 2)} mm, {shown(100 * m['change'], 2, '+')} %",
        lambda m: max(m["opening"] / 1.05, abs(m["change"]), m["made"]),
        lambda m: m["opening"] < 1e-3 and abs(m["change"]) < 0.01 and m["made"] < 0.01,
        "joints open by less than 1 mm, energy within 1 %",
    ),
    Experiment(
        "disk", "Euler's disk", 2.0, measures.disk,
        [("height kept, %", percent("height")), ("tilt (10), degrees", fixed("tilt", 3)), ("energy kept, %", percent("energy"))],
        "disk: tilt, energy", rolled,
        lambda m: max(abs(m["tilt"] / 10 - 1), abs(m["height"] - 1), abs(m["energy"] - 1)),
        lambda m: abs(m["tilt"] - 10) < 0.5 and abs(m["height"] - 1) < 0.05 and abs(m["energy"] - 1) < 0.05,
        "tilt within half a degree, height and energy within 5 %", step=1e-4,
    ),
    Experiment(
        "joint", "A box over a joint of the ground", 1.5, measures.joint,
        [("speed behind (2), m/s", fixed("speed", 4)), ("thrown up by, mm", mm("throw")), ("tilt, degrees", fixed("tilt", 2)), ("gap to the ground, mm", mm("gap"))],
        "joint: speed", lambda m: fixed("speed", 3)(m) + " m/s",
        lambda m: max(abs(m["speed"] / 2 - 1), abs(m["throw"]) / 0.2),
        lambda m: abs(m["speed"] / 2 - 1) < 0.01 and m["throw"] < 1e-3,
        "speed within 1 %, thrown up by less than 1 mm",
    ),
    stands("ratio-1e3", "1 000 kg on 1 kg", ["light", "heavy"], "1e3 : 1, overlap"),
    stands("ratio-1e6", "1 000 000 kg on 1 kg", ["light", "heavy"], "1e6 : 1, overlap"),
]
