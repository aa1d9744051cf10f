//! Pictures of space show what is there, where it is.

use moreau_view::picture::{Body, Camera, Error, Image, Mesh, Picture, Segment, Shape};

const RED: [u8; 3] = [220, 30, 30];
const BLUE: [u8; 3] = [30, 60, 220];

fn ball(position: [f64; 3], radius: f64, colour: [u8; 3]) -> Body {
    Body { position, colour, ..Body::new(Shape::Ball { radius }) }
}

/// Seen along y, one unit of length in ten pixels.
fn ahead(bodies: Vec<Body>) -> Picture {
    let camera = Camera { direction: Some([0.0, 1.0, 0.0]), target: Some([0.0; 3]), width: Some(16.0) };
    Picture { bodies, camera, size: [160, 120], ..Picture::default() }
}

fn at(image: &Image, x: usize, y: usize) -> [u8; 4] {
    image.pixels[y * image.size[0] + x]
}

fn is_white(pixel: [u8; 4]) -> bool {
    pixel == [255; 4]
}

fn is_red(pixel: [u8; 4]) -> bool {
    pixel[0] > pixel[2].saturating_add(40)
}

fn is_blue(pixel: [u8; 4]) -> bool {
    pixel[2] > pixel[0].saturating_add(40)
}

#[test]
fn a_ball_is_as_large_as_its_projection() {
    let image = ahead(vec![ball([0.0; 3], 4.0, RED)]).draw().unwrap();
    for y in 0..120 {
        for x in 0..160 {
            let distance = (x as f64 + 0.5 - 80.0).hypot(y as f64 + 0.5 - 60.0);
            let white = is_white(at(&image, x, y));
            assert!(if distance > 41.5 { white } else { distance > 39.0 || !white }, "({x}, {y})");
        }
    }
}

#[test]
fn what_is_nearer_hides_what_is_behind_in_either_order() {
    let (near, far) = (ball([0.0, -3.0, 0.0], 2.0, RED), ball([0.0, 3.0, 0.0], 4.0, BLUE));
    for bodies in [vec![near, far], vec![far, near]] {
        let image = ahead(bodies).draw().unwrap();
        assert!(is_red(at(&image, 80, 60)));
        assert!(is_blue(at(&image, 80 + 30, 60)));
    }
}

#[test]
fn up_is_up_and_right_is_right() {
    let image = ahead(vec![ball([4.0, 0.0, 0.0], 2.0, RED), ball([0.0, 0.0, 4.0], 2.0, BLUE)]).draw().unwrap();
    assert!(is_red(at(&image, 120, 60)));
    assert!(is_blue(at(&image, 80, 20)));
}

/// A cube with edges of 2; the faces are turned inside out if asked for.
fn cube(inside_out: bool) -> Mesh {
    let vertices = (0..8).map(|i| [0, 1, 2].map(|k| if i >> k & 1 == 1 { 1.0 } else { -1.0 })).collect();
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let turn = |f: [usize; 4]| if inside_out { f.into_iter().rev().collect() } else { f.to_vec() };
    Mesh { vertices, polygons: faces.map(turn).into() }
}

#[test]
fn a_cube_is_seen_from_outside_only() {
    let cube_before_ball = |inside_out: bool| {
        let body = Body { position: [0.0, -5.0, 0.0], colour: RED, ..Body::new(Shape::Mesh(0)) };
        let picture = ahead(vec![body, ball([0.0, -5.0, 0.0], 0.5, BLUE)]);
        Picture { meshes: vec![cube(inside_out)], ..picture }.draw().unwrap()
    };
    let outside = cube_before_ball(false);
    assert!(is_red(at(&outside, 80, 60)) && is_red(at(&outside, 71, 51)) && is_red(at(&outside, 88, 68)));
    assert!(is_white(at(&outside, 68, 60)) && is_white(at(&outside, 92, 60)));
    // Without its front the far side is seen, and the ball before it.
    let inside = cube_before_ball(true);
    assert!(is_blue(at(&inside, 80, 60)) && is_red(at(&inside, 72, 52)));
}

#[test]
fn a_turned_cube_is_wider() {
    let half = std::f64::consts::FRAC_PI_8;
    let rotation = [0.0, 0.0, half.sin(), half.cos()];
    let picture = ahead(vec![Body { rotation, colour: RED, ..Body::new(Shape::Mesh(0)) }]);
    let image = Picture { meshes: vec![cube(false)], ..picture }.draw().unwrap();
    // Half the diagonal is 1.41.
    assert!(is_red(at(&image, 80 + 12, 60)) && is_white(at(&image, 80 + 16, 60)));
}

#[test]
fn chains_show_through_translucent_bodies_and_not_through_opaque_ones() {
    let chain = Segment { from: [-6.0, 0.0, 0.0], to: [6.0, 0.0, 0.0], radius: 0.5, colour: RED };
    for (opacity, seen) in [(1.0, false), (0.2, true)] {
        let picture = ahead(vec![Body { opacity, ..ball([0.0; 3], 4.0, [200, 200, 200]) }]);
        let image = Picture { chains: vec![chain], ..picture }.draw().unwrap();
        assert_eq!(is_red(at(&image, 80, 60)), seen);
        assert!(is_red(at(&image, 80 + 50, 60)));
        assert!(is_white(at(&image, 80 + 70, 60)));
    }
}

