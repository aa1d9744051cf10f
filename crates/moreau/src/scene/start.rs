//! Checks of the bodies once they are made: masses, pairs of shapes that can touch, and overlaps.

use super::dimension::SceneSpace;
use super::error::Fault;
use super::path::{KeyPath, key_path};
use super::{BodySpec, Scene};
use crate::bodies::Bodies;
use crate::contacts::Contact;
use crate::detect::Detector;
use crate::joints::{Joint, parted};
use crate::shape::Shape;
use std::collections::BTreeMap;

/// Which part of a scene made a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    /// The body of this index.
    Body(usize),
    /// The builder of this index, and the how-manieth of its bodies.
    Built(usize, u64),
    /// A wall of the container of this index, and its face.
    Wall(usize, &'static str),
    /// The generator of this index, and the how-manieth of its bodies.
    Generated(usize, usize),
    /// The source of this index, and the how-manieth of its bodies.
    Source(usize, usize),
}

impl Origin {
    /// The origin of body `index` of the world.
    pub(super) fn of(scene: &Scene, index: usize) -> Option<Self> {
        if index < scene.bodies.len() {
            return Some(Origin::Body(index));
        }
        let mut left = index - scene.bodies.len();
        for (i, build) in scene.build.iter().enumerate() {
            let count = usize::try_from(build.count(scene.dimension.number())).unwrap_or(usize::MAX);
            if left < count {
                return Some(Origin::Built(i, left as u64));
            }
            left -= count;
        }
        for (i, container) in scene.containers.iter().enumerate() {
            let count = container.walls().count();
            if let Some((_, _, face)) = container.walls().nth(left) {
                return Some(Origin::Wall(i, face));
            }
            left -= count;
        }
        for (i, generate) in scene.generate.iter().enumerate() {
            let count = usize::try_from(generate.number(scene.dimension.number())).unwrap_or(usize::MAX);
            if left < count {
                return Some(Origin::Generated(i, left));
            }
            left -= count;
        }
        for (i, source) in scene.sources.iter().enumerate() {
            let count = usize::try_from(source.number(&scene.time)).unwrap_or(usize::MAX);
            if left < count {
                return Some(Origin::Source(i, left));
            }
            left -= count;
        }
        None
    }

    fn path(self) -> KeyPath {
        match self {
            Origin::Body(i) => key_path!["bodies", i],
            Origin::Built(i, _) => key_path!["build", i],
            Origin::Wall(i, _) => key_path!["containers", i],
            Origin::Generated(i, _) => key_path!["generate", i],
            Origin::Source(i, _) => key_path!["sources", i],
        }
    }

    /// Words for messages: `bodies[3] "hammer"`.
    pub(super) fn label(self, scene: &Scene) -> String {
        match self {
            Origin::Body(i) => match scene.bodies.get(i).and_then(|body| body.name.as_ref()) {
                Some(name) => format!("bodies[{i}] {name:?}"),
                None => format!("bodies[{i}]"),
            },
            Origin::Built(i, k) => {
                scene.build.get(i).map_or_else(|| format!("number {k} of build[{i}]"), |build| build.label_of(i, k))
            }
            Origin::Wall(i, face) => format!("wall {face} of containers[{i}]"),
            Origin::Generated(i, k) => format!("number {k} of generate[{i}]"),
            Origin::Source(i, k) => format!("number {k} of sources[{i}]"),
        }
    }
}

/// The fault of one body of the world; `part` is where in the scene's words for it.
fn fault(scene: &Scene, index: usize, part: &str, message: String, hint: &str) -> Fault {
    let path = match Origin::of(scene, index) {
        Some(origin @ Origin::Body(_)) if !part.is_empty() => origin.path().then(part),
        Some(origin) => origin.path(),
        None => KeyPath::default(),
    };
    Fault::new(path, message, hint)
}

fn label(scene: &Scene, index: usize) -> String {
    Origin::of(scene, index).map_or_else(|| format!("body {index}"), |origin| origin.label(scene))
}

pub(super) fn check<S: SceneSpace<D, N>, const D: usize, const N: usize>(
    scene: &Scene,
    bodies: &Bodies<S, D, N>,
    joints: &[Joint<D>],
) -> Result<(), Fault> {
    masses(scene, bodies)?;
    pairs(scene, bodies)?;
    overlaps(scene, bodies, joints)
}

/// Whether a body is free at some time: those of sources will be, and some that are held are freed.
fn is_ever_free<S: SceneSpace<D, N>, const D: usize, const N: usize>(scene: &Scene, bodies: &Bodies<S, D, N>, i: usize) -> bool {
    bodies.is_free(i) || !bodies.is_present(i) || scene.bodies.get(i).is_some_and(BodySpec::is_ever_free)
}

