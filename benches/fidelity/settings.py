"""What each engine is given in each experiment: rows of the tables.

*As it comes* leaves everything as the engine has it, at its own time step and at the common one; *best* is the best that was found by
trying what the engine's documentation names.
"""

# The time steps that engines have as their own, s; moreau has none.
OWN = {"MuJoCo": 2e-3, "Rapier": 1 / 60, "Jolt": 1 / 60}


def rows(experiment):
    """Engine, name of the row, step (s), settings."""
    name, step = experiment.name, experiment.step
    best = "best"
    yield "moreau", "as it comes", step, {}
    yield "moreau", best, step, moreau()
    yield "moreau", best, 1 / 60, moreau()
    yield "MuJoCo", "as it comes", OWN["MuJoCo"], {}
    yield "MuJoCo", "as it comes", step, {}
    yield "MuJoCo", best, step, mujoco(name, step)
    if name == "slide":
        yield "MuJoCo", best, 2e-4, mujoco(name, 2e-4)
    for engine, make, awake in (("Rapier", rapier, {"sleep": False}), ("Jolt", jolt, {"body": {"mAllowSleeping": False}})):
        yield engine, "as it comes", OWN[engine], {}
        yield engine, "as it comes, awake", step, awake
        yield engine, best, step, make(name)


def moreau():
    """A start from the impulses of the step before, a criterion whose meaning does not depend on units, and the method that changes itself."""
    return {"solver.start": "warm", "solver.criterion": "scaled", "solver.tolerance": "1e-9", "solver.global": "auto"}


def mujoco(name, step):
    """Elliptic cones, implicitfast, friction hardened by impratio and by the noslip iterations, the stiffest contacts for the step.

    The chain is smooth, so Runge-Kutta. Stiff contacts throw a sliding box up, so the slide keeps MuJoCo's own.
    """
    option = {"cone": "elliptic", "integrator": "implicitfast", "iterations": 200, "ls_iterations": 100, "tolerance": 1e-12, "impratio": 100}
    option |= {"noslip_iterations": 30, "noslip_tolerance": 1e-12}
    if name == "chain":
        option["integrator"] = "RK4"
    if name == "slide":
        return {"option": option | {"impratio": 1, "noslip_iterations": 0}}
    contact = {"solref": f"{2 * step!r} 1", "solimp": "0.99 0.9999 0.0001 0.5 2"}
    return {"option": option, "flag": {"multiccd": "enable"}, "contact": contact}


def rapier(name):
    """Four times the iterations, contacts at 480 Hz (its own: 30, at fixed bodies 60), joints warm-started, contacts never recycled.

    The chain has its joints in reduced coordinates, which need no more iterations; the disk's length unit is half its radius; the box that
    crosses a joint has a skin.
    """
    best = {"sleep": False, "iterations": 16, "contact": [480.0, 10.0], "contact_recycling": False, "warmstart_joints": True}
    special = {
        "chain": {"multibody": True, "iterations": 4},
        "disk": {"contact": [2000.0, 10.0], "length_unit": 0.02},
        "joint": {"contact_skin": 1e-3},
    }
    return best | special.get(name, {})


def jolt(name):
    """Five times the velocity steps, ten times the position steps, a small slop, no damping, gyroscopic forces.

    The disk is smaller than the distances that Jolt's tolerances are made for, so they are made smaller.
    """
    physics = {"mNumVelocitySteps": 50, "mNumPositionSteps": 20, "mPenetrationSlop": 1e-4}
    body = {"mAllowSleeping": False, "mLinearDamping": 0, "mAngularDamping": 0, "mApplyGyroscopicForce": True}
    if name == "disk":
        small = {"mPenetrationSlop": 1e-5, "mSpeculativeContactDistance": 1e-4, "mUseBodyPairContactCache": False, "mNumVelocitySteps": 20}
        return {"physics": physics | small | {"mNumPositionSteps": 10}, "body": body, "convexRadius": 1e-3}
    return {"physics": physics, "body": body}
