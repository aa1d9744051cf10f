"""Runs one scene in one engine, each in a process of its own with one thread: the states, and the seconds that its steps took."""

import csv
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py
import numpy as np

import scene as scenes

HERE = Path(__file__).parent


class Engines:
    """Where the programs are. `budget` is how many seconds of a processor a run may take; others that use the machine do not shorten it."""

    def __init__(self, moreau, rapier, jolt, work, budget):
        self.moreau, self.work, self.budget = moreau, work, budget
        self.commands = {
            "MuJoCo": [sys.executable, HERE / "mujoco_run.py"],
            "Rapier": [rapier] if rapier else None,
            "Jolt": ["node", HERE / "jolt_run.mjs"] if jolt else None,
        }
        threads = {"OMP_NUM_THREADS": "1", "RAYON_NUM_THREADS": "1", "PYTHONDONTWRITEBYTECODE": "1"}
        self.environment = os.environ | threads | ({"JOLT": str(jolt)} if jolt else {})

    def run(self, engine, experiment, step, settings):
        """Returns the states, the seconds, how far the run came (s), and what the engine says of itself; or a reason why there are none."""
        path = HERE / "scenes" / f"{experiment.name}.toml"
        scene = scenes.read(path)
        if engine == "moreau":
            return scene, self.run_moreau(path, scene, experiment, step, settings)
        if self.commands[engine] is None:
            return scene, "not built here"
        return scene, self.run_other(engine, scene, experiment, step, settings)

    def run_other(self, engine, scene, experiment, step, settings):
        out = self.work / f"{engine}-{experiment.name}"
        steps, _ = scenes.write(scene, settings, step, experiment.duration, experiment.sample, f"{out}.json")
        words = [*map(str, self.commands[engine]), f"{out}.json", str(out)]
        try:
            child = subprocess.run(words, capture_output=True, text=True, env=self.environment, cwd=self.work, timeout=4 * self.budget)
        except subprocess.TimeoutExpired:
            return f"over {4 * self.budget:g} s"
        if child.returncode:
            print(child.stderr[-1000:], file=sys.stderr)
            return "failed"
        return np.fromfile(f"{out}.f64"), float(child.stdout.split()[-1]), steps * step, ""

    def run_moreau(self, path, scene, experiment, step, settings):
        """Asked to stop when its time is over, it keeps what it has."""
        out = self.work / f"moreau-{experiment.name}"
        steps = round(experiment.duration / step)
        every = max(1, round(experiment.sample / step))
        changes = settings | {"time.step": repr(step), "time.steps": steps, "output.every": every}
        words = [self.moreau, "run", path, "--out", out, "--force", "--quiet", "--threads", "1"]
        for key, value in changes.items():
            words += ["--set", f"{key}={value}"]
        child = subprocess.Popen([*map(str, words)], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
        while child.poll() is None:
            time.sleep(0.05)
            if used(child.pid) > self.budget:
                child.send_signal(signal.SIGINT)
                break
        try:
            error = child.communicate(timeout=4 * self.budget)[1]
        except subprocess.TimeoutExpired:
            child.kill()
            child.communicate()
            return "does not stop when its time is over"
        with open(out / "steps.csv") as table:
            rows = list(csv.DictReader(table))
        said = ""
        if child.returncode not in (0, 130):
            # What the program says of itself is an answer, too.
            said = " ".join(error.split()).replace("|", "/")[:300] or f"exit code {child.returncode}"
            print(f"moreau: {error}", file=sys.stderr)
            if len(rows) < steps:
                reason = said.split(";")[0]
                return f"ends at {len(rows) * step:.3g} s: {reason}"
        seconds = sum(float(row["seconds_step"]) for row in rows)
        return trajectory(out / "trajectory.h5", step), seconds, len(rows) * step, said


def used(pid):
    """Seconds of a processor that a process has used; 0 once it has ended."""
    try:
        words = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    except OSError:
        return 0.0
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def trajectory(path, step):
    """States as the other drivers write them: time, then position, quaternion w x y z, velocity, spin of each body."""
    with h5py.File(path) as file:
        frames, bodies = len(file["frames/step"]), len(file["bodies/radius"])
        take = lambda name, k: file[f"frames/{name}"][: frames * bodies * k].reshape(frames, bodies, k)
        turn = take("rotation", 4)[..., [3, 0, 1, 2]]
        state = np.concatenate([take("position", 3), turn, take("velocity", 3), take("spin", 3)], axis=2)
        return np.concatenate([file["frames/step"][:frames].reshape(-1, 1) * step, state.reshape(frames, -1)], axis=1)
