//! Concave polygons as compounds of convex ones.
//!
//! A simple polygon is cut into triangles, an ear at a time: a corner whose triangle holds no other vertex (Meisters, Polygons have
//! ears, Am. Math. Mon. 82, 1975). Then each cut is taken back across which two pieces make a convex one (Hertel & Mehlhorn, Fast
//! triangulation of simple polygons, FCT 1983): at most four times as many pieces are left as are needed. The pieces have the area of
//! the polygon and share its vertices.

use super::boundary::{check_points, check_simple, cross, signed_area, sub, turn};
use super::{Compound, PlaneShape, Polygon};
use crate::shape::ShapeError;
use crate::space::{Plane, Pose, Space};

type Point = [f64; 2];

/// The simple polygon with these vertices (m), in order around it either way, and its centre of mass in the same coordinates: a
/// [`Polygon`] if it is convex, else a [`Compound`].
pub fn decompose(vertices: Vec<Point>) -> Result<(PlaneShape, Point), ShapeError> {
    check_points(&vertices)?;
    check_simple(&vertices)?;
    let pieces = convex_pieces(&vertices)?;
    if pieces.len() == 1 {
        return Polygon::new(vertices).map(|(polygon, centre)| (polygon.into(), centre));
    }
    let mut parts = Vec::with_capacity(pieces.len());
    for piece in pieces {
        match Polygon::new(piece.iter().map(|&i| vertices[i]).collect()) {
            Ok((polygon, position)) => parts.push((polygon.into(), Pose { position, rotation: Plane::IDENTITY })),
            // A sliver: its area is a rounding error of the others'.
            Err(ShapeError::NoArea { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    Compound::new(parts).map(|(compound, centre)| (compound.into(), centre))
}

/// Convex pieces, each by the numbers of its vertices, counter-clockwise.
fn convex_pieces(vertices: &[Point]) -> Result<Vec<Vec<usize>>, ShapeError> {
    let count = vertices.len();
    let mut ring = Vec::with_capacity(count);
    for vertex in 0..count {
        match turn([vertices[(vertex + count - 1) % count], vertices[vertex], vertices[(vertex + 1) % count]]) {
            (0.0, false) => return Err(ShapeError::TurnsBack { vertex }),
            // Within a straight side: no corner of any piece.
            (0.0, true) => {}
            _ => ring.push(vertex),
        }
    }
    if signed_area(vertices) < 0.0 {
        ring.reverse();
    }
    let Cut { mut pieces, cuts } = cut_ears(vertices, ring)?;
    for cut in cuts {
        merge(vertices, &mut pieces, cut);
    }
    Ok(pieces)
}

/// Pieces, each by the numbers of its vertices, and the two ends of each cut between them.
#[derive(Default)]
struct Cut {
    pieces: Vec<Vec<usize>>,
    cuts: Vec<[usize; 2]>,
}

/// Triangles, and the cuts between them.
fn cut_ears(vertices: &[Point], mut ring: Vec<usize>) -> Result<Cut, ShapeError> {
    let Cut { pieces: mut triangles, mut cuts } = Cut::default();
    let mut from = 0;
    while ring.len() > 3 {
        let count = ring.len();
        let corner = |k: usize| [ring[(k + count - 1) % count], ring[k], ring[(k + 1) % count]];
        // Ears are looked for from where the last one was, every second corner, so that they do not become a fan of slivers.
        let ear = (0..count).map(|k| (from + k) % count).find(|&k| is_ear(vertices, &ring, corner(k)));
        let Some(ear) = ear else { return Err(ShapeError::NotCut { vertex: ring[0] }) };
        let [before, at, after] = corner(ear);
        triangles.push(vec![before, at, after]);
        cuts.push([before, after]);
        ring.remove(ear);
        from = (ear + 1) % ring.len();
    }
    triangles.push(ring);
    Ok(Cut { pieces: triangles, cuts })
}

/// Whether the corner is one of the solid and its triangle holds no other vertex, neither inside nor on its sides.
fn is_ear(vertices: &[Point], ring: &[usize], corner: [usize; 3]) -> bool {
    let [p, q, r] = corner.map(|i| vertices[i]);
    let left = |from: Point, to: Point, at: Point| cross(sub(to, from), sub(at, from)) >= 0.0;
    let inside = |at: Point| left(p, q, at) && left(q, r, at) && left(r, p, at);
    turn([p, q, r]).0 > 0.0 && !ring.iter().any(|i| !corner.contains(i) && inside(vertices[*i]))
}

/// Takes a cut back if the two pieces beside it make a convex one.
fn merge(vertices: &[Point], pieces: &mut Vec<Vec<usize>>, [a, b]: [usize; 2]) {
    // The piece that goes from one end of the cut to the other, and where it leaves.
    let along = |pieces: &[Vec<usize>], from: usize, to: usize| {
        pieces.iter().enumerate().find_map(|(number, piece)| {
            let at = (0..piece.len()).find(|&k| piece[k] == from && piece[(k + 1) % piece.len()] == to);
            at.map(|at| (number, at))
        })
    };
    let (Some((first, at_a)), Some((second, at_b))) = (along(pieces, a, b), along(pieces, b, a)) else { return };
    // From the end of the cut around each piece to its beginning.
    let around =
        |piece: &[usize], at: usize| -> Vec<usize> { (1..=piece.len()).map(|k| piece[(at + k) % piece.len()]).collect() };
    let (mut whole, other) = (around(&pieces[first], at_a), around(&pieces[second], at_b));
    let joint = whole.len() - 1;
    whole.extend(&other[1..other.len() - 1]);
    let count = whole.len();
    let convex = |k: usize| {
        let (sine, on) = turn([whole[(k + count - 1) % count], whole[k], whole[(k + 1) % count]].map(|i| vertices[i]));
        sine > 0.0 || (sine == 0.0 && on)
    };
    if convex(0) && convex(joint) {
        pieces[first] = whole;
        pieces.remove(second);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Figure, Shape};

    /// A simple star of `n` corners with radii drawn from a seed; concave almost everywhere.
    fn star(n: usize, seed: u64) -> Vec<Point> {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
        (0..n).map(|i| (angle(i), 0.3 + next())).map(|(a, r)| [3.0 + r * a.cos(), r * a.sin() - 2.0]).collect()
    }

    /// Area, centre and ∫ |x − centre|² dA by Green's theorem.
    fn moments(vertices: &[Point]) -> (f64, Point, f64) {
        let mut sums = [0.0; 4];
        for (i, p) in vertices.iter().enumerate() {
            let q = vertices[(i + 1) % vertices.len()];
            let c = p[0] * q[1] - p[1] * q[0];
            let square: f64 = (0..2).map(|k| p[k] * p[k] + p[k] * q[k] + q[k] * q[k]).sum();
            for (sum, term) in sums.iter_mut().zip([c / 2.0, c * (p[0] + q[0]) / 6.0, c * (p[1] + q[1]) / 6.0, c * square / 12.0])
            {
                *sum += term;
            }
        }
        let centre = [sums[1] / sums[0], sums[2] / sums[0]];
        (sums[0], centre, sums[3] - sums[0] * (centre[0] * centre[0] + centre[1] * centre[1]))
    }

    #[test]
    fn pieces_have_the_mass_of_the_polygon() {
        for (n, seed) in (4..60).zip(1..) {
            let mut vertices = star(n, seed);
            if seed % 2 == 0 {
                vertices.reverse();
            }
            let (shape, centre) = decompose(vertices.clone()).unwrap();
            let (area, right, moment) = moments(&vertices);
            let [m, _, j] = shape.mass(1.0);
            let close = |a: f64, b: f64| (a - b).abs() < 1e-12;
            assert!(close(m, area.abs()) && close(centre[0], right[0]) && close(centre[1], right[1]), "{n}: {m} {area}");
            assert!((j - moment.abs()).abs() < 1e-11, "{n}: {j} {moment}");
        }
    }

    #[test]
    fn a_point_is_in_the_polygon_where_it_is_in_one_piece() {
        let vertices = star(40, 7);
        let (PlaneShape::Compound(compound), centre) = decompose(vertices.clone()).unwrap() else { panic!("it is concave") };
        assert!(compound.parts().len() < 38, "triangles are merged");
        let mut inside = 0;
        for i in 0..4000 {
            let p = [1.6 + 0.045 * f64::from(i % 63), -3.4 + 0.045 * f64::from(i / 63)];
            // Crossings of the ray to the right.
            let crossings = (0..40).filter(|&i| {
                let (a, b) = (vertices[i], vertices[(i + 1) % 40]);
                (a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
            });
            let pieces = compound.parts().iter().filter(|part| {
                let PlaneShape::Polygon(polygon) = &part.shape else { return false };
                let at = [0, 1].map(|k| p[k] - centre[k] - part.pose.position[k]);
                polygon.sides().iter().all(|side| (0..2).map(|k| side.normal[k] * (at[k] - side.start[k])).sum::<f64>() < 0.0)
            });
            let odd = crossings.count() % 2;
            inside += odd;
            assert_eq!(pieces.count(), odd, "{p:?}");
        }
        assert!(inside > 500);
    }

    #[test]
    fn an_l_is_two_pieces_and_a_convex_polygon_one() {
        let l = vec![[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        let (PlaneShape::Compound(compound), _) = decompose(l).unwrap() else { panic!("it is concave") };
        assert_eq!(compound.parts().len(), 2);
        // A vertex within a side stays as it is.
        let (shape, _) = decompose(vec![[0.0, 0.0], [0.5, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]).unwrap();
        assert!(shape.name() == "polygon" && (shape.mass(1.0)[0] - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_cross_whose_cuts_pass_through_vertices_is_cut() {
        // Corners of the notches lie on lines through others.
        let cross = [[1, 0], [2, 0], [2, 1], [3, 1], [3, 2], [2, 2], [2, 3], [1, 3], [1, 2], [0, 2], [0, 1], [1, 1]];
        let (shape, centre) = decompose(cross.map(|p| p.map(f64::from)).to_vec()).unwrap();
        assert!((shape.mass(1.0)[0] - 5.0).abs() < 1e-14 && (0..2).all(|k| (centre[k] - 1.5).abs() < 1e-14));
        let PlaneShape::Compound(compound) = shape else { panic!("it is concave") };
        assert!(compound.parts().len() <= 6 && Figure::bounding_radius(&compound).is_some());
    }

    #[test]
    fn what_is_no_polygon_is_refused() {
        let bow_tie = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(matches!(decompose(bow_tie), Err(ShapeError::SelfIntersecting { .. })));
        let spike = vec![[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert!(decompose(spike).is_err());
    }
}
