"""The places of all bodies in one frame of a run's trajectory, read by another program than moreau, for the test of the page.

positions.py RUN FRAME OUT.json       FRAME may be negative: from the end
"""

import json
import sys

import h5py

run, frame, out = sys.argv[1], int(sys.argv[2]), sys.argv[3]
with h5py.File(f"{run}/trajectory.h5", "r") as file:
    frames, bodies, dimension = len(file["frames/step"]), len(file["bodies/radius"]), int(file.attrs["dimension"])
    frame %= frames
    size = bodies * dimension
    positions = file["frames/position"][frame * size : (frame + 1) * size].reshape(bodies, dimension)
    columns = file.attrs["columns"]
    columns = (columns.decode() if isinstance(columns, bytes) else columns).split(",")
    assert file["steps"].shape[0] % len(columns) == 0, "rows of steps are whole"
json.dump({"frame": frame, "positions": [[float(x) for x in row] for row in positions]}, open(out, "w"))
