"""Drops the pile in MuJoCo."""

import time

import mujoco
import numpy as np

import pile


def run(radii, centres, width, step, steps, every, budget, solver):
    """The state at the start and of each `every`-th step, and the seconds of each step; ends early after `budget` seconds.

    All settings but the step are MuJoCo's own, and the solver where one is named.
    """
    model = mujoco.MjModel.from_xml_string(pile.mjcf(radii, centres, width, step))
    if solver is not None:
        model.opt.solver = getattr(mujoco.mjtSolver, f"mjSOL_{solver}")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    states, seconds, started = [state(data)], [], time.perf_counter()
    for k in range(1, steps + 1):
        clock = time.perf_counter()
        mujoco.mj_step(model, data)
        seconds.append(time.perf_counter() - clock)
        if k % every == 0:
            states.append(state(data))
        if time.perf_counter() - started > budget:
            break
    return np.array(states), np.array(seconds)


def state(data):
    """The spin is in the frame of the ball, whose length is all that is asked for."""
    return np.hstack([data.qpos.reshape(-1, 7)[:, :3], data.qvel.reshape(-1, 6)])
