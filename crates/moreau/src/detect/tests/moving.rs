//! A detector that remembers, against one that is new at each call, over sequences of moves.

use super::*;
use proptest::prelude::*;

/// What happens before a call, to one body or to all.
#[derive(Clone, Copy, Debug)]
enum Event {
    Nothing,
    Jump,
    Shock,
    Reshape,
    Swap,
    Turn,
    Slide,
    Grow,
    Drive,
    Remove,
    Add,
    Lose,
    Find,
    Bullet,
}

use Event::*;

fn events() -> impl Strategy<Value = Vec<(Event, usize)>> {
    let all = [Jump, Shock, Reshape, Swap, Turn, Slide, Grow, Drive, Remove, Add, Lose, Find, Bullet];
    let event = prop_oneof![30 => Just(Nothing), 10 => prop::sample::select(all.to_vec())];
    prop::collection::vec((event, 0..1000_usize), 40)
}

/// A scene that moves: bodies, who is driven, and velocities in m a call.
struct Moving<T, R, const D: usize> {
    scene: Scene<T, R, D>,
    driven: Vec<bool>,
    velocity: Vec<[f64; D]>,
    dice: Dice,
}

impl<T: Clone, R: Copy, const D: usize> Moving<T, R, D> {
    fn new(scene: Scene<T, R, D>, pace: f64, seed: u64) -> Self {
        let mut dice = Dice(seed);
        let count = scene.0.len();
        let velocity = (0..count).map(|_| std::array::from_fn(|_| pace * (dice.roll() - 0.5))).collect();
        Self { scene, driven: (0..count).map(driven).collect(), velocity, dice }
    }

    /// Everything moves on; then the event happens to body `who`.
    fn advance(&mut self, event: Event, who: usize, turned: impl Fn(&mut Dice) -> R) {
        let Self { scene: (shapes, poses, reach), driven, velocity, dice } = self;
        for (pose, velocity) in poses.iter_mut().zip(velocity.iter()) {
            pose.position = std::array::from_fn(|k| pose.position[k] + velocity[k] * (0.5 + dice.roll()));
        }
        let (who, other) = (who % shapes.len(), (7 * who + 1) % shapes.len());
        match event {
            Nothing => {}
            Jump => poses[who].position = std::array::from_fn(|_| dice.roll() - 0.5),
            Shock => velocity.iter_mut().for_each(|v| *v = v.map(|x| 3.0 * x)),
            Reshape => shapes[who] = shapes[other].clone(),
            Swap => {
                shapes.swap(who, other);
                poses.swap(who, other);
            }
            Turn => poses[who].rotation = turned(dice),
            Slide => velocity[who % 2 + 3] = std::array::from_fn(|_| 0.02 * (dice.roll() - 0.5)),
            Grow => reach.iter_mut().for_each(|reach| *reach *= 1.5),
            Drive => driven[who] = !driven[who],
            Remove => {
                shapes.remove(who);
                poses.remove(who);
                reach.remove(who);
                driven.remove(who);
                velocity.remove(who);
            }
            Add => {
                shapes.push(shapes[who].clone());
                poses.push(poses[other]);
                reach.push(0.01);
                driven.push(false);
                velocity.push([0.0; D]);
            }
            Lose => poses[who].position[0] = f64::NAN,
            Find => poses.iter_mut().for_each(|pose| pose.position = pose.position.map(|x| if x.is_nan() { 0.1 } else { x })),
            Bullet => velocity[who] = std::array::from_fn(|_| 0.2 * (dice.roll() - 0.5)),
        }
    }
}

/// Holds a detector that remembers against a new one at each call, and says how often it made its list.
fn agrees<S: Space<D, N>, const D: usize, const N: usize>(
    mut moving: Moving<S::Shape, S::Rotation, D>,
    events: &[(Event, usize)],
    turned: impl Fn(&mut Dice) -> S::Rotation,
) -> usize {
    let mut detector = Detector::<D>::new();
    let (mut found, mut expected, mut made) = (Vec::new(), Vec::new(), 0);
    for (call, &(event, who)) in events.iter().enumerate() {
        moving.advance(event, who, &turned);
        let Moving { scene: (shapes, poses, reach), driven, .. } = &moving;
        detector.detect::<S, N>(shapes, poses, reach, |i| driven[i], &mut found);
        Detector::new().detect::<S, N>(shapes, poses, reach, |i| driven[i], &mut expected);
        assert_eq!(found, expected, "call {call}: {event:?} of {who}");
        made += usize::from(detector.nearby.calls == 0);
    }
    made
}

fn turn_in_plane(dice: &mut Dice) -> [f64; 2] {
    let [x, y] = [dice.roll() - 0.5, dice.roll() - 0.5];
    let length = (x * x + y * y).sqrt();
    [x / length, y / length]
}

fn turn_in_space(dice: &mut Dice) -> DQuat {
    let mut centred = || dice.roll() - 0.5;
    DQuat::from_xyzw(centred(), centred(), centred(), centred()).normalize()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn a_detector_that_remembers_finds_in_the_plane_what_a_new_one_finds(
        events in events(), seed in 0..u64::MAX, pace in prop::sample::select(vec![0.0, 1e-5, 1e-3, 0.03]),
    ) {
        agrees::<Plane, 2, 3>(Moving::new(plane_scene(120, &mut Dice(seed)), pace, seed), &events, turn_in_plane);
    }

    #[test]
    fn a_detector_that_remembers_finds_in_space_what_a_new_one_finds(
        events in events(), seed in 0..u64::MAX, pace in prop::sample::select(vec![0.0, 1e-5, 1e-3, 0.03]),
    ) {
        agrees::<Solid, 3, 6>(Moving::new(solid_scene(120, &mut Dice(seed)), pace, seed), &events, turn_in_space);
    }
}

#[test]
fn slow_walls_and_bodies_seldom_need_a_new_list_and_fast_ones_always_do() {
    let quiet = vec![(Nothing, 0); 200];
    let made = |pace| agrees::<Solid, 3, 6>(Moving::new(solid_scene(300, &mut Dice(1)), pace, 1), &quiet, turn_in_space);
    assert_eq!(made(0.0), 1);
    assert!((2..15).contains(&made(1e-5)), "{}", made(1e-5));
    assert!(made(0.2) > 190);
}
