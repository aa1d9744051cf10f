//! Draws a few pictures into a folder: `cargo run --release -p moreau-view --example gallery -- out`.

use moreau_view::picture::flat::{Drawing, Figure, Link, Outline};
use moreau_view::picture::movie::Movie;
use moreau_view::picture::{Body, Camera, Mesh, Picture, Segment, Shape, colour};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "gallery".into()));
    std::fs::create_dir_all(&folder)?;
    let pictures = [("heap", heap(500)), ("chains", chains()), ("cubes", cubes()), ("arch", arch()), ("many", heap(20_000))];
    for (name, picture) in pictures {
        let start = Instant::now();
        let image = picture.draw()?;
        println!("{name}: {} bodies drawn in {:.3} s", picture.bodies.len(), start.elapsed().as_secs_f64());
        image.save(folder.join(name).with_extension("png"))?;
    }
    for ending in ["svg", "pdf", "png"] {
        packing().save(folder.join("packing").with_extension(ending))?;
    }
    movie(&folder.join("turn.gif"))?;
    // Not everyone has ffmpeg; the error says what to do about it.
    if let Err(error) = movie(&folder.join("turn.mp4")) {
        println!("{error}");
    }
    Ok(())
}

/// A walk around the cubes.
fn movie(path: &Path) -> Result<(), moreau_view::picture::Error> {
    let picture = Picture { size: [480, 360], ..cubes() };
    let width = picture.fitted_camera()?.width;
    let mut movie = Movie::open(path, picture.size, 25.0)?;
    for i in 0..75 {
        let angle = f64::from(i) / 75.0 * std::f64::consts::TAU;
        let camera = Camera { direction: Some([-angle.sin(), angle.cos(), -0.5]), target: Some([0.0, 0.0, 2.3]), width };
        movie.add(&Picture { camera, ..picture.clone() }.draw()?)?;
    }
    movie.finish()
}

/// Disks in a box, pushed apart, with lines where they press on each other.
fn packing() -> Drawing {
    let mut dice = Dice(11);
    let mut disks: Vec<([f64; 3], f64)> =
        (0..260).map(|_| ([1.0 + 22.0 * dice.roll(), 0.0, 1.0 + 16.0 * dice.roll()], 0.45 + 0.5 * dice.roll())).collect();
    for _ in 0..600 {
        push_apart(&mut disks);
        for (p, r) in &mut disks {
            *p = [p[0].clamp(*r, 24.0 - *r), 0.0, (p[2] - 0.01).max(*r)];
        }
    }
    let flat = |p: [f64; 3]| [p[0], p[2]];
    let wall = |normal, position| Figure { position, ..Figure::new(Outline::HalfPlane { normal }) };
    let walls = [wall([0.0, 1.0], [0.0; 2]), wall([1.0, 0.0], [0.0; 2]), wall([-1.0, 0.0], [24.0, 0.0])];
    let disk = |&(p, radius): &([f64; 3], f64)| Figure { position: flat(p), ..Figure::new(Outline::Disk { radius }) };
    let mut drawing = Drawing {
        title: "Forces between disks in a box".into(),
        figures: walls.into_iter().chain(disks.iter().map(disk)).collect(),
        ..Drawing::default()
    };
    for (i, (p, r)) in disks.iter().enumerate() {
        for (q, s) in &disks[..i] {
            let force = (r + s + 0.002 - (p[0] - q[0]).hypot(p[2] - q[2])) * 9.0;
            if force > 0.0 {
                let colour = colour::category(usize::from(dice.roll() < 0.2));
                drawing.links.push(Link { from: flat(*p), to: flat(*q), width: 0.05 + 0.4 * force.min(1.0), colour });
            }
        }
    }
    drawing
}

/// Numbers from 0 to 1 that look random.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn ground() -> Body {
    Body::new(Shape::Plane { normal: [0.0, 0.0, 1.0] })
}

/// Balls in a cone, pushed apart until they hardly overlap, by height.
fn heap(count: usize) -> Picture {
    let mut dice = Dice(7);
    let size = (count as f64).cbrt();
    let mut balls: Vec<([f64; 3], f64)> = (0..count)
        .map(|_| {
            let (turn, far, height) = (dice.roll() * std::f64::consts::TAU, dice.roll().sqrt(), dice.roll());
            let reach = 1.6 * size * far * (1.0 - 0.75 * height);
            ([reach * turn.cos(), reach * turn.sin(), 1.2 * size * height], 0.65 + 0.45 * dice.roll())
        })
        .collect();
    for _ in 0..60 {
        for (p, r) in &mut balls {
            p[2] = (p[2] - 0.05).max(*r);
        }
        push_apart(&mut balls);
    }
    let top = balls.iter().map(|(p, _)| p[2]).fold(0.0, f64::max);
    let ball = |&(position, radius): &([f64; 3], f64)| Body {
        position,
        colour: colour::sequential(0.15 + 0.8 * position[2] / top),
        ..Body::new(Shape::Ball { radius })
    };
    Picture { bodies: std::iter::once(ground()).chain(balls.iter().map(ball)).collect(), ..Picture::default() }
}

