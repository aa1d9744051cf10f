// Runs a scene in Jolt: node jolt_run.mjs SCENE.json OUT. Output as in rapier/src/main.rs.
//
// JoltPhysics.js is Jolt compiled to WebAssembly by its author: the same code in single precision, all of whose settings can be set.

import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const require = createRequire(`${process.env.JOLT}/package.json`);
const init = (await import(pathToFileURL(require.resolve("jolt-physics/wasm-compat")))).default;
const Jolt = await init();
const [path, out] = process.argv.slice(2);
const scene = JSON.parse(readFileSync(path, "utf8"));
const FIXED = 0, MOVING = 1, GHOST = 2; // layers: the last touches nothing

const system = makeSystem();
const settings = system.GetPhysicsSettings();
for (const [name, value] of Object.entries(scene.settings.physics ?? {})) {
    if (!(name in settings)) throw new Error(`Jolt has no setting ${name}`);
    settings[name] = value;
}
system.SetPhysicsSettings(settings);
system.SetGravity(new Jolt.Vec3(...scene.gravity));
const world = system.GetBodyInterface();
const bodies = scene.bodies.map(makeBody);
scene.joints.forEach(join);
run();

function makeSystem() {
    const pairs = new Jolt.ObjectLayerPairFilterTable(3);
    pairs.EnableCollision(FIXED, MOVING);
    pairs.EnableCollision(MOVING, MOVING);
    const broad = new Jolt.BroadPhaseLayerInterfaceTable(3, 2);
    broad.MapObjectToBroadPhaseLayer(FIXED, new Jolt.BroadPhaseLayer(0));
    broad.MapObjectToBroadPhaseLayer(MOVING, new Jolt.BroadPhaseLayer(1));
    broad.MapObjectToBroadPhaseLayer(GHOST, new Jolt.BroadPhaseLayer(1));
    const words = new Jolt.JoltSettings();
    words.mObjectLayerPairFilter = pairs;
    words.mBroadPhaseLayerInterface = broad;
    words.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(broad, 2, pairs, 3);
    globalThis.jolt = new Jolt.JoltInterface(words);
    return globalThis.jolt.GetPhysicsSystem();
}

function makeShape(shape, density) {
    const [[kind, size]] = Object.entries(shape);
    // Jolt rounds corners by its convex radius where it searches for contacts; 5 cm as it comes, which must fit into the shape.
    const radius = (half) => Math.min(scene.settings.convexRadius ?? 0.05, 0.5 * half);
    const weighed = (made) => {
        made.SetDensity(density);
        return made;
    };
    const quarter = Jolt.Quat.prototype.sRotation(new Jolt.Vec3(1, 0, 0), Math.PI / 2);
    // Jolt's axis is y.
    const along = (made) => {
        made.mDensity = density;
        return new Jolt.RotatedTranslatedShapeSettings(new Jolt.Vec3(0, 0, 0), quarter, made).Create().Get();
    };
    if (kind === "box") {
        const half = size.map((x) => x / 2);
        return weighed(new Jolt.BoxShape(new Jolt.Vec3(...half), radius(Math.min(...half))));
    }
    if (kind === "ball") return weighed(new Jolt.SphereShape(size));
    if (kind === "capsule") return along(new Jolt.CapsuleShapeSettings(size[1] / 2, size[0]));
    if (kind === "cylinder") return along(new Jolt.CylinderShapeSettings(size[1] / 2, size[0], radius(Math.min(size[0], size[1] / 2))));
    if (kind === "half_space") return new Jolt.PlaneShape(new Jolt.Plane(new Jolt.Vec3(...size), 0));
    throw new Error(`unknown shape ${kind}`);
}

function makeBody(body) {
    const shape = makeShape(body.shape, body.density);
    const [w, x, y, z] = body.quaternion;
    const layer = scene.collide ? (body.fixed ? FIXED : MOVING) : GHOST;
    const motion = body.fixed ? Jolt.EMotionType_Static : Jolt.EMotionType_Dynamic;
    const words = new Jolt.BodyCreationSettings(shape, new Jolt.RVec3(...body.position), new Jolt.Quat(x, y, z, w), motion, layer);
    words.mFriction = scene.friction;
    words.mRestitution = 0;
    words.mLinearVelocity = new Jolt.Vec3(...body.velocity);
    words.mAngularVelocity = new Jolt.Vec3(...body.spin);
    for (const [name, value] of Object.entries(scene.settings.body ?? {})) {
        if (!(name in words)) throw new Error(`Jolt's bodies have no setting ${name}`);
        words[name] = value;
    }
    const made = world.CreateBody(words);
    world.AddBody(made.GetID(), Jolt.EActivation_Activate);
    return made;
}

function join(joint) {
    const one = joint.a === null ? Jolt.JoltInterface.prototype.sGetFixedToWorldBody() : bodies[joint.a];
    const anchor = new Jolt.RVec3(...joint.anchor);
    let words;
    if (joint.axis === null) {
        words = new Jolt.PointConstraintSettings();
    } else {
        words = new Jolt.SliderConstraintSettings();
        const axis = new Jolt.Vec3(...joint.axis);
        words.mSliderAxis1 = words.mSliderAxis2 = axis;
        words.mNormalAxis1 = words.mNormalAxis2 = axis.GetNormalizedPerpendicular();
    }
    words.mPoint1 = words.mPoint2 = anchor;
    system.AddConstraint(words.Create(one, bodies[joint.b]));
}

function run() {
    const forces = scene.bodies.flatMap((b, k) => (b.force.some((x) => x !== 0) ? [[bodies[k], new Jolt.Vec3(...b.force)]] : []));
    const states = [];
    note(0, states);
    let seconds = 0;
    for (let k = 1; k <= scene.steps; k += scene.every) {
        const clock = process.hrtime.bigint();
        for (let i = 0; i < scene.every; i++) {
            // A force lasts one step; a sleeping body would be woken by one that is set.
            for (const [body, force] of forces) if (body.IsActive()) body.AddForce(force);
            globalThis.jolt.Step(scene.step, 1);
        }
        seconds += Number(process.hrtime.bigint() - clock) * 1e-9;
        if (k + scene.every - 1 <= scene.steps) note((k + scene.every - 1) * scene.step, states);
    }
    writeFileSync(`${out}.f64`, new Uint8Array(new Float64Array(states).buffer));
    console.log(seconds);
}

function note(time, states) {
    states.push(time);
    for (const body of bodies) {
        const [p, q, v, w] = [body.GetPosition(), body.GetRotation(), body.GetLinearVelocity(), body.GetAngularVelocity()];
        const [p3, v3, w3] = [p, v, w].map((x) => [x.GetX(), x.GetY(), x.GetZ()]);
        states.push(...p3, q.GetW(), q.GetX(), q.GetY(), q.GetZ(), ...v3, ...w3);
    }
}
