#!/usr/bin/env python3
"""Reads problem files with FCLIB, which Siconos uses, and asks whether it finds the numbers that are there. Needs h5py, a C compiler and FCLIB
(Debian's libfclib-dev), which knows no rolling contacts.

    scripts/check_fclib.py FILE...
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np


def in_order(values):
    """Returns the sum of a list, taken from its beginning as the reader does."""
    return float(np.cumsum(values)[-1]) if len(values) else 0.0


def numbers(path):
    """Returns the kind of a problem, and its lists by the names that the reader gives them."""
    with h5py.File(path) as file:
        root = next(group for name, group in file.items() if name.startswith("fclib_"))
        lists = {}
        for group in (root, file):
            group.visititems(lambda name, item: lists.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
        return root.name.removeprefix("/fclib_"), lists


def compare(reader, path):
    """Returns how many lists FCLIB read, each of which has the sum that it should have."""
    kind, right = numbers(path)
    done = subprocess.run([reader, kind, path], capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr, f"{path}: {done.stderr}"
    lists = [line.split() for line in done.stdout.splitlines()[1:]]
    for name, count, total in lists:
        assert (len(right[name]), in_order(right[name])) == (int(count), float(total)), f"{path}: {name} is read otherwise"
    return len(lists)


with tempfile.TemporaryDirectory() as place:
    reader = str(Path(place, "reader"))
    subprocess.run(["cc", "-O1", str(Path(__file__).with_name("fclib_reader.c")), "-lfclib", "-o", reader], check=True)
    for path in sys.argv[1:]:
        print(f"{path}: {compare(reader, path)} lists read by FCLIB, with the sums that they have")