/// Positive numbers can still have a product that is too small or too large for a number.
fn masses<S: SceneSpace<D, N>, const D: usize, const N: usize>(scene: &Scene, bodies: &Bodies<S, D, N>) -> Result<(), Fault> {
    let free = |i: &usize| is_ever_free(scene, bodies, *i);
    let weighs = |m: &f64| [*m, 1.0 / m].iter().all(|x| x.is_finite() && *x > 0.0);
    let bad = (0..bodies.len()).filter(free).find(|&i| !bodies.mass[i].iter().all(weighs));
    bad.map_or(Ok(()), |i| {
        let message =
            format!("{} has the mass {} kg and no finite inverse of mass and inertia", label(scene, i), bodies.mass[i][0]);
        Err(fault(scene, i, "shape", message, "expected a size and a density that bodies have"))
    })
}

/// Every two kinds of shape that may touch need a row in the table of pairs.
fn pairs<S: SceneSpace<D, N>, const D: usize, const N: usize>(scene: &Scene, bodies: &Bodies<S, D, N>) -> Result<(), Fault> {
    // The first two bodies of each kind, apart by whether they are free.
    let mut kinds: BTreeMap<(&str, bool), Vec<usize>> = BTreeMap::new();
    for (i, shape) in bodies.shape.iter().enumerate() {
        let seen = kinds.entry((shape.name(), is_ever_free(scene, bodies, i))).or_default();
        if seen.len() < 2 {
            seen.push(i);
        }
    }
    for ((_, free), ours) in &kinds {
        for theirs in kinds.values().filter(|_| *free) {
            let a = ours[0];
            let Some(&b) = theirs.iter().find(|&&b| b != a) else { continue };
            if !bodies.shape[a].has_pair(&bodies.shape[b]) {
                let (a, b) = (a.min(b), a.max(b));
                let (first, second) = (bodies.shape[a].name(), bodies.shape[b].name());
                let message =
                    format!("no contact between {first} and {second}, as of {} and {}", label(scene, a), label(scene, b));
                return Err(fault(scene, b, "shape", message, "expected shapes that can touch, or both fixed or driven"));
            }
        }
    }
    Ok(())
}

/// The deepest overlap at the start, measured by the radius of the smaller body; of bodies that a joint keeps from touching none counts.
fn overlaps<S: SceneSpace<D, N>, const D: usize, const N: usize>(
    scene: &Scene,
    bodies: &Bodies<S, D, N>,
    joints: &[Joint<D>],
) -> Result<(), Fault> {
    let mut contacts: Vec<Contact<D>> = Vec::new();
    let reach = vec![0.0; bodies.len()];
    Detector::new().detect::<S, N>(&bodies.shape, &bodies.pose, &reach, |i| !bodies.is_free(i), &mut contacts);
    let mut apart = Vec::new();
    parted(joints, &mut apart);
    contacts.retain(|contact| apart.binary_search(&[contact.key.a, contact.key.b]).is_err());
    let part = |contact: &Contact<D>| {
        let radius = |i: u32| bodies.shape[i as usize].bounding_radius().unwrap_or(f64::INFINITY);
        -contact.gap / radius(contact.key.a).min(radius(contact.key.b))
    };
    let own = |i: u32| scene.bodies.get(i as usize).and_then(|body| body.max_overlap);
    let allowed = |contact: &Contact<D>| {
        let own = own(contact.key.a).into_iter().chain(own(contact.key.b)).reduce(f64::max);
        own.unwrap_or(scene.start.max_overlap)
    };
    let excess = |contact: &Contact<D>| part(contact) - allowed(contact);
    let Some(worst) = contacts.iter().max_by(|p, q| excess(p).total_cmp(&excess(q))) else { return Ok(()) };
    if part(worst) <= allowed(worst) {
        return Ok(());
    }
    let (a, b) = (worst.key.a as usize, worst.key.b as usize);
    let depth = -worst.gap;
    let message = format!(
        "{} and {} overlap at the start by {depth:.4e} m, which is {:.4} of the smaller one's radius",
        label(scene, a),
        label(scene, b),
        part(worst)
    );
    let mut hint = match own(worst.key.a).or(own(worst.key.b)) {
        Some(_) => format!("expected at most {}, which max_overlap of these bodies allows: move one of them", allowed(worst)),
        None => format!("expected at most start.max_overlap = {}: move one of them", scene.start.max_overlap),
    };
    if [a, b].iter().any(|&i| scene.bodies.get(i).is_some_and(|body| body.shape.is_cut())) {
        hint += ", or, since convex pieces fill hollows up to their tolerance, set a smaller concavity";
    }
    Err(fault(scene, b, "position", message, &hint))
}
