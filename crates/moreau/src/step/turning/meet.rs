//! Where two simple contours meet: normal, gap and point, wherever they are (theory (85)).
//!
//! With the farthest points σ_a(n) and σ_b(−n) along a unit vector n from a to b, the gap is the greatest value of
//!
//! ```text
//! s(n) = n·(σ_b(−n) − σ_a(n)),     its slope   d = (σ_b − σ_a) across n,     its bend   −(ϱ_a + ϱ_b + s I)
//! ```
//!
//! with the radii of curvature ϱ. Of a plane n is known; else Newton's method finds it from the normal that the contact had.

use crate::shape::{Contour, SAME};
use moreau_solve::block::{axpy, dot, norm, solve, sub};

/// Rounds of Newton's method: n is off by the square of h |ω| at first, the gap by the square of that.
const ROUNDS: usize = 3;

/// How far a round may turn the normal, rad: what turns farther has no curvature to speak of, as two corners.
const FAR: f64 = 0.5;

/// How two contours meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting<const D: usize> {
    /// Half-way between the surfaces, m.
    pub(super) point: [f64; D],
    /// m.
    pub(super) gap: f64,
}

/// How two contours of the world meet about the unit vector `normal` from the first to the second; `None` where that is not to be had.
pub(super) fn meet<const D: usize>(contours: &[Contour<D>; 2], normal: [f64; D]) -> Option<Meeting<D>> {
    let normal = match contours {
        [Contour::Flat { outward, .. }, _] => *outward,
        [_, Contour::Flat { outward, .. }] => outward.map(|x| -x),
        _ => turned(contours, normal)?,
    };
    let (on_a, on_b) = farthest(contours, &normal)?;
    let gap = dot(&normal, &sub(&on_b, &on_a));
    // Of a plane and of a line the farthest point is any; the other's counts.
    let point = match contours {
        [Contour::Line { at: a, way: along_a, .. }, Contour::Line { at: b, way: along_b, .. }] => {
            let shift = crossing((a, along_a), (b, along_b))?;
            axpy(&axpy(&on_a, 0.5 * gap, &normal), shift, along_a)
        }
        [_, Contour::Flat { .. } | Contour::Line { .. }] => axpy(&on_a, 0.5 * gap, &normal),
        _ => axpy(&on_b, -0.5 * gap, &normal),
    };
    Some(Meeting { point, gap })
}

/// How far along the first of two lines it is nearest to the second; `None` where they are parallel.
fn crossing<const D: usize>((a, along_a): (&[f64; D], &[f64; D]), (b, along_b): (&[f64; D], &[f64; D])) -> Option<f64> {
    let (between, cosine) = (sub(b, a), dot(along_a, along_b));
    let square = 1.0 - cosine * cosine;
    (square > SAME * SAME).then(|| (dot(&between, along_a) - cosine * dot(&between, along_b)) / square)
}

/// The farthest points of the first along `normal` and of the second against it.
fn farthest<const D: usize>(contours: &[Contour<D>; 2], normal: &[f64; D]) -> Option<([f64; D], [f64; D])> {
    Some((support(&contours[0], normal)?, support(&contours[1], &normal.map(|x| -x))?))
}

/// The farthest point of a contour along a unit vector.
fn support<const D: usize>(contour: &Contour<D>, outward: &[f64; D]) -> Option<[f64; D]> {
    match contour {
        Contour::Flat { at, .. } => Some(*at),
        Contour::Ball { centre, radius } => Some(axpy(centre, *radius, outward)),
        Contour::Line { at, radius, .. } => Some(axpy(at, *radius, outward)),
        Contour::Rim { centre, axis, radius } => {
            let across = axpy(outward, -dot(outward, axis), axis);
            let length = norm(&across);
            (length > 0.0).then(|| axpy(centre, radius / length, &across))
        }
    }
}

/// The normal at which two curved contours are farthest apart.
fn turned<const D: usize>(contours: &[Contour<D>; 2], normal: [f64; D]) -> Option<[f64; D]> {
    let mut n = across_lines(contours, normal)?;
    for _ in 0..ROUNDS {
        let (on_a, on_b) = farthest(contours, &n)?;
        let mut slope = sub(&on_b, &on_a);
        let gap = dot(&n, &slope);
        slope = axpy(&slope, -gap, &n);
        let mut bend = [[0.0; D]; D];
        let mut across: [[f64; D]; D] = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
        take(&mut across, 1.0, &n);
        add(&mut bend, gap, &across);
        for contour in contours {
            radii(contour, &n, &across, &mut bend)?;
            if let Contour::Line { way, .. } = contour {
                slope = axpy(&slope, -dot(&slope, way), way);
            }
        }
        // What is along a line or the normal is none of the unknowns: any number will do, in the scale of the others.
        let size = (0..D).map(|i| bend[i][i].abs()).sum::<f64>();
        take(&mut bend, -size, &n);
        for contour in contours {
            if let Contour::Line { way, .. } = contour {
                take(&mut bend, -1e6 * size, way);
            }
        }
        let turn = solve(&bend, &slope)?;
        let angle = norm(&turn);
        if angle.is_nan() || angle >= FAR {
            return None;
        }
        n = across_lines(contours, axpy(&n, 1.0, &turn))?;
    }
    Some(n)
}

/// The unit vector along what of `n` is across the lines among the contours.
fn across_lines<const D: usize>(contours: &[Contour<D>; 2], n: [f64; D]) -> Option<[f64; D]> {
    let mut n = n;
    let mut first: Option<[f64; D]> = None;
    for contour in contours {
        let Contour::Line { way, .. } = contour else { continue };
        // The second line across the first.
        let way = first.map_or(*way, |first| axpy(way, -dot(way, &first), &first));
        let length = norm(&way);
        if length < SAME {
            continue;
        }
        let way = way.map(|x| x / length);
        n = axpy(&n, -dot(&n, &way), &way);
        first = Some(way);
    }
    let length = norm(&n);
    (length > FAR).then(|| n.map(|x| x / length))
}

/// Adds the radii of curvature of a contour across `n`.
fn radii<const D: usize>(contour: &Contour<D>, n: &[f64; D], across: &[[f64; D]; D], bend: &mut [[f64; D]; D]) -> Option<()> {
    match contour {
        Contour::Flat { .. } => return None,
        Contour::Ball { radius, .. } | Contour::Line { radius, .. } => add(bend, *radius, across),
        Contour::Rim { axis, radius, .. } => {
            let out = axpy(n, -dot(n, axis), axis);
            let length = norm(&out);
            if length < SAME {
                return None;
            }
            let mut along: [[f64; D]; D] = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
            take(&mut along, 1.0, axis);
            take(&mut along, 1.0, &out.map(|x| x / length));
            add(bend, radius / length, &along);
        }
    }
    Some(())
}

/// a ← a + s b.
fn add<const D: usize>(a: &mut [[f64; D]; D], s: f64, b: &[[f64; D]; D]) {
    (0..D).for_each(|i| (0..D).for_each(|j| a[i][j] += s * b[i][j]));
}

/// a ← a − s v vᵀ.
fn take<const D: usize>(a: &mut [[f64; D]; D], s: f64, v: &[f64; D]) {
    (0..D).for_each(|i| (0..D).for_each(|j| a[i][j] -= s * v[i] * v[j]));
}
