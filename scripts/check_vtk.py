#!/usr/bin/env python3
"""Opens the ParaView files of a run with VTK itself and holds them against the run's table of steps.

    check_vtk.py DIR

reads every .pvd in DIR/vtk (or in DIR where there is no such folder), each file that it lists, and DIR/steps.csv (or
the one beside DIR). It needs `pip install vtk`. What is checked:

  every series   VTK reads each file without a word of complaint; the file's TimeValue is the time in the .pvd
  bodies.pvd     radius, velocity (3), spin (3), material (integer), id (integer): one finite tuple for each point, as
                 many points as the column `bodies` says; if there is `mass`, the sum of m v^2 / 2 is no more than the
                 column `kinetic`, which also counts the energy of spin
  contacts.pvd   normal (3, of unit length), gap, impulse (3), normal_impulse, status (integer), bodies (2 integers), as
                 many points as `contacts` says; the first 500 lie on the surfaces of both bodies, balls or polygons, but
                 for the gap and the way of a step (and, where the scene has a max_penetration, for the column `penetration`:
                 bodies are then moved apart after the step)
  shapes.pvd     id, material, free, speed, spin, kinetic_energy, one for each cell; the polygons of each free body are
                 within its radius, closed, and enclose its mass at the density of the scene.toml beside the table
                 (to 5 % where they stand for something curved, or for a mesh that was cut into convex pieces)
  interfaces.pvd what the contacts of the frame come down to, pair by pair: force and centre of pressure; each line of
                 thrust leads from one interface of a free body to another

A frame is held against the row of nearest time. Counts of contacts and energies change from step to step, so these are
compared only where that row is of the frame's own instant (the first frame of a run is before the first step and may
have none); a series in which no frame has its own row fails.
"""

import argparse
import csv
import math
import sys
import tomllib
import xml.etree.ElementTree as ET
from bisect import bisect_left
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

INTEGERS = "biu"  # numpy's kinds: bool, signed, unsigned
FLOATS = "f"
BODIES = {"radius": (1, FLOATS), "velocity": (3, FLOATS), "spin": (3, FLOATS), "material": (1, INTEGERS), "id": (1, INTEGERS)}
SHAPES = {
    "id": (1, INTEGERS),
    "material": (1, INTEGERS),
    "free": (1, INTEGERS),
    "speed": (1, FLOATS),
    "spin": (1, FLOATS),
    "kinetic_energy": (1, FLOATS),
}
INTERFACES = {
    "centre": (3, FLOATS),
    "normal": (3, FLOATS),
    "force": (3, FLOATS),
    "moment": (3, FLOATS),
    "eccentricity": (1, FLOATS),
    "normal_force": (1, FLOATS),
    "shear_force": (1, FLOATS),
    "mobilised_friction": (1, FLOATS),
    "contacts": (1, INTEGERS),
    "bodies": (2, INTEGERS),
}
CONTACTS = {
    "normal": (3, FLOATS),
    "gap": (1, FLOATS),
    "impulse": (3, FLOATS),
    "normal_impulse": (1, FLOATS),
    "status": (1, INTEGERS),
    "bodies": (2, INTEGERS),
}


class Bad(Exception):
    """What is wrong with a file, in one line."""


class Steps:
    """The table of steps; the header says where each column is, and columns that nobody asks for do not matter."""

    def __init__(self, path):
        self.path = path
        try:
            with open(path, newline="", encoding="utf-8") as file:
                rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
        except OSError as error:
            raise Bad(f"{path}: {error.strerror}") from None
        if len(rows) < 2:
            raise Bad(f"{path}: no rows below the header")
        self.columns = {name.strip(): i for i, name in enumerate(rows[0])}
        self.rows = rows[1:]
        times = [self.number(i, "time") for i in range(len(self.rows))]
        # Sorted, because a resumed run may append rows that overlap.
        order = sorted(range(len(times)), key=times.__getitem__)
        self.times = [times[i] for i in order]
        self.rows = [self.rows[i] for i in order]

    def number(self, row, name):
        """The number in a column of a row."""
        if name not in self.columns:
            raise Bad(f"{self.path}: no column `{name}` (there are: {', '.join(self.columns)})")
        try:
            return float(self.rows[row][self.columns[name]])
        except (IndexError, ValueError):
            raise Bad(f"{self.path}: row {row + 1} has no number in column `{name}`") from None

    def nearest(self, time):
        """The row of nearest time, and whether it is of that same instant, to the digits that a table has."""
        i = bisect_left(self.times, time)
        near = min((j for j in (i - 1, i) if 0 <= j < len(self.times)), key=lambda j: abs(self.times[j] - time))
        spacing = (self.times[-1] - self.times[0]) / max(len(self.times) - 1, 1)
        return near, abs(self.times[near] - time) <= 0.01 * spacing + 1e-9 * abs(time)


