#!/usr/bin/env python3
"""Writes the trajectories of runs again with h5py, in the ways in which programs do that, and asks moreau to read them.

    scripts/check_rewritten.py PROGRAM FOLDER...

Needs h5py. A page made of the new file must be that of the old one; pages tell what was read, number by number.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

WAYS = {
    "contiguous": {},
    "chunks": {"chunks": True},
    "unlimited": {"chunks": True, "maxshape": (None,)},
    "deflate": {"compression": "gzip"},
    "shuffle, deflate, checksum": {"compression": "gzip", "shuffle": True, "fletcher32": True},
}
VERSIONS = {"": None, ", newest": "latest", ", oldest": "earliest"}


def again(old, new, way, version):
    """Copies all attributes and datasets into a new file; texts get a variable length, whole numbers other kinds."""
    with h5py.File(old) as source, h5py.File(new, "w", libver=version) as target:
        for name, value in source.attrs.items():
            if isinstance(value, bytes):
                value = value.decode()
            elif isinstance(value, np.integer):
                value = np.int32(value)
            target.attrs[name] = value
        sets = {}
        source.visititems(lambda name, item: sets.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
        for name, values in sets.items():
            # What is empty, as contacts may be, has no chunks.
            target.create_dataset(name, data=values, **(way if np.size(values) else {}))


def page(program, folder):
    """Returns the page of a run."""
    done = subprocess.run([program, "report", folder, "--out", f"{folder}/again.html", "--force"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return Path(folder, "again.html").read_bytes()


program, *folders = sys.argv[1:]
for folder in folders:
    with tempfile.TemporaryDirectory() as place:
        work = Path(place, Path(folder).name)
        shutil.copytree(folder, work, ignore=shutil.ignore_patterns("vtk"))
        right = page(program, work)
        count = 0
        for name, way in WAYS.items():
            for words, version in VERSIONS.items():
                if way and version == "latest":
                    # Chunks of this version have a layout that the library does not know: docs/dependencies.md.
                    continue
                again(f"{folder}/trajectory.h5", work / "trajectory.h5", way, version)
                assert page(program, work) == right, f"{folder}: {name}{words}"
                count += 1
        print(f"{folder}: written again in {count} ways, and read the same")
