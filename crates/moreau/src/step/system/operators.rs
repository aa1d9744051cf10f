//! How the operators of the solver are made of bodies, and what their states mean to bodies.

use crate::bodies::Bodies;
use crate::shape::Shape;
use crate::space::curve::Curve;
use crate::space::{Pose, Space};
use crate::step::workspace::Localised;
use moreau_solve::block::dot;
use moreau_solve::operator::balls::RoundBody;
use moreau_solve::operator::{Balls, MatrixFree, NONE, Operator};
use moreau_solve::tasks;

/// Contacts from which their order in space pays: fewer stay in a cache.
const ORDERED: usize = 1024;

/// An operator over K components, made of the contacts of bodies.
pub(in crate::step) trait Assembled<S: Space<D, N>, const D: usize, const N: usize, const K: usize>:
    Operator<K> + Default
{
    /// Takes these contacts of these bodies, in the place of those that it had.
    fn fill(&mut self, bodies: &Bodies<S, D, N>, middle: &[Pose<S::Rotation, D>], contacts: &[Localised<D>], curve: &mut Curve);
    /// Adds to the velocities what `state` stands for.
    fn give(&self, state: &Self::State, bodies: &Bodies<S, D, N>, middle: &[Pose<S::Rotation, D>], velocity: &mut [[f64; N]]);
}

/// The bodies of a contact as the solver counts them.
fn pair<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>, contact: &Localised<D>) -> [u32; 2] {
    let key = contact.contact.key;
    [key.a, key.b].map(|body| if bodies.is_free(body as usize) { body } else { NONE })
}

/// From the middle of a body to the contact, m.
fn arm<R, const D: usize>(middle: &[Pose<R, D>], contact: &Localised<D>, body: u32) -> [f64; D] {
    std::array::from_fn(|k| contact.contact.point[k] - middle[body as usize].position[k])
}

impl<S: Space<D, N>, const D: usize, const N: usize, const K: usize> Assembled<S, D, N, K> for MatrixFree<K, N> {
    /// The two blocks of each contact's row of H*, times M^{-1/2}: minus for body a, plus for body b, so that H* v is the velocity of b
    /// relative to a.
    fn fill(&mut self, bodies: &Bodies<S, D, N>, middle: &[Pose<S::Rotation, D>], contacts: &[Localised<D>], _: &mut Curve) {
        self.clear(bodies.len());
        for contact in contacts {
            let side = |body: u32, sign: f64| {
                let (i, arm) = (body as usize, arm(middle, contact, body));
                std::array::from_fn(|component| {
                    let row = S::row(middle[i].rotation, arm, contact.frame[component]);
                    // The normal of a round body passes through its centre; rounding must not make it spin.
                    let turns = component > 0 || !bodies.shape[i].is_round();
                    let weighed = |k: usize| sign * row[k] * bodies.root_inverse_mass[i][k];
                    std::array::from_fn(|k| if k < D || turns { weighed(k) } else { 0.0 })
                })
            };
            let key = contact.contact.key;
            self.push(pair(bodies, contact), [side(key.a, -1.0), side(key.b, 1.0)]);
        }
    }

    /// The state is y = M^{-1/2} H r.
    fn give(&self, state: &Self::State, bodies: &Bodies<S, D, N>, _: &[Pose<S::Rotation, D>], velocity: &mut [[f64; N]]) {
        tasks::each(velocity, |i, v| (0..N).for_each(|k| v[k] += bodies.root_inverse_mass[i][k] * state[i][k]));
    }
}

impl<S: Space<D, N>, const D: usize, const N: usize, const K: usize> Assembled<S, D, N, K> for Balls<K> {
    fn fill(&mut self, bodies: &Bodies<S, D, N>, middle: &[Pose<S::Rotation, D>], contacts: &[Localised<D>], curve: &mut Curve) {
        let inverse = bodies.inverse_mass.iter();
        self.clear(inverse.map(|inverse| RoundBody { inverse_mass: inverse[0], inverse_inertia: inverse[D] }));
        Balls::fill(self, contacts.len(), |c| {
            let contact = &contacts[c];
            let along = |body: u32| dot(&contact.contact.normal, &arm(middle, contact, body));
            let filled = |i: usize| std::array::from_fn(|k| if k < D { contact.frame[i][k] } else { 0.0 });
            let key = contact.contact.key;
            (pair(bodies, contact), std::array::from_fn(filled), [along(key.a), -along(key.b)])
        });
        if contacts.len() > ORDERED {
            self.order(curve.places(middle, |i| bodies.is_free(i)));
        }
    }

    /// The state is a velocity, and a spin in the world.
    fn give(&self, state: &Self::State, _: &Bodies<S, D, N>, middle: &[Pose<S::Rotation, D>], velocity: &mut [[f64; N]]) {
        tasks::each(velocity, |i, v| {
            let [change, [x, y, z, _]] = &state[i];
            (0..D).for_each(|k| v[k] += change[k]);
            if K > 1 {
                // The same turn as of a torque, whose components come last.
                let mut spin = [0.0; N];
                let axes = [*x, *y, *z];
                (D..N).for_each(|k| spin[k] = axes[3 + k - N]);
                let turned = S::load_in_body(middle[i].rotation, &spin);
                (D..N).for_each(|k| v[k] += turned[k]);
            }
        });
    }
}