def read(path, messages):
    """The data set in a file, if VTK has nothing to say about it."""
    if not path.is_file():
        raise Bad("the file is missing")
    complaints = []
    reader = vtk.vtkXMLPolyDataReader()
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda _, name: complaints.append(name))
    reader.SetFileName(str(path))
    before = len(messages.GetOutput())
    reader.Update()
    said = " ".join(messages.GetOutput()[before:].split())
    if complaints or said or reader.GetErrorCode():
        # Of a file that ends too early VTK says no more than that there is an error.
        raise Bad(f"VTK: {said or 'an error while reading; is the file cut off?'}")
    return reader.GetOutput()


class Run:
    """The files of a run: its table, its scene, and the frames of its series by their times."""

    def __init__(self, folder, table_at, messages):
        self.folder, self.messages = folder, messages
        self.steps = Steps(table_at)
        self.listed, self.last = {}, {}
        try:
            scene = tomllib.loads((table_at.parent / "scene.toml").read_text(encoding="utf-8"))
        except OSError:
            scene = {}
        self.corrects = "max_penetration" in scene.get("solver", {})
        # Materials are numbered in the order of their names.
        self.densities = [material.get("density") for _, material in sorted(scene.get("materials", {}).items())]

    def frame(self, kind, time):
        """The data of another series at this time; None where there is no such series."""
        if self.last.get(kind, (None,))[0] != time:
            pvd = self.folder / f"{kind}.pvd"
            if kind not in self.listed:
                self.listed[kind] = dict(frames(pvd)) if pvd.is_file() else None
            if self.listed[kind] is None:
                return None
            if time not in self.listed[kind]:
                raise Bad(f"{pvd.name} has no frame of the time {time!r}")
            self.last[kind] = (time, read(self.folder / self.listed[kind][time], self.messages))
        return self.last[kind][1]

    def step_at(self, time):
        """The length of the step that ends at a time, where the table has the step before."""
        row, same = self.steps.nearest(time)
        times = self.steps.times
        if not same or len(times) < 2:
            return None
        # Times in the table are rounded to digits; steps are all of one length.
        return (times[-1] - times[0]) / (len(times) - 1)


def table(data, of="point"):
    """The point or cell arrays by name, as rows of tuples, each with one tuple for each point or cell."""
    arrays = data.GetPointData() if of == "point" else data.GetCellData()
    count = data.GetNumberOfPoints() if of == "point" else data.GetNumberOfCells()
    out = {}
    for i in range(arrays.GetNumberOfArrays()):
        array = arrays.GetArray(i)
        if array is None:
            continue
        if array.GetNumberOfTuples() != count:
            raise Bad(f"`{array.GetName()}` has {array.GetNumberOfTuples()} tuples for {count} {of}s")
        out[array.GetName()] = vtk_to_numpy(array).reshape(-1, array.GetNumberOfComponents())
    return out


def check_arrays(arrays, wanted):
    """The wanted arrays are there, of the right kind, and finite."""
    for name, (components, kinds) in wanted.items():
        if name not in arrays:
            raise Bad(f"no point array `{name}` (there are: {', '.join(arrays) or 'none'})")
        values = arrays[name]
        if values.shape[1] != components:
            raise Bad(f"`{name}` has {values.shape[1]} components instead of {components}")
        if values.dtype.kind not in kinds:
            raise Bad(f"`{name}` is of type {values.dtype}, not {'an integer' if kinds == INTEGERS else 'a real number'}")
        finite = np.isfinite(values).all(axis=1)
        if not finite.all():
            at = int(np.argmin(finite))
            raise Bad(f"`{name}` of point {at} is {values[at].tolist()}")


def points_of(data):
    """The positions."""
    return vtk_to_numpy(data.GetPoints().GetData()) if data.GetNumberOfPoints() else np.empty((0, 3))


def cells_of(cells):
    """Lists of point indices."""
    if cells.GetNumberOfCells() == 0:
        return []
    ends = vtk_to_numpy(cells.GetOffsetsArray())
    return np.split(vtk_to_numpy(cells.GetConnectivityArray()), ends[1:-1])


def check_count(data, steps, row, column):
    """As many points as the table says."""
    expected = steps.number(row, column)
    if data.GetNumberOfPoints() != expected:
        raise Bad(f"{data.GetNumberOfPoints()} points, but {steps.path.name} has {column} = {expected:g} at {steps.times[row]:g}")