fn push_apart(balls: &mut [([f64; 3], f64)]) {
    let mut cells = std::collections::HashMap::<[i64; 3], Vec<usize>>::new();
    let cell = |p: [f64; 3]| p.map(|x| (x / 2.2).floor() as i64);
    balls.iter().enumerate().for_each(|(i, (p, _))| cells.entry(cell(*p)).or_default().push(i));
    for i in 0..balls.len() {
        let [x, y, z] = cell(balls[i].0);
        for n in 0..27 {
            let near = [x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1];
            for &j in cells.get(&near).map_or(&[][..], |c| c).iter().filter(|&&j| j < i) {
                let d: [f64; 3] = std::array::from_fn(|k| balls[i].0[k] - balls[j].0[k]);
                let length = d.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-9);
                let overlap = balls[i].1 + balls[j].1 - length;
                if overlap > 0.0 {
                    for k in 0..3 {
                        balls[i].0[k] += 0.5 * overlap * d[k] / length;
                        balls[j].0[k] -= 0.5 * overlap * d[k] / length;
                    }
                }
            }
        }
    }
    for (p, r) in balls {
        p[2] = p[2].max(*r);
    }
}

/// A heap that lets one see through to the forces between its balls.
fn chains() -> Picture {
    let mut picture = heap(500);
    let balls: Vec<([f64; 3], f64)> = picture
        .bodies
        .iter()
        .filter_map(|b| if let Shape::Ball { radius } = b.shape { Some((b.position, radius)) } else { None })
        .collect();
    for (i, (p, r)) in balls.iter().enumerate() {
        for (q, s) in &balls[..i] {
            let d: f64 = p.iter().zip(q).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt();
            let force = ((r + s - d) * 4.0 + 0.2 - 0.02 * p[2]).clamp(0.0, 1.0) * (p[2] - q[2]).abs() / d;
            if d < r + s + 0.02 && force > 0.02 {
                let radius = 0.04 + 0.25 * force;
                let colour = colour::mix([120, 140, 170], [213, 70, 0], 1.4 * force);
                picture.chains.push(Segment { from: *p, to: *q, radius, colour });
            }
        }
    }
    for body in picture.bodies.iter_mut().skip(1) {
        body.opacity = 0.25;
        body.colour = [150, 165, 185];
    }
    picture
}

/// A block from the middle of its eight corners, the lower four first and counter-clockwise from above.
fn block(vertices: [[f64; 3]; 8]) -> Mesh {
    let faces = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
    Mesh { vertices: vertices.into(), polygons: faces.map(Vec::from).into() }
}

fn cubes() -> Picture {
    let corner = |i: usize| [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]][i % 4];
    let cube = block(std::array::from_fn(|i| [corner(i)[0], corner(i)[1], if i < 4 { -0.5 } else { 0.5 }]));
    let mut dice = Dice(3);
    let mut bodies = vec![ground()];
    for level in 0..5 {
        let side = 6 - level;
        for i in 0..side * side {
            let place = |k: i32| 1.12 * (f64::from(k) - 0.5 * f64::from(side - 1)) + 0.1 * (dice.roll() - 0.5);
            let [x, y] = [i % side, i / side].map(place);
            let half = 0.25 * (dice.roll() - 0.5);
            bodies.push(Body {
                position: [x, y, 0.5 + f64::from(level)],
                rotation: [0.0, 0.0, half.sin(), half.cos()],
                colour: colour::category((dice.roll() * 6.0) as usize),
                ..Body::new(Shape::Mesh(0))
            });
        }
    }
    Picture { bodies, meshes: vec![cube], ..Picture::default() }
}

fn arch() -> Picture {
    let stones = 17;
    let angle = |i: usize| std::f64::consts::PI * i as f64 / stones as f64;
    let meshes = (0..stones).map(|i| {
        let at = |r: f64, a: f64, y: f64| [-r * a.cos(), y, r * a.sin()];
        let (a, b) = (angle(i) + 0.004, angle(i + 1) - 0.004);
        block([
            at(1.0, b, -0.25),
            at(1.0, b, 0.25),
            at(1.0, a, 0.25),
            at(1.0, a, -0.25),
            at(1.2, b, -0.25),
            at(1.2, b, 0.25),
            at(1.2, a, 0.25),
            at(1.2, a, -0.25),
        ])
    });
    let meshes: Vec<Mesh> = meshes.collect();
    let mut dice = Dice(5);
    let stone =
        |i: usize| Body { colour: colour::mix([196, 172, 140], [226, 210, 186], dice.roll()), ..Body::new(Shape::Mesh(i)) };
    let bodies = std::iter::once(ground()).chain((0..stones).map(stone)).collect();
    Picture { bodies, meshes, ..Picture::default() }
}
