use super::*;

fn refusal(points: &[[f64; 2]], closed: bool) -> ShapeError {
    Polyline::new(points, closed).unwrap_err()
}

#[test]
fn a_ground_from_left_to_right_looks_up_and_knows_its_bends() {
    let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 1.0], [4.0, 1.0]];
    let ground = Polyline::new(&points, false).unwrap();
    assert_eq!(ground.segments()[0].normal, [0.0, 1.0]);
    let bends: Vec<Bend> = ground.joints().iter().map(|joint| joint.bend).collect();
    assert_eq!(bends, [Bend::Ridge, Bend::Straight, Bend::Valley, Bend::Ridge, Bend::Ridge]);
    assert_eq!((ground.joints()[0].normals, ground.joints()[4].normals), ([[-1.0, 0.0], [0.0, 1.0]], [[0.0, 1.0], [1.0, 0.0]]));
    assert_eq!((ground.after(0), ground.after(3)), (1, 4));
    let vessel = Polyline::new(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], true).unwrap();
    assert!(vessel.joints().iter().all(|joint| joint.bend == Bend::Valley) && vessel.after(3) == 0);
}

#[test]
fn chains_that_cannot_be_are_refused() {
    assert_eq!(refusal(&[[0.0, 0.0]], false), ShapeError::TooFewPoints { what: "polyline", count: 1, least: 2 });
    assert_eq!(refusal(&[[0.0, 0.0], [1.0, 0.0]], true), ShapeError::TooFewPoints { what: "polyline", count: 2, least: 3 });
    assert!(matches!(refusal(&[[0.0, f64::NAN], [1.0, 0.0]], false), ShapeError::NotFinite { vertex: 0, .. }));
    let twice = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
    assert_eq!(refusal(&twice, false), ShapeError::RepeatedVertex { first: 1, second: 2 });
    let closed_twice = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]];
    assert_eq!(refusal(&closed_twice, true), ShapeError::RepeatedVertex { first: 3, second: 0 });
    assert_eq!(refusal(&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.0]], false), ShapeError::TurnsBack { vertex: 1 });
    let loops = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, -1.0]];
    assert_eq!(refusal(&loops, false), ShapeError::SelfIntersecting { first: 0, second: 2 });
}

#[test]
fn what_is_near_is_found_as_by_looking_at_all() {
    // A spiral: far along the chain can be near in the plane.
    let points: Vec<[f64; 2]> = (0..997)
        .map(|i| {
            let angle = 0.1 * f64::from(i);
            [angle * angle.cos(), angle * angle.sin()]
        })
        .collect();
    let spiral = Polyline::new(&points, false).unwrap();
    for i in 0..500 {
        let (x, y, size) = (f64::from(i * 37 % 200 - 100), f64::from(i * 91 % 200 - 100), f64::from(i % 7));
        let (low, high) = ([x, y], [x + size, y + size]);
        let (mut found, mut right) = (Vec::new(), Vec::new());
        spiral.near(low, high, |i| found.push(i));
        for (i, segment) in spiral.segments().iter().enumerate() {
            let (from, to) = bounds(segment);
            if (0..2).all(|k| from[k] <= high[k] && low[k] <= to[k]) {
                right.push(i);
            }
        }
        assert_eq!(found, right);
    }
}