def check_bodies(data, run, time):
    """A frame of bodies; returns whether the table had its instant."""
    arrays, steps = table(data), run.steps
    check_arrays(arrays, BODIES)
    row, same = steps.nearest(time)
    check_count(data, steps, row, "bodies")
    if same and "mass" in arrays:
        # What is held in place or driven may be given an infinite mass; that has no say here.
        mass = arrays["mass"][:, 0].astype(float)
        free = np.isfinite(mass)
        energy = math.fsum(0.5 * mass[free] * (arrays["velocity"][free] ** 2).sum(axis=1))
        bound = steps.number(row, "kinetic")
        if not energy <= bound * (1 + 1e-9):
            raise Bad(f"sum of m v^2 / 2 is {energy!r}, more than kinetic = {bound!r} at {steps.times[row]:g}")
    return same


def check_contacts(data, run, time):
    """A frame of contacts; returns whether the table had its instant."""
    arrays, steps = table(data), run.steps
    check_arrays(arrays, CONTACTS)
    off = np.abs(np.linalg.norm(arrays["normal"], axis=1) - 1.0)
    if off.size and off.max() > 1e-12:
        raise Bad(f"`normal` of point {int(off.argmax())} is off unit length by {off.max():.1e}")
    row, same = steps.nearest(time)
    if same:
        check_count(data, steps, row, "contacts")
        moved_apart = steps.number(row, "penetration") if run.corrects else 0.0
        check_places(points_of(data), arrays, Figures(run, time), run.step_at(time), moved_apart)
    return same


class Figures:
    """The bodies of a frame with their polygons."""

    def __init__(self, run, time):
        bodies, shapes = run.frame("bodies", time), run.frame("shapes", time)
        self.positions = points_of(bodies)
        self.arrays = table(bodies)
        self.row = {int(i): row for row, i in enumerate(self.arrays["id"][:, 0])}
        self.cells, self.points, self.densities = {}, np.empty((0, 3)), run.densities
        if shapes is not None:
            self.points = points_of(shapes)
            ids = table(shapes, "cell")["id"][:, 0]
            lines = shapes.GetNumberOfLines()
            for i, cell in zip(ids[lines:], cells_of(shapes.GetPolys())):
                self.cells.setdefault(int(i), []).append(cell)
        self.flat = not self.points[:, 2].any()

    def of(self, name, i):
        """A value of body i."""
        if name not in self.arrays or i not in self.row:
            raise Bad(f"there is no `{name}` of body {i} in bodies.pvd")
        value = self.arrays[name][self.row[i]]
        return value[0] if len(value) == 1 else value

    def position(self, i):
        """Where body i is."""
        self.of("id", i)
        return self.positions[self.row[i]]

    def exact(self, i):
        """Whether the polygons of a body are its faces: True, or False where they stand for something curved, or None where nobody
        knows; a complaint where they enclose what cannot be."""
        mass, material = self.of("mass", i), self.of("material", i)
        if not (math.isfinite(mass) and material < len(self.densities) and self.densities[material]):
            return None
        part = float(self.densities[material] * self.content(i) / mass)
        if not 0.95 <= part <= 1.05:
            raise Bad(f"the polygons of body {i} enclose {part!r} of its mass")
        return abs(part - 1) <= 1e-9

    def content(self, i):
        """The volume, in the plane the area, from the middle of the body."""
        content = 0.0
        for cell in self.cells[i]:
            corners = self.points[cell] - self.position(i)
            fan = [np.cross(corners[k] - corners[0], corners[k + 1] - corners[0]) for k in range(1, len(cell) - 1)]
            content += sum(n[2] / 2 for n in fan) if self.flat else sum(n @ corners[0] / 6 for n in fan)
        return content

    def distance(self, i, point):
        """From a point to the surface of a body; None where it has none."""
        if i not in self.cells:
            radius = self.of("radius", i)
            return abs(np.linalg.norm(point - self.position(i)) - radius) if radius > 0 else None
        if self.flat:
            ends = [(self.points[a], self.points[b]) for cell in self.cells[i] for a, b in zip(cell, np.roll(cell, -1))]
            return min(to_segment(point, a, b) for a, b in ends)
        return min(to_polygon(point, self.points[cell]) for cell in self.cells[i])


def to_segment(point, a, b):
    """Distance from a point to a segment."""
    along = b - a
    at = min(max((point - a) @ along / (along @ along), 0.0), 1.0)
    return np.linalg.norm(point - a - at * along)


