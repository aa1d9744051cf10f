#!/usr/bin/env python3
"""Reads every number of HDF5 files with HDF5's own library. Needs h5py.

    scripts/check_hdf5.py FILE...

Prints a line a file; ends with an error at the first dataset that cannot be read, or that holds what is no number: only the position of
a body that is absent is none.
"""

import sys

import h5py
import numpy as np


def datasets(path):
    """Returns all datasets of a file, by name."""
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def without_absent(found):
    """Returns the same datasets, with those positions left out that belong to absent bodies, which are no numbers."""
    motion = found.get("frames/motion")
    if motion is None:
        return found
    places = found["frames/position"].reshape(len(motion), -1)
    assert np.isnan(places[motion == 0]).all(), "an absent body has a place"
    return {**found, "frames/position": places[motion != 0]}


for path in sys.argv[1:]:
    found = datasets(path)
    numbers = sum(np.size(values) for values in found.values())
    for name, values in without_absent(found).items():
        if np.asarray(values).dtype.kind == "f":
            assert not np.isnan(values).any(), f"{path}: {name} has what is no number"
    assert numbers > 0, f"{path} is empty"
    print(f"{path}: {len(found)} datasets, {numbers} numbers, read by HDF5 {h5py.version.hdf5_version}")
