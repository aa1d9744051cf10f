//! Interfaces: the contacts between two bodies taken together, and the line of thrust through them.
//!
//! The impulses of one pair come down to a force, a moment and the point where the normal force acts: the centre of pressure. In a masonry
//! these say more than single points, whose impulses are not unique where four corners share a load. The centres of pressure, joined through
//! the stones, are the line of thrust (Heyman 1995, The Stone Skeleton).

use crate::bodies::Bodies;
use crate::space::Space;
use crate::step::Localised;
use moreau_solve::Cone;
use moreau_solve::block::{dot, norm, sub};

/// A force below this part of the largest on a body carries nothing: it is what a solver leaves at its tolerance.
const LOADED: f64 = 1e-6;

/// All contacts between two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interface<const D: usize> {
    /// The two bodies, the one with the lower index first.
    pub bodies: [u32; 2],
    /// How many contact points there are.
    pub points: usize,
    /// Their mean, m.
    pub centre: [f64; D],
    /// Unit normal from the first body to the second: the direction of the normal forces together, or of the normals where none presses.
    pub normal: [f64; D],
    /// The resultant on the second body, N (in the plane N per metre of depth): impulses divided by the time in which they act.
    pub force: [f64; D],
    /// Its moment about the centre, N·m; in the plane the third component alone.
    pub moment: [f64; 3],
    /// The centre of pressure: the mean of the points, each weighed by its normal impulse; the centre where none presses. Where all points
    /// lie in one plane with one normal, the resultant passes through it, but for a torque about the normal.
    pub pressure: [f64; D],
    /// The part of the resultant along the normal, N.
    pub normal_force: f64,
    /// What is left of it, N.
    pub shear_force: f64,
    /// The shear force over the most that friction can give, Σ μ times the normal force of each point: 1 where the whole interface is about
    /// to slide one way. Zero where no point that presses has a coefficient of friction.
    pub mobilised: f64,
}

impl<const D: usize> Interface<D> {
    /// Distance of the centre of pressure from the centre, m.
    pub fn eccentricity(&self) -> f64 {
        norm(&sub(&self.pressure, &self.centre))
    }

    /// Of contacts of one pair, which acted for the time `h`.
    fn of(contacts: &[Localised<D>], h: f64) -> Self {
        let key = contacts[0].contact.key;
        let mean: [f64; D] = sum(contacts, |c, k| c.contact.point[k]).map(|x| x / contacts.len() as f64);
        let pressing: f64 = contacts.iter().map(|c| c.impulse[0]).sum();
        let weighed: [f64; D] = sum(contacts, |c, k| c.impulse[0] * (c.contact.point[k] - mean[k]));
        let pressure = if pressing > 0.0 { std::array::from_fn(|k| mean[k] + weighed[k] / pressing) } else { mean };
        let normal = direction(&sum(contacts, |c, k| c.impulse[0] * c.contact.normal[k]))
            .or_else(|| direction(&sum(contacts, |c, k| c.contact.normal[k])))
            .unwrap_or(contacts[0].contact.normal);
        let force = sum(contacts, |c, k| c.impulse_in_world()[k] / h);
        let moment = contacts.iter().fold([0.0; 3], |all, c| {
            let one = cross(&sub(&c.contact.point, &mean), &c.impulse_in_world());
            std::array::from_fn(|k| all[k] + one[k] / h)
        });
        let normal_force = dot(&force, &normal);
        let shear_force = norm(&std::array::from_fn::<_, D, _>(|k| force[k] - normal_force * normal[k]));
        let friction: f64 = contacts.iter().map(|c| friction(c) * c.impulse[0] / h).sum();
        let mobilised = if friction > 0.0 { shear_force / friction } else { 0.0 };
        let bodies = [key.a, key.b];
        let points = contacts.len();
        Self { bodies, points, centre: mean, normal, force, moment, pressure, normal_force, shear_force, mobilised }
    }

    /// The force on one of the two bodies.
    fn force_on(&self, body: u32) -> [f64; D] {
        if body == self.bodies[1] { self.force } else { self.force.map(|f| -f) }
    }
}

/// The interfaces of all pairs of bodies, sorted as the contacts are, which acted for the time `h` (s).
///
/// Where a step was halved, contacts are those of its last part: see [`StepRecord::h`](crate::step::StepRecord::h).
pub fn interfaces<const D: usize>(contacts: &[Localised<D>], h: f64) -> impl Iterator<Item = Interface<D>> {
    let pair = |c: &Localised<D>| (c.contact.key.a, c.contact.key.b);
    contacts.chunk_by(move |one, next| pair(one) == pair(next)).map(move |contacts| Interface::of(contacts, h))
}

/// The line of thrust: which interfaces are joined through a free body, as pairs of indices.
///
/// A body between two loaded interfaces joins them. One with more joins each that bears down on it (its force on the body is along gravity)
/// with each that holds it up; where none bears down, these carry its own weight alone, and nothing is joined.
pub fn thrust<S: Space<D, N>, const D: usize, const N: usize>(
    interfaces: &[Interface<D>],
    bodies: &Bodies<S, D, N>,
    gravity: &[f64; D],
) -> Vec<[usize; 2]> {
    let mut sides: Vec<(u32, usize)> = (0..interfaces.len()).flat_map(|i| interfaces[i].bodies.map(|body| (body, i))).collect();
    sides.retain(|&(body, i)| bodies.is_free(body as usize) && interfaces[i].normal_force > 0.0);
    sides.sort_unstable();
    let mut joined = Vec::new();
    for of_body in sides.chunk_by(|one, next| one.0 == next.0) {
        let largest = of_body.iter().map(|&(_, i)| interfaces[i].normal_force).fold(0.0, f64::max);
        let loaded = || of_body.iter().filter(|&&(_, i)| interfaces[i].normal_force > LOADED * largest);
        let bears = |&(body, i): &(u32, usize)| dot(&interfaces[i].force_on(body), gravity) > 0.0;
        if loaded().count() == 2 {
            joined.extend(loaded().zip(loaded().skip(1)).map(|(one, other)| [one.1, other.1]));
        } else {
            for above in loaded().filter(|side| bears(side)) {
                joined.extend(loaded().filter(|side| !bears(side)).map(|below| [above.1, below.1]));
            }
        }
    }
    joined
}

/// The coefficient of friction; none where the law has no friction, or no limit of it.
fn friction<const D: usize>(c: &Localised<D>) -> f64 {
    if let Cone::Coulomb(mu) = c.form.cone { mu } else { 0.0 }
}

/// Σ over contacts, component by component.
fn sum<const D: usize>(contacts: &[Localised<D>], of: impl Fn(&Localised<D>, usize) -> f64) -> [f64; D] {
    std::array::from_fn(|k| contacts.iter().map(|c| of(c, k)).sum())
}

/// The unit vector along this one, if it has a direction.
fn direction<const D: usize>(v: &[f64; D]) -> Option<[f64; D]> {
    let length = norm(v);
    (length > 0.0).then(|| v.map(|x| x / length))
}

/// Of vectors of the plane the third component alone.
fn cross<const D: usize>(a: &[f64; D], b: &[f64; D]) -> [f64; 3] {
    let at = |v: &[f64; D], k: usize| v.get(k).copied().unwrap_or(0.0);
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        at(a, i) * at(b, j) - at(a, j) * at(b, i)
    })
}