def to_polygon(point, corners):
    """Distance from a point to a convex polygon in space."""
    nexts = np.roll(corners, -1, axis=0)
    normal = np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0]).sum(axis=0)
    normal /= np.linalg.norm(normal)
    if (np.cross(nexts - corners, point - corners) @ normal >= 0).all():
        return abs((point - corners[0]) @ normal)
    return min(to_segment(point, a, b) for a, b in zip(corners, nexts))


MOST_CONTACTS = 500  # whose places are checked in a frame


def check_places(points, arrays, figures, step, moved_apart):
    """Contacts lie on both bodies: off by half the gap and by what the body moves in a step, for they are found before that.

    Bodies that overlap may also have been moved apart."""
    exact = {i: figures.exact(i) for i in figures.cells}
    if step is None:
        return
    for c in range(min(len(points), MOST_CONTACTS)):
        for i in map(int, arrays["bodies"][c]):
            distance = figures.distance(i, points[c])
            if distance is None:
                continue
            radius, velocity, spin = (figures.of(name, i) for name in ("radius", "velocity", "spin"))
            way = step * (np.linalg.norm(velocity) + np.linalg.norm(spin) * radius)
            curved = 0.0 if exact.get(i, True) else 0.01 * radius
            if distance > 0.5 * abs(arrays["gap"][c, 0]) + way + moved_apart + curved + 1e-9 * radius:
                raise Bad(f"contact {c} is {distance:.2e} m off the surface of body {i}")


def check_shapes(data, run, time):
    """A frame of shapes; returns whether the table had its instant."""
    cells = table(data, "cell")
    check_arrays(cells, SHAPES)
    figures = Figures(run, time)
    speeds = {int(i): speed for i, speed in zip(cells["id"][:, 0], cells["speed"][:, 0])}
    free = {int(i) for i, free in zip(cells["id"][:, 0], cells["free"][:, 0]) if free}
    for i, polygons in figures.cells.items():
        if not math.isclose(speeds[i], np.linalg.norm(figures.of("velocity", i)), rel_tol=1e-12, abs_tol=1e-300):
            raise Bad(f"body {i} has another speed than in bodies.pvd")
        arms = figures.points[np.unique(np.concatenate(polygons))] - figures.position(i)
        far = float(np.linalg.norm(arms, axis=1).max())
        if not far <= figures.of("radius", i) * (1 + 1e-9):
            raise Bad(f"the polygons of body {i} reach {far!r} from its centre, more than its radius")
        # What is fixed or driven may be a surface with an edge.
        if i in free:
            figures.exact(i)
            if not figures.flat:
                check_closed(i, polygons)
    return run.steps.nearest(time)[1]


def check_closed(i, polygons):
    """Each edge is passed as often one way as the other."""
    passed = {}
    for cell in polygons:
        for a, b in zip(cell.tolist(), np.roll(cell, -1).tolist()):
            passed[min(a, b), max(a, b)] = passed.get((min(a, b), max(a, b)), 0) + (1 if a < b else -1)
    if any(passed.values()):
        raise Bad(f"the surface of body {i} is open")


def check_interfaces(data, run, time):
    """A frame of interfaces; returns whether the table had its instant."""
    arrays = table(data)
    check_arrays(arrays, INTERFACES)
    contacts, figures = run.frame("contacts", time), Figures(run, time)
    points, found = points_of(contacts), table(contacts)
    round_one = {i for i in figures.row if i not in figures.cells and figures.of("radius", i) > 0}
    pairs = {}
    for c, pair in enumerate(found.get("bodies", [])):
        if not round_one.intersection(map(int, pair)):
            pairs.setdefault(tuple(map(int, pair)), []).append(c)
    if [tuple(pair) for pair in arrays["bodies"].tolist()] != list(pairs):
        raise Bad("interfaces are not those of the pairs of contacts.pvd")
    step = run.step_at(time)
    for one, (pair, at) in enumerate(pairs.items()):
        pressed = found["normal_impulse"][at, 0]
        weights = pressed / pressed.sum() if pressed.sum() > 0 else np.full(len(at), 1 / len(at))
        size = max(figures.of("radius", i) for i in pair)
        if np.linalg.norm(weights @ points[at] - points_of(data)[one]) > 1e-9 * size:
            raise Bad(f"the centre of pressure between bodies {pair} is not where the contacts say")
        impulse = found["impulse"][at].sum(axis=0)
        if step and impulse.any():
            # Of a step that was done in parts the impulses are those of the last one, a half, a quarter or so.
            force = arrays["force"][one] * step
            halvings = round(math.log2(max(np.linalg.norm(force) / np.linalg.norm(impulse), 1.0)))
            if np.linalg.norm(force - impulse * 2**halvings) > 1e-6 * np.linalg.norm(force):
                raise Bad(f"the force between bodies {pair} is not what the contacts say")
    for line in cells_of(data.GetLines()):
        shared = set(arrays["bodies"][line[0]].tolist()).intersection(arrays["bodies"][line[1]].tolist())
        if not any(math.isfinite(figures.of("mass", i)) for i in shared):
            raise Bad(f"a line of thrust joins interfaces {line.tolist()}, which have no free body in common")
    return run.steps.nearest(time)[1]


