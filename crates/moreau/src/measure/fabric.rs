//! The fabric: which way contacts point; theory (74).

use super::branch::branch;
use crate::space::Space;
use crate::step::Localised;
use crate::world::World;
use moreau_solve::block::{Matrix, norm, sub};

/// The fabric tensor of these contacts, the mean of n nᵀ over their normals; its trace is 1, or 0 where there are none. Each contact point
/// counts, so faces that meet count with all of theirs.
pub fn fabric<'a, const D: usize>(contacts: impl IntoIterator<Item = &'a Localised<D>>) -> Matrix<D> {
    mean_of(contacts.into_iter().map(|c| c.contact.normal))
}

/// The same over the directions of branch vectors, see [`branch`](super::branch()); they differ from the normals where bodies are not round. A
/// branch without length is left out.
pub fn branch_fabric<'a, S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    contacts: impl IntoIterator<Item = &'a Localised<D>>,
) -> Matrix<D> {
    let along = |c: &Localised<D>| {
        let [from, to] = branch(world, c);
        let way = sub(&to, &from);
        let length = norm(&way);
        (length > 0.0).then(|| way.map(|x| x / length))
    };
    mean_of(contacts.into_iter().filter_map(along))
}

fn mean_of<const D: usize>(directions: impl Iterator<Item = [f64; D]>) -> Matrix<D> {
    let (mut sum, mut count) = ([[0.0; D]; D], 0_u64);
    for n in directions {
        count += 1;
        for i in 0..D {
            for j in 0..D {
                sum[i][j] += n[i] * n[j];
            }
        }
    }
    sum.map(|row| row.map(|x| x / count.max(1) as f64))
}
