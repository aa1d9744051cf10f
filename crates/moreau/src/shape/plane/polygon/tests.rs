use super::*;

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

fn refusal(vertices: &[[f64; 2]]) -> ShapeError {
    Polygon::new(vertices.to_vec()).unwrap_err()
}

#[test]
fn the_unit_square_has_a_moment_of_a_sixth() {
    let (square, centre) = Polygon::new(SQUARE.to_vec()).unwrap();
    assert_eq!(centre, [0.5, 0.5]);
    assert_eq!(square.vertices().collect::<Vec<_>>(), [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]);
    assert_eq!(square.sides()[1].normal, [1.0, 0.0]);
    let [m, _, j] = square.mass(6.0);
    assert!((m - 6.0).abs() < 1e-15 && (j - 1.0).abs() < 1e-15);
    assert!((square.bounding_radius().unwrap() - 0.5_f64.sqrt()).abs() < 1e-15);
}

#[test]
fn a_far_clockwise_rectangle_is_turned_and_loses_no_accuracy() {
    let rectangle = [[1e6, 1e6], [1e6, 1e6 + 3.0], [1e6 + 2.0, 1e6 + 3.0], [1e6 + 2.0, 1e6]];
    let (polygon, centre) = Polygon::new(rectangle.to_vec()).unwrap();
    assert_eq!(centre, [1e6 + 1.0, 1e6 + 1.5]);
    assert_eq!(polygon.vertices().collect::<Vec<_>>(), [[-1.0, -1.5], [1.0, -1.5], [1.0, 1.5], [-1.0, 1.5]]);
    assert!((polygon.area() - 6.0).abs() < 1e-14 && (polygon.second_moment() - 6.0 * 13.0 / 12.0).abs() < 1e-13);
}

#[test]
fn the_moment_of_a_triangle_is_a_thirty_sixth_of_its_squared_sides() {
    // J = A (a² + b² + c²) / 36 for sides 3, 4, 5.
    let (triangle, centre) = Polygon::new(vec![[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]]).unwrap();
    assert!((centre[0] - 1.0).abs() < 1e-15 && (centre[1] - 4.0 / 3.0).abs() < 1e-15);
    assert!((triangle.second_moment() - 6.0 * 50.0 / 36.0).abs() < 1e-14);
}

#[test]
fn a_vertex_within_a_side_changes_nothing_but_the_count() {
    let (polygon, _) = Polygon::new(vec![[0.0, 0.0], [0.5, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]).unwrap();
    assert_eq!(polygon.sides().len(), 5);
    assert!((polygon.area() - 1.0).abs() < 1e-15 && (polygon.second_moment() - 1.0 / 6.0).abs() < 1e-15);
}

#[test]
fn points_that_make_no_polygon_are_refused() {
    assert_eq!(refusal(&SQUARE[..2]), ShapeError::TooFewVertices { count: 2 });
    let mut vertices = SQUARE;
    vertices[2][1] = f64::NAN;
    assert!(matches!(refusal(&vertices), ShapeError::NotFinite { vertex: 2, .. }));
    vertices[2][1] = f64::INFINITY;
    assert!(matches!(refusal(&vertices), ShapeError::NotFinite { vertex: 2, .. }));
    let closed = [SQUARE[0], SQUARE[1], SQUARE[2], SQUARE[0]];
    assert_eq!(refusal(&closed), ShapeError::RepeatedVertex { first: 0, second: 3 });
    let line = [[0.0, 0.0], [1.0, 1.0], [3.0, 3.0], [2.0, 2.0]];
    assert_eq!(refusal(&line), ShapeError::NoArea { vertex: 2 });
    assert_eq!(refusal(&SQUARE.map(|v| v.map(|x| x * 1e-100))), ShapeError::NoArea { vertex: 2 });
}

#[test]
fn orders_that_are_not_convex_are_refused() {
    let bow_tie = [SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3]];
    assert_eq!(refusal(&bow_tie), ShapeError::SelfIntersecting { first: 0, second: 2 });
    let pentagram = [[0.0, 1.0], [0.6, -0.8], [-1.0, 0.3], [1.0, 0.3], [-0.6, -0.8]];
    assert!(matches!(refusal(&pentagram), ShapeError::SelfIntersecting { .. }));
    let notch = [[0.0, 0.0], [1.0, 0.0], [0.3, 0.3], [0.0, 1.0]];
    assert_eq!(refusal(&notch), ShapeError::NotConvex { vertex: 2 });
    let mut reversed = notch;
    reversed.reverse();
    assert_eq!(refusal(&reversed), ShapeError::NotConvex { vertex: 1 });
    let spike = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    assert!(Polygon::new(spike.to_vec()).is_err());
}

#[test]
fn errors_say_where_and_what_would_be_right() {
    let text = refusal(&[[0.0, 0.0], [1.0, 0.0], [0.3, 0.3], [0.0, 1.0]]).to_string();
    assert!(text.contains("vertex 2") && text.contains("convex"), "{text}");
}