#[test]
fn a_floor_lies_below_and_takes_a_shadow() {
    let floor = Body::new(Shape::Plane { normal: [0.0, 0.0, 1.0] });
    let light = |bodies| {
        let camera = Camera { direction: Some([0.0, 1.0, -1.0]), target: Some([0.0; 3]), width: Some(16.0) };
        let image = Picture { camera, ..ahead(bodies) }.draw().unwrap();
        image.pixels.iter().map(|p| p[1]).min().unwrap()
    };
    let up = |z| Body { opacity: 1.0, ..ball([0.0, 0.0, z], 1.0, [255; 3]) };
    assert!(light(vec![floor, up(1.0)]) < 190);
    // From below nothing of a floor is seen.
    let camera = Camera { direction: Some([0.0, 0.0, 1.0]), target: Some([0.0; 3]), width: Some(16.0) };
    let image = Picture { camera, ..ahead(vec![floor]) }.draw().unwrap();
    assert!(image.pixels.iter().all(|&p| is_white(p)));
}

#[test]
fn a_fitted_camera_shows_all_and_stays_when_it_is_kept() {
    let bodies = vec![ball([100.0, 0.0, 0.0], 1.0, RED), ball([104.0, 50.0, 2.0], 2.0, BLUE)];
    let picture = Picture { bodies, size: [120, 160], ..Picture::default() };
    let image = picture.draw().unwrap();
    let rim = (0..160).flat_map(|y| [(0, y), (119, y)]).chain((0..120).flat_map(|x| [(x, 0), (x, 159)]));
    assert!(rim.into_iter().all(|(x, y)| is_white(at(&image, x, y))));
    assert!(image.pixels.iter().any(|&p| is_red(p)) && image.pixels.iter().any(|&p| is_blue(p)));
    let camera = picture.fitted_camera().unwrap();
    assert_eq!(Picture { camera, ..picture }.draw().unwrap(), image);
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let bodies = (0..60).map(|i| {
        let [x, y, z] = [i % 5, i / 5 % 4, i / 20].map(f64::from);
        Body { opacity: if i % 7 == 0 { 0.5 } else { 1.0 }, ..ball([x, y, z], 0.55, RED) }
    });
    let floor = Body::new(Shape::Plane { normal: [0.0, 0.0, 1.0] });
    let chains = vec![Segment { from: [0.0; 3], to: [4.0, 3.0, 2.0], radius: 0.1, colour: BLUE }];
    let picture = Picture { bodies: bodies.chain([floor]).collect(), chains, size: [90, 70], ..Picture::default() };
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| picture.draw().unwrap().png())
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn what_cannot_be_drawn_is_said_and_what_is_absent_is_left_out() {
    let picture = ahead(vec![ball([f64::NAN; 3], 1.0, RED), ball([0.0; 3], 1.0, BLUE)]);
    assert!(is_blue(at(&picture.draw().unwrap(), 80, 60)));
    assert!(matches!(Picture { size: [0, 5], ..picture.clone() }.draw(), Err(Error::Size(_))));
    let meshless = Picture { bodies: vec![Body::new(Shape::Mesh(2))], ..picture.clone() };
    assert!(matches!(meshless.draw(), Err(Error::NoMesh { body: 0, mesh: 2, meshes: 0 })));
    let mesh = Mesh { vertices: vec![[0.0; 3]], polygons: vec![vec![0, 0, 3]] };
    assert!(matches!(Picture { meshes: vec![mesh], ..picture.clone() }.draw(), Err(Error::NoVertex { vertex: 3, .. })));
    assert!(matches!(Picture { up: [0.0; 3], ..picture }.draw(), Err(Error::Camera("up"))));
}

#[test]
fn degenerate_scenes_are_drawn() {
    assert!(Picture { size: [8, 8], ..Picture::default() }.draw().unwrap().pixels.iter().all(|&p| is_white(p)));
    let flat = Mesh { vertices: vec![[0.0; 3]; 3], polygons: vec![vec![0, 1, 2], vec![0], vec![]] };
    let bodies = vec![Body::new(Shape::Mesh(0)), ball([0.0; 3], 0.0, RED)];
    let dot = Segment { from: [0.0; 3], to: [0.0; 3], radius: 0.1, colour: RED };
    Picture { bodies, meshes: vec![flat], chains: vec![dot], size: [8, 8], ..Picture::default() }.draw().unwrap();
    let down = Camera { direction: Some([0.0, 0.0, -1.0]), ..Camera::default() };
    let image =
        Picture { camera: down, bodies: vec![ball([5.0; 3], 1.0, RED)], size: [9, 9], ..Picture::default() }.draw().unwrap();
    assert!(is_red(at(&image, 4, 4)));
    let clear = Picture { background: [0; 4], bodies: vec![ball([0.0; 3], 1.0, RED)], size: [64, 64], ..Picture::default() };
    let image = clear.draw().unwrap();
    assert_eq!(at(&image, 0, 0)[3], 0);
    assert_eq!(at(&image, 32, 32)[3], 255);
}
