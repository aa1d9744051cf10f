//! Volume, centre of mass and inertia of what a closed surface of triangles holds, exactly, and principal axes; theory (66).

use crate::space::Pose;
use crate::symmetric::diagonal;
use glam::{DMat3, DQuat, DVec3};

/// The first moments of a body of density 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// m³.
    pub volume: f64,
    /// Centre of mass, m.
    pub centre: [f64; 3],
    /// ∫ x xᵀ dV about the centre of mass, m⁵.
    pub second: [[f64; 3]; 3],
}

impl Moments {
    /// Of what lies within a closed surface of triangles that run counter-clockwise seen from outside: the sum over the tetrahedra from
    /// one point to each of them, with their signs.
    pub fn of_closed(triangles: impl Iterator<Item = [[f64; 3]; 3]> + Clone) -> Self {
        // A point of the surface, so that a body far from the origin loses nothing.
        let origin = triangles.clone().next().map_or(DVec3::ZERO, |[p, ..]| DVec3::from(p));
        let (mut volume, mut first, mut second) = (0.0, DVec3::ZERO, DMat3::ZERO);
        for triangle in triangles {
            let [p, q, r] = triangle.map(|x| DVec3::from(x) - origin);
            let six = p.dot(q.cross(r));
            let sum = p + q + r;
            volume += six / 6.0;
            first += six / 24.0 * sum;
            second += six / 120.0 * [p, q, r, sum].map(outer).into_iter().sum::<DMat3>();
        }
        let centre = if volume == 0.0 { DVec3::ZERO } else { first / volume };
        let second = (second - volume * outer(centre)).to_cols_array_2d();
        Self { volume, centre: (origin + centre).into(), second }
    }

    /// Of a body with this mass matrix (of density 1) so placed.
    pub fn of_body(mass: &[f64; 6], pose: &Pose<DQuat, 3>) -> Self {
        let inertia = DVec3::new(mass[3], mass[4], mass[5]);
        let turn = DMat3::from_quat(pose.rotation);
        // J = tr S − S, so S = ½ tr J − J.
        let half_trace = 0.5 * inertia.element_sum();
        let second = turn * DMat3::from_diagonal(DVec3::splat(half_trace) - inertia) * turn.transpose();
        Self { volume: mass[0], centre: pose.position, second: second.to_cols_array_2d() }
    }

    /// Of several bodies together.
    pub fn sum(parts: impl Iterator<Item = Self> + Clone) -> Self {
        let volume: f64 = parts.clone().map(|part| part.volume).sum();
        let first: DVec3 = parts.clone().map(|part| part.volume * DVec3::from(part.centre)).sum();
        let centre = first / volume;
        let about = |part: Self| DMat3::from_cols_array_2d(&part.second) + part.volume * outer(DVec3::from(part.centre) - centre);
        let second: DMat3 = parts.map(about).sum();
        Self { volume, centre: centre.into(), second: second.to_cols_array_2d() }
    }

    /// Principal moments of inertia at density 1 (m⁵) and the rotation from the principal axes. Axes that are principal already stay what
    /// they are, in their order; so a cube stays unturned.
    pub fn principal(&self) -> ([f64; 3], DQuat) {
        let (s, axes) = diagonal(self.second);
        let total: f64 = s.iter().sum();
        (s.map(|s| total - s), DQuat::from_mat3(&DMat3::from_cols_array_2d(&axes)).normalize())
    }
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The surface of a box with a corner at `at` and edges along the columns of a rotation.
    fn turned_box(size: [f64; 3], at: DVec3, turn: DQuat) -> Vec<[[f64; 3]; 3]> {
        let corner =
            |i: usize| at + turn * DVec3::from_array(std::array::from_fn(|k| if i >> k & 1 == 1 { size[k] } else { 0.0 }));
        let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let halves = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        halves.map(|triangle| triangle.map(|i| corner(i).into())).collect()
    }

    #[test]
    fn a_box_anywhere_has_the_moments_of_a_box() {
        let turn = DQuat::from_xyzw(0.1, -0.5, 0.3, 0.8).normalize();
        let (size, at) = ([1.0, 2.0, 3.0], DVec3::new(1e3, -2e3, 5.0));
        let found = Moments::of_closed(turned_box(size, at, turn).into_iter());
        assert!((found.volume - 6.0).abs() < 1e-10);
        let centre = at + turn * DVec3::new(0.5, 1.0, 1.5);
        assert!((DVec3::from(found.centre) - centre).length() < 1e-9);
        let (mut moments, rotation) = found.principal();
        // In the principal axes the inertia is diagonal: turned back it is the box's.
        let back = DMat3::from_quat(rotation) * DMat3::from_diagonal(moments.into()) * DMat3::from_quat(rotation).transpose();
        let expected =
            DMat3::from_quat(turn) * DMat3::from_diagonal(DVec3::new(6.5, 5.0, 2.5)) * DMat3::from_quat(turn).transpose();
        assert!((back - expected).to_cols_array().iter().all(|x| x.abs() < 1e-9), "{back} {expected}");
        moments.sort_by(f64::total_cmp);
        assert!((DVec3::from(moments) - DVec3::new(2.5, 5.0, 6.5)).length() < 1e-9, "{moments:?}");
    }

    #[test]
    fn axes_that_are_principal_stay() {
        for size in [[1.0; 3], [3.0, 2.0, 1.0], [1.0, 1.0, 5.0]] {
            let found = Moments::of_closed(turned_box(size, DVec3::new(0.3, 0.7, -0.2), DQuat::IDENTITY).into_iter());
            assert_eq!(found.principal().1, DQuat::IDENTITY, "{size:?}");
        }
    }

    #[test]
    fn a_tetrahedron_has_the_moments_of_its_integral() {
        let [o, x, y, z] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let found = Moments::of_closed([[o, y, x], [o, x, z], [o, z, y], [x, y, z]].into_iter());
        assert!((found.volume - 1.0 / 6.0).abs() < 1e-16 && found.centre.iter().all(|c| (c - 0.25).abs() < 1e-15));
        // ∫ x² = 1/60 and ∫ x y = 1/120, less V/16 for the centre.
        for (i, row) in found.second.iter().enumerate() {
            for (j, &value) in row.iter().enumerate() {
                let about_origin = if i == j { 1.0 / 60.0 } else { 1.0 / 120.0 };
                assert!((value - (about_origin - 1.0 / 96.0)).abs() < 1e-16);
            }
        }
    }
}
