use super::*;

/// A generator of numbers in [0, 1) that needs nothing else.
pub(in crate::detect) struct Dice(pub(in crate::detect) u64);

impl Dice {
    pub(in crate::detect) fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn grid_pairs<const D: usize>(grid: &mut Grid<D>, spheres: &[Sphere<D>]) -> Vec<(u32, u32)> {
    let mut pairs = Vec::new();
    grid.pairs(spheres, |_, _| true, &mut |a, b| pairs.push((a.min(b), a.max(b))));
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

fn all_pairs<const D: usize>(spheres: &[Sphere<D>]) -> Vec<(u32, u32)> {
    let mut pairs = Vec::new();
    for (i, a) in spheres.iter().enumerate() {
        for b in &spheres[i + 1..] {
            let square: f64 = (0..D).map(|k| (a.centre[k] - b.centre[k]) * (a.centre[k] - b.centre[k])).sum();
            if square <= (a.radius + b.radius) * (a.radius + b.radius) {
                pairs.push((a.body, b.body));
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Balls in the unit cube, most of them small, radius ratio `ratio`.
fn scene<const D: usize>(count: u32, largest: f64, ratio: f64, dice: &mut Dice) -> Vec<Sphere<D>> {
    let sphere = |body| {
        let radius = largest / (1.0 + (ratio - 1.0) * dice.roll());
        Sphere { centre: std::array::from_fn(|_| dice.roll() - 0.5), radius, body }
    };
    (0..count).map(sphere).collect()
}

fn agrees<const D: usize>(largest: f64) {
    let mut grid = Grid::default();
    for (seed, ratio) in [1.0, 1.9, 2.1, 10.0, 100.0].into_iter().enumerate() {
        let spheres = scene::<D>(1000, largest, ratio, &mut Dice(seed as u64));
        let expected = all_pairs(&spheres);
        assert!(expected.len() > 10, "{}", expected.len());
        assert_eq!(grid_pairs(&mut grid, &spheres), expected, "ratio {ratio}");
    }
}

#[test]
fn the_grid_finds_what_all_against_all_finds_in_the_plane() {
    agrees::<2>(0.03);
}

#[test]
fn the_grid_finds_what_all_against_all_finds_in_space() {
    agrees::<3>(0.1);
}

#[test]
fn balls_of_a_lattice_that_just_touch_are_found() {
    let mut grid = Grid::<3>::default();
    let spheres: Vec<_> = (0..1000)
        .map(|body| Sphere { centre: [body / 100, body / 10 % 10, body % 10].map(|x| f64::from(x) - 5.0), radius: 0.5, body })
        .collect();
    assert_eq!(grid_pairs(&mut grid, &spheres).len(), 3 * 10 * 10 * 9);
}

#[test]
fn far_flat_and_extreme_scenes_lose_nothing() {
    let mut dice = Dice(7);
    let mut grid = Grid::<3>::default();
    for scale in [1e-100, 1.0, 1e100] {
        for offset in [0.0, 1e3, 1e9, 1e12] {
            let mut spheres = scene::<3>(200, 0.2, 100.0, &mut dice);
            for sphere in &mut spheres {
                sphere.centre = sphere.centre.map(|x| (x + offset) * scale);
                sphere.radius *= scale;
            }
            spheres[17].centre[1] = 1e300;
            spheres[18].centre[1] = -1e300;
            spheres[19].radius = 0.0;
            assert_eq!(grid_pairs(&mut grid, &spheres), all_pairs(&spheres), "scale {scale}, offset {offset}");
        }
    }
    // So small that squares vanish: anything may be found, but in good order.
    let mut tiny = scene::<3>(50, 0.2, 100.0, &mut dice);
    tiny.iter_mut()
        .for_each(|sphere| (sphere.centre, sphere.radius) = (sphere.centre.map(|x| x * 1e-310), sphere.radius * 1e-310));
    assert!(!grid_pairs(&mut grid, &tiny).is_empty());
    let points: Vec<_> = (0..5).map(|body| Sphere { centre: [0.0; 3], radius: 0.0, body }).collect();
    assert_eq!(grid_pairs(&mut grid, &points).len(), 10);
    assert!(grid_pairs(&mut grid, &[]).is_empty());
}

#[test]
fn work_is_linear_whatever_flies_off() {
    // Counts of what the grid hands over, repetitions and all: a table full of collisions would show.
    let mut grid = Grid::<3>::default();
    let mut spheres = scene::<3>(4000, 0.04, 1.0, &mut Dice(3));
    for far in 0..4 {
        spheres[far].centre = [1e12 * (far + 1) as f64, -1e12, 1e12];
    }
    let mut handed = 0;
    grid.pairs(&spheres, |_, _| true, &mut |_, _| handed += 1);
    let exact = all_pairs(&spheres).len();
    assert!(handed >= exact && handed < exact + exact / 2, "{handed} for {exact}");
    assert!(grid.starts.len() <= 4 * spheres.len() + 1);
}
