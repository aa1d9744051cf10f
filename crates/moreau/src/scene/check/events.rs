//! Checks of what happens in the course of a run: drives, removals, sources and sinks.

use super::bodies::nonzero;
use super::generate::radii;
use super::{finite, material, plural, positive, region, vector};
use crate::drive::{Function, Ramp, Sine, Table};
use crate::scene::error::Fault;
use crate::scene::path::{KeyPath, key_path};
use crate::scene::{BodySpec, DriveSpec, MotionKind, Numbers, Scene, SourceSpec};

pub(super) fn check(scene: &Scene) -> Result<(), Fault> {
    for (i, body) in scene.bodies.iter().enumerate() {
        drives(scene, body, &key_path!["bodies", i])?;
    }
    for (i, spec) in scene.sources.iter().enumerate() {
        source(scene, spec, &key_path!["sources", i])?;
    }
    let mut sinks = scene.sinks.iter().enumerate();
    sinks.try_for_each(|(i, sink)| region(scene, &key_path!["sinks", i], &sink.min, &sink.max))
}

/// The drives of one body, one after the other, and its end.
fn drives(scene: &Scene, body: &BodySpec, path: &KeyPath) -> Result<(), Fault> {
    if let Some(time) = body.removed_at {
        at_or_after_start(path.then("removed_at"), time)?;
    }
    for (i, spec) in body.drive.iter().enumerate() {
        let path = path.then("drive").then(i);
        at_or_after_start(path.then("from"), spec.from)?;
        if i > 0 && spec.from <= body.drive[i - 1].from {
            let message = format!("a drive from {} s after one from {} s", spec.from, body.drive[i - 1].from);
            return Err(Fault::new(
                path.then("from"),
                message,
                "expected drives in the order of their times, each later than the last",
            ));
        }
        if let Some(end) = body.removed_at.filter(|&end| spec.from >= end) {
            let message = format!("a drive from {} s of a body that is removed at {end} s", spec.from);
            return Err(Fault::new(path.then("from"), message, "expected a time before removed_at"));
        }
        motion(body, spec, &path)?;
        drive(scene, spec, &path)?;
    }
    from_the_start(body, path)
}

fn at_or_after_start(path: KeyPath, time: f64) -> Result<(), Fault> {
    if time >= 0.0 && time.is_finite() {
        return Ok(());
    }
    Err(Fault::new(path, format!("the time is {time}"), "expected 0 (the start of the run) or a positive number, in s"))
}

/// What a drive gives must be of a kind with how the body moves under it.
fn motion(body: &BodySpec, spec: &DriveSpec, path: &KeyPath) -> Result<(), Fault> {
    let loaded = if !spec.force.is_empty() { Some("force") } else { (!spec.torque.is_empty()).then_some("torque") };
    match (spec.motion(), loaded) {
        (MotionKind::Free, None) if spec.motion.is_none() => {
            let hint = "give a velocity, position, spin or angle, a force or torque, or motion = \"free\" or \"fixed\"";
            Err(Fault::new(path.clone(), "a drive that does nothing", hint))
        }
        (MotionKind::Free, _) if !body.shape.has_mass() => {
            let message = format!("a drive that frees a {}: it has no mass", body.shape.name());
            let part = if spec.motion.is_some() { path.then("motion") } else { path.clone() };
            Err(Fault::new(part, message, "expected a velocity, position, spin or angle, or motion = \"fixed\""))
        }
        (MotionKind::Free | MotionKind::Fixed, _) if spec.imposes() => {
            let hint = "leave motion out, or set it to \"driven\": only driven bodies move as given";
            Err(Fault::new(path.then("motion"), "a body that is not driven, with a motion that is given", hint))
        }
        (MotionKind::Driven | MotionKind::Fixed, Some(key)) => {
            let hint = "put it into a drive of its own: only free bodies follow forces";
            Err(Fault::new(path.then(key), format!("a {key} on a body that is not free"), hint))
        }
        (MotionKind::Driven, None) if !spec.imposes() => {
            let hint = "give a velocity, position, spin or angle; a body that stands still is \"fixed\"";
            Err(Fault::new(path.then("motion"), "a driven body without a motion", hint))
        }
        _ => Ok(()),
    }
}

/// What the body says of its start must not contradict a drive that it has from the start.
fn from_the_start(body: &BodySpec, path: &KeyPath) -> Result<(), Fault> {
    let Some(first) = body.first_drive() else { return Ok(()) };
    if body.motion() != first.motion() {
        let hint = "leave it out: the drive says how the body moves, or let it begin later";
        return Err(Fault::new(path.then("motion"), "another motion than that of the drive from the start", hint));
    }
    let given = if body.velocity.is_empty() { body.spin.is_some().then_some("spin") } else { Some("velocity") };
    match given {
        Some(key) if first.imposes() => {
            let hint = "leave it out: the drive gives the motion, or let it begin later";
            Err(Fault::new(path.then(key), format!("a {key} beside a drive from the start"), hint))
        }
        _ => Ok(()),
    }
}

