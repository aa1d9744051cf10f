#!/usr/bin/env python3
"""Opens the ParaView files of a run with VTK itself and holds them against the run's table of steps.

    check_vtk.py DIR

reads every .pvd in DIR/vtk (or in DIR where there is no such folder), each file that it lists, and DIR/steps.csv (or
the one beside DIR). It needs `pip install vtk`. What is checked:

  every series   VTK reads each file without a word of complaint; the file's TimeValue is the time in the .pvd
  bodies.pvd     radius, velocity (3), spin (3), material (integer), id (integer): one finite tuple for each point, as
                 many points as the column `bodies` says; if there is `mass`, the sum of m v^2 / 2 is no more than the
                 column `kinetic`, which also counts the energy of spin
  contacts.pvd   normal (3, of unit length), gap, impulse (3), status (integer), as many points as `contacts` says

A frame is held against the row of nearest time. Counts of contacts and energies change from step to step, so these are
compared only where that row is of the frame's own instant (the first frame of a run is before the first step and may
have none); a series in which no frame has its own row fails.
"""

import argparse
import csv
import math
import sys
import xml.etree.ElementTree as ET
from bisect import bisect_left
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

INTEGERS = "biu"  # numpy's kinds: bool, signed, unsigned
FLOATS = "f"
BODIES = {"radius": (1, FLOATS), "velocity": (3, FLOATS), "spin": (3, FLOATS), "material": (1, INTEGERS), "id": (1, INTEGERS)}
CONTACTS = {"normal": (3, FLOATS), "gap": (1, FLOATS), "impulse": (3, FLOATS), "status": (1, INTEGERS)}


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


def table(data):
    """The point arrays by name, as rows of tuples, each with one tuple for each point."""
    points = data.GetPointData()
    out = {}
    for i in range(points.GetNumberOfArrays()):
        array = points.GetArray(i)
        if array is None:
            continue
        if array.GetNumberOfTuples() != data.GetNumberOfPoints():
            raise Bad(f"`{array.GetName()}` has {array.GetNumberOfTuples()} tuples for {data.GetNumberOfPoints()} points")
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


def check_count(data, steps, row, column):
    """As many points as the table says."""
    expected = steps.number(row, column)
    if data.GetNumberOfPoints() != expected:
        raise Bad(f"{data.GetNumberOfPoints()} points, but {steps.path.name} has {column} = {expected:g} at {steps.times[row]:g}")


def check_bodies(data, steps, time):
    """A frame of bodies; returns whether the table had its instant."""
    arrays = table(data)
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


def check_contacts(data, steps, time):
    """A frame of contacts; returns whether the table had its instant."""
    arrays = table(data)
    check_arrays(arrays, CONTACTS)
    off = np.abs(np.linalg.norm(arrays["normal"], axis=1) - 1.0)
    if off.size and off.max() > 1e-12:
        raise Bad(f"`normal` of point {int(off.argmax())} is off unit length by {off.max():.1e}")
    row, same = steps.nearest(time)
    if same:
        check_count(data, steps, row, "contacts")
    return same


SHOWN = 20  # messages a series; one cause often spoils every frame
CHECKS = {"bodies.pvd": check_bodies, "contacts.pvd": check_contacts}


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


def check_series(pvd, steps, messages):
    """All frames of one collection; returns how many files are good and the list of what is wrong."""
    check = CHECKS.get(pvd.name)
    good, failures, matched, points = 0, [], 0, []
    listed = frames(pvd)
    for time, name in listed:
        try:
            data = read(pvd.parent / name, messages)
            check_time(data, time)
            matched += check(data, steps, time) if check else 0
            points.append(data.GetNumberOfPoints())
            good += 1
        except Bad as bad:
            failures.append(f"{pvd.parent / name}: {bad}")
    size = f"{min(points)} to {max(points)} points" if points else "none good"
    against = f", {matched} with their own row in {steps.path.name}" if check else ""
    print(f"{pvd}: {len(listed)} files, {size}, times {listed[0][0]:g} to {listed[-1][0]:g}{against}")
    if check and good and not matched:
        failures.append(f"{pvd}: no frame is of the time of a row in {steps.path}")
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

    passed, failures, steps = 0, [], None
    series = sorted(folder.glob("*.pvd"))
    if not series:
        failures.append(f"{folder}: no .pvd file")
        print(f"FAILED {failures[0]}", file=sys.stderr)
    for pvd in series:
        try:
            if pvd.name in CHECKS and steps is None:
                steps = Steps(table_at)
            good, bad = check_series(pvd, steps, messages)
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
