//! Checks of generators.

use super::{angular, material, positive, region, vector};
use crate::scene::error::Fault;
use crate::scene::generate::{Arrangement, arrangement};
use crate::scene::lattice::Sites;
use crate::scene::path::{KeyPath, key_path};
use crate::scene::{Generate, Lattice, LogNormal, Numbers, Packing, Radii, Range, Scene};

pub(super) fn check(scene: &Scene) -> Result<(), Fault> {
    scene.generate.iter().enumerate().try_for_each(|(i, generate)| generator(scene, generate, &key_path!["generate", i]))
}

fn generator(scene: &Scene, generate: &Generate, path: &KeyPath) -> Result<(), Fault> {
    material(scene, path.then("material"), &generate.material)?;
    radii(&generate.radii, &path.then("radii"))?;
    vector(scene, path.then("velocity"), &generate.velocity, true)?;
    angular(scene, path.then("spin"), generate.spin.as_ref())?;
    if !(generate.speed >= 0.0 && generate.speed.is_finite()) {
        let message = format!("the speed is {}", generate.speed);
        return Err(Fault::new(path.then("speed"), message, "expected 0 or a positive number, in m/s"));
    }
    if generate.count == Some(0) {
        return Err(Fault::new(path.then("count"), "a generator of 0 bodies", "expected 1 or more"));
    }
    let places = (generate.lattice.as_ref(), generate.packing.as_ref());
    arranged(scene, places, generate.count, generate.radii.largest(), path)
}

/// The places of bodies that are held by balls of radii up to the `largest`: on a lattice or in a packing.
pub(in crate::scene) fn arranged(
    scene: &Scene,
    (on, within): (Option<&Lattice>, Option<&Packing>),
    count: Option<u64>,
    largest: f64,
    path: &KeyPath,
) -> Result<(), Fault> {
    let Some(arrangement) = arrangement(on, within) else {
        let (message, hint) = match on {
            Some(_) => ("a lattice and a packing", "keep one of them"),
            None => ("no places", "add a lattice or a packing"),
        };
        return Err(Fault::new(path.clone(), message, format!("{hint}: exactly one is needed")));
    };
    let place = path.then(arrangement.name());
    let (min, max) = arrangement.region();
    region(scene, &place, min, max)?;
    match arrangement {
        Arrangement::Lattice(spec) => lattice(scene, spec, count, largest, path),
        Arrangement::Packing(_) if count.is_none() => {
            Err(Fault::new(path.clone(), "a packing without a count", "add `count = …`: how many bodies to put in"))
        }
        Arrangement::Packing(packing) if packing.tries == 0 => {
            Err(Fault::new(place.then("tries"), "no tries", "expected 1 or more"))
        }
        Arrangement::Packing(_) => Ok(()),
    }
}

fn lattice(scene: &Scene, spec: &Lattice, count: Option<u64>, largest: f64, path: &KeyPath) -> Result<(), Fault> {
    let place = path.then("lattice");
    if let Some(spacing) = spec.spacing {
        positive(place.then("spacing"), spacing, "in m")?;
    }
    if !(0.0..=1.0).contains(&spec.jitter) {
        let message = format!("the jitter is {}", spec.jitter);
        return Err(Fault::new(place.then("jitter"), message, "expected a part of the free room, from 0 to 1"));
    }
    let sites = Sites::new(spec, largest, scene.dimension.number());
    let (sites, spacing) = (sites.count(), sites.spacing());
    match count {
        _ if sites == 0 => {
            let message = format!("the region is narrower than the lattice's spacing of {spacing} m");
            Err(Fault::new(place, message, "expected a larger region or a smaller spacing"))
        }
        Some(count) if count > sites => {
            let message = format!("{count} bodies on a lattice of {sites} sites (spacing {spacing} m)");
            Err(Fault::new(path.then("count"), message, "expected fewer bodies, a larger region or a smaller spacing"))
        }
        _ => Ok(()),
    }
}

/// A distribution of radii.
pub(in crate::scene) fn radii(radii: &Radii, path: &KeyPath) -> Result<(), Fault> {
    match radii {
        Radii::Constant(radius) => positive(path.then("constant"), *radius, "in m"),
        Radii::Uniform(range) => limits(&path.then("uniform"), range.min, range.max),
        Radii::UniformMass(Range { min, max }) => limits(&path.then("uniform_mass"), *min, *max),
        Radii::LogNormal(LogNormal { median, sigma, min, max }) => {
            let path = path.then("log_normal");
            positive(path.then("median"), *median, "in m")?;
            limits(&path, *min, *max)?;
            if *sigma >= 0.0 && sigma.is_finite() {
                return Ok(());
            }
            Err(Fault::new(path.then("sigma"), format!("sigma is {sigma}"), "expected 0 or a positive number"))
        }
        Radii::Sieve(points) => sieve(&path.then("sieve"), points),
    }
}

fn limits(path: &KeyPath, min: f64, max: f64) -> Result<(), Fault> {
    positive(path.then("min"), min, "in m")?;
    positive(path.then("max"), max, "in m")?;
    if min <= max {
        return Ok(());
    }
    Err(Fault::new(path.then("max"), format!("max is {max} where min is {min}"), "expected max at or above min"))
}

fn sieve(path: &KeyPath, points: &[Numbers<2>]) -> Result<(), Fault> {
    let hint = "expected [size, fraction] in order of size, the fractions rising from 0 to 1";
    if points.len() < 2 {
        return Err(Fault::new(path.clone(), "a grading curve of less than two points", hint));
    }
    for (i, Numbers([size, _])) in points.iter().enumerate() {
        positive(path.then(i).then(0), *size, "in m")?;
    }
    let falls = points.windows(2).position(|p| {
        let [Numbers([small, below]), Numbers([large, above])] = [p[0], p[1]];
        small >= large || below > above || !above.is_finite()
    });
    if let Some(i) = falls {
        return Err(Fault::new(path.then(i + 1), "a grading curve that does not rise", hint));
    }
    let ends = [(0, points[0].0[1], 0.0), (points.len() - 1, points[points.len() - 1].0[1], 1.0)];
    for (i, found, wanted) in ends {
        if found != wanted {
            return Err(Fault::new(path.then(i).then(1), format!("the fraction is {found}, not {wanted}"), hint));
        }
    }
    Ok(())
}