SHOWN = 20  # messages a series; one cause often spoils every frame
CHECKS = {
    "bodies.pvd": check_bodies,
    "contacts.pvd": check_contacts,
    "shapes.pvd": check_shapes,
    "interfaces.pvd": check_interfaces,
}


def check_time(data, time):
    """The file says the same time as the list."""
    array = data.GetFieldData().GetArray("TimeValue")
    if array is None or array.GetNumberOfTuples() != 1:
        raise Bad("no field array `TimeValue` with one number")
    if array.GetValue(0) != time:
        raise Bad(f"TimeValue is {array.GetValue(0)!r}, the .pvd says {time!r}")


def frames(pvd):
    """The times and files that a collection lists."""
    try:
        root = ET.parse(pvd).getroot()
    except (ET.ParseError, OSError) as error:
        raise Bad(f"{pvd}: {error}") from None
    if root.tag != "VTKFile" or root.get("type") != "Collection":
        raise Bad(f"{pvd}: not a VTKFile of type Collection")
    out = []
    for entry in root.iter("DataSet"):
        try:
            out.append((float(entry.attrib["timestep"]), entry.attrib["file"]))
        except (KeyError, ValueError) as error:
            raise Bad(f"{pvd}: entry {len(out)}: {error!r}") from None
    if not out:
        raise Bad(f"{pvd}: lists no files")
    return out


def check_series(pvd, run, messages):
    """All frames of one collection; returns how many files are good and the list of what is wrong."""
    check = CHECKS.get(pvd.name)
    good, failures, matched, points = 0, [], 0, []
    listed = frames(pvd)
    for time, name in listed:
        try:
            data = read(pvd.parent / name, messages)
            check_time(data, time)
            matched += check(data, run, time) if check else 0
            points.append(data.GetNumberOfPoints())
            good += 1
        except Bad as bad:
            failures.append(f"{pvd.parent / name}: {bad}")
    size = f"{min(points)} to {max(points)} points" if points else "none good"
    against = f", {matched} with their own row in {run.steps.path.name}" if check else ""
    print(f"{pvd}: {len(listed)} files, {size}, times {listed[0][0]:g} to {listed[-1][0]:g}{against}")
    if check and good and not matched:
        failures.append(f"{pvd}: no frame is of the time of a row in {run.steps.path}")
    return good, failures


def main():
    """Returns the exit status."""
    parser = argparse.ArgumentParser(description="Checks the ParaView files of a run with VTK.")
    parser.add_argument("dir", type=Path, metavar="DIR", help="the folder of a run")
    root = parser.parse_args().dir
    folder = root / "vtk" if (root / "vtk").is_dir() else root
    table_at = root / "steps.csv"
    if folder == root and not table_at.is_file():
        table_at = root.resolve().parent / "steps.csv"

    # VTK prints what goes wrong and carries on; its words are caught so that they count.
    messages = vtk.vtkStringOutputWindow()
    vtk.vtkOutputWindow.SetInstance(messages)
    vtk.vtkLogger.SetStderrVerbosity(vtk.vtkLogger.VERBOSITY_OFF)

    passed, failures, run = 0, [], None
    series = sorted(folder.glob("*.pvd"))
    if not series:
        failures.append(f"{folder}: no .pvd file")
        print(f"FAILED {failures[0]}", file=sys.stderr)
    for pvd in series:
        try:
            if pvd.name in CHECKS and run is None:
                run = Run(folder, table_at, messages)
            good, bad = check_series(pvd, run, messages)
            passed += good
            failures += bad
            for failure in bad[:SHOWN]:
                print(f"FAILED {failure}", file=sys.stderr)
            if len(bad) > SHOWN:
                print(f"FAILED {pvd}: and {len(bad) - SHOWN} more", file=sys.stderr)
        except Bad as bad:
            failures.append(str(bad))
            print(f"FAILED {bad}", file=sys.stderr)
    print(f"{passed} passed, {len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
