"""Runs a scene in MuJoCo: mujoco_run.py SCENE.json OUT. Output as in rapier/src/main.rs."""

import json
import sys
import time

import mujoco
import numpy as np


def main():
    path, out = sys.argv[1:]
    with open(path) as file:
        scene = json.load(file)
    model = mujoco.MjModel.from_xml_string(xml(scene))
    data = mujoco.MjData(model)
    ids = [model.body(f"b{k}").id for k in range(len(scene["bodies"]))]
    for k, body in enumerate(scene["bodies"]):
        data.xfrc_applied[ids[k], :3] = body["force"]
        start(model, data, ids[k], body)
    states, seconds = [state(model, data, ids)], 0.0
    for _ in range(scene["steps"] // scene["every"]):
        clock = time.perf_counter()
        mujoco.mj_step(model, data, scene["every"])
        seconds += time.perf_counter() - clock
        states.append(state(model, data, ids))
    np.array(states).tofile(f"{out}.f64")
    print(seconds)


def start(model, data, body, entry):
    """Sets the velocity of a body that is free; bodies in joints start at rest in all scenes."""
    joint, moving = model.body_jntadr[body], any(entry["velocity"] + entry["spin"])
    if not moving:
        return
    assert model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE
    first = model.jnt_dofadr[joint]
    inverse, spin = np.zeros(4), np.zeros(3)
    mujoco.mju_negQuat(inverse, np.array(entry["quaternion"]))
    mujoco.mju_rotVecQuat(spin, np.array(entry["spin"]), inverse)
    data.qvel[first : first + 3] = entry["velocity"]
    data.qvel[first + 3 : first + 6] = spin


def state(model, data, ids):
    """Brings places and velocities of bodies up to date, which a step leaves one step behind, and returns them."""
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_comVel(model, data)
    numbers, speed = [data.time], np.zeros(6)
    for k in ids:
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, k, speed, 0)
        numbers += [*data.xpos[k], *data.xquat[k], *speed[3:], *speed[:3]]
    return numbers


def xml(scene):
    s = scene["settings"]
    option = " ".join(f'{k}="{v}"' for k, v in s.get("option", {}).items())
    # A run that diverges is to be seen as one, not to begin again.
    flag = " ".join(f'{k}="{v}"' for k, v in ({"autoreset": "disable"} | s.get("flag", {})).items())
    contact = " ".join(f'{k}="{v}"' for k, v in s.get("contact", {}).items())
    touch = "" if scene["collide"] else 'contype="0" conaffinity="0"'
    children = {k: [] for k in range(len(scene["bodies"]))}
    joints = {joint["b"]: joint for joint in scene["joints"]}
    roots = []
    for k in children:
        parent = joints[k]["a"] if k in joints else None
        (roots if parent is None else children[parent]).append(k)

    def tree(k, origin):
        body = scene["bodies"][k]
        # Bodies in joints are not turned at the start in any of the scenes, so places are differences.
        place = np.subtract(body["position"], origin)
        inner = "".join(tree(c, body["position"]) for c in children[k])
        return f"""<body name="b{k}" pos="{numbers(place)}" quat="{numbers(body['quaternion'])}">{motion(k, body)}
            <geom {geom(body['shape'])} density="{body['density']!r}"/>{inner}</body>\n"""

    def motion(k, body):
        if body["fixed"]:
            return ""
        if k not in joints:
            return "<freejoint/>"
        joint = joints[k]
        if joint["axis"] is None:
            return f'<joint type="ball" pos="{numbers(np.subtract(joint["anchor"], body["position"]))}"/>'
        return f'<joint type="slide" axis="{numbers(joint["axis"])}"/>'

    return f"""<mujoco><option timestep="{scene['step']!r}" gravity="{numbers(scene['gravity'])}" {option}><flag {flag}/></option>
        <default><geom friction="{scene['friction']!r} 0 0" {contact} {touch}/></default>
        <worldbody>{"".join(tree(k, [0.0, 0.0, 0.0]) for k in roots)}</worldbody></mujoco>"""


def geom(shape):
    """Axes of capsules and cylinders are z, as in the scene; sizes are halves."""
    (kind, size), = shape.items()
    return {
        "box": lambda: f'type="box" size="{numbers(np.array(size) / 2)}"',
        "ball": lambda: f'type="sphere" size="{size!r}"',
        "capsule": lambda: f'type="capsule" size="{size[0]!r} {size[1] / 2!r}"',
        "cylinder": lambda: f'type="cylinder" size="{size[0]!r} {size[1] / 2!r}"',
        "half_space": lambda: f'type="plane" size="0 0 1" zaxis="{numbers(size)}"',
    }[kind]()


def numbers(values):
    return " ".join(repr(float(x)) for x in values)


if __name__ == "__main__":
    main()