fn drive(scene: &Scene, spec: &DriveSpec, path: &KeyPath) -> Result<(), Fault> {
    let dimension = scene.dimension.number();
    let turns = 2 * dimension - 3;
    let vectors = [("velocity", &spec.velocity, dimension), ("position", &spec.position, dimension)];
    let loads = [("force", &spec.force, dimension), ("torque", &spec.torque, turns)];
    for (key, functions, wanted) in vectors.into_iter().chain(loads) {
        if !functions.is_empty() && functions.len() != wanted {
            let message = format!("{} where dimension = {dimension}", plural(functions.len(), "component"));
            return Err(Fault::new(path.then(key), message, format!("expected {}", plural(wanted, "function"))));
        }
        functions.iter().enumerate().try_for_each(|(k, f)| function(f, &path.then(key).then(k)))?;
    }
    if !spec.velocity.is_empty() && !spec.position.is_empty() {
        return Err(Fault::new(path.then("position"), "a position and a velocity", "keep one of them: each gives the other"));
    }
    for (key, given) in [("spin", &spec.spin), ("angle", &spec.angle)] {
        given.iter().try_for_each(|f| function(f, &path.then(key)))?;
    }
    axis(spec, path, dimension)
}

fn axis(spec: &DriveSpec, path: &KeyPath, dimension: usize) -> Result<(), Fault> {
    let turns = match (&spec.spin, &spec.angle) {
        (Some(_), Some(_)) => {
            return Err(Fault::new(path.then("angle"), "an angle and a spin", "keep one of them: each gives the other"));
        }
        (None, None) => false,
        _ => true,
    };
    let key = if spec.spin.is_some() { "spin" } else { "angle" };
    match &spec.axis {
        Some(_) if dimension == 2 => {
            Err(Fault::new(path.then("axis"), "an axis in the plane", "leave it out: the plane turns about z"))
        }
        Some(_) if !turns => {
            Err(Fault::new(path.then("axis"), "an axis without a turn", "give a spin or an angle, or leave it out"))
        }
        Some(Numbers(axis)) => nonzero(&path.then("axis"), axis),
        None if turns && dimension == 3 => {
            Err(Fault::new(path.then(key), format!("a {key} without an axis"), "add `axis = [0, 0, 1]`"))
        }
        None => Ok(()),
    }
}

/// A function of time.
fn function(function: &Function, path: &KeyPath) -> Result<(), Fault> {
    match function {
        Function::Constant(value) => finite(path, &[*value]).map_err(|fault| Fault { path: path.clone(), ..fault }),
        Function::Ramp(Ramp { from, to, begin, end }) => {
            let path = path.then("ramp");
            for (key, value) in [("from", from), ("to", to), ("begin", begin), ("end", end)] {
                number(path.then(key), *value)?;
            }
            if begin < end {
                return Ok(());
            }
            Err(Fault::new(path.then("end"), format!("end is {end} where begin is {begin}"), "expected end after begin"))
        }
        Function::Sine(Sine { amplitude, frequency, phase, offset }) => {
            let path = path.then("sine");
            for (key, value) in [("amplitude", amplitude), ("phase", phase), ("offset", offset)] {
                number(path.then(key), *value)?;
            }
            positive(path.then("frequency"), *frequency, "in Hz")
        }
        Function::Table(points) => table(points, &path.then("table")),
    }
}

fn table(Table { times, values }: &Table, path: &KeyPath) -> Result<(), Fault> {
    finite(&path.then("times"), times)?;
    finite(&path.then("values"), values)?;
    if times.is_empty() {
        return Err(Fault::new(path.then("times"), "a table without points", "expected one time or more"));
    }
    if times.len() != values.len() {
        let message = format!("{} for {}", plural(values.len(), "value"), plural(times.len(), "time"));
        return Err(Fault::new(path.then("values"), message, "expected a value for each time"));
    }
    let falls = times.windows(2).position(|pair| pair[0] >= pair[1]);
    falls.map_or(Ok(()), |i| {
        let message = format!("the time {} after {}", times[i + 1], times[i]);
        Err(Fault::new(path.then("times").then(i + 1), message, "expected times in ascending order, each once"))
    })
}

fn number(path: KeyPath, value: f64) -> Result<(), Fault> {
    if value.is_finite() { Ok(()) } else { Err(Fault::new(path, format!("the value is {value}"), "expected a finite number")) }
}

fn source(scene: &Scene, spec: &SourceSpec, path: &KeyPath) -> Result<(), Fault> {
    material(scene, path.then("material"), &spec.material)?;
    radii(&spec.radii, &path.then("radii"))?;
    region(scene, path, &spec.min, &spec.max)?;
    let largest = 2.0 * spec.radii.largest();
    if let Some(k) = spec.min.iter().zip(&spec.max).position(|(low, high)| high - low < largest) {
        let message = format!("a region of {} m for diameters of up to {largest} m", spec.max[k] - spec.min[k]);
        return Err(Fault::new(path.then("max").then(k), message, "expected a region in which the largest has room"));
    }
    match (spec.rate, spec.interval) {
        (Some(rate), None) => positive(path.then("rate"), rate, "in 1/s")?,
        (None, Some(interval)) => positive(path.then("interval"), interval, "in s")?,
        _ => {
            return Err(Fault::new(path.clone(), "not exactly one of rate and interval", "expected either `rate` or `interval`"));
        }
    }
    at_or_after_start(path.then("from"), spec.from)?;
    if let Some(until) = spec.until.filter(|&until| !(until >= spec.from && until.is_finite())) {
        let message = format!("until is {until} where from is {}", spec.from);
        return Err(Fault::new(path.then("until"), message, "expected until at or after from"));
    }
    for (key, count) in [("count", spec.count), ("tries", Some(spec.tries))] {
        if count == Some(0) {
            return Err(Fault::new(path.then(key), format!("{key} is 0"), "expected 1 or more"));
        }
    }
    vector(scene, path.then("velocity"), &spec.velocity, true)
}
