//! Events: what happens to bodies at given times. Drives begin and end, bodies come and go.
//!
//! Events act between steps: at the first beginning of a step at or after their time. What they change in the energy of the free bodies
//! is booked as work (theory, section 19). All is done in a fixed order by one thread.

mod flow;
mod state;

pub use flow::{Rain, Sink, Source};
pub(crate) use state::ScheduleState;

use crate::bodies::{Bodies, Motion};
use crate::drive::{Drive, mean};
use crate::space::{Pose, Space};

/// By which part of a step an event may come early, because the clock is a sum of steps and has their rounding. Where a function of
/// time has a corner at the beginning of a step, this part of a step decides on which side it is.
const EARLY: f64 = 1e-3;

/// Something that happens to one body.
#[derive(Clone, Debug, PartialEq)]
pub struct Event<const D: usize, const N: usize> {
    /// When, s.
    pub time: f64,
    /// Index of the body.
    pub body: usize,
    /// What.
    pub change: Change<D, N>,
}

/// What happens to a body.
#[derive(Clone, Debug, PartialEq)]
pub enum Change<const D: usize, const N: usize> {
    /// From now on it does this, in place of what it did.
    Drive(Drive<D, N>),
    /// It is taken out of the world for good.
    Remove,
}

/// A drive that is at work.
#[derive(Clone, Debug)]
struct Running<R, const D: usize, const N: usize> {
    /// Index of the event that began it.
    event: usize,
    /// When it began, s.
    since: f64,
    /// Where its body was then.
    start: Pose<R, D>,
    /// The constant load of its body.
    load: [f64; N],
}

/// All events of a run, and the drives that are at work.
#[derive(Clone, Debug)]
pub struct Schedule<S: Space<D, N>, const D: usize, const N: usize> {
    /// By time; those before `next` have happened.
    events: Vec<Event<D, N>>,
    next: usize,
    running: Vec<Running<S::Rotation, D, N>>,
    sources: Vec<Source<D, N>>,
    sinks: Vec<Sink<D>>,
    inserted: u64,
    removed: u64,
}

impl<S: Space<D, N>, const D: usize, const N: usize> Default for Schedule<S, D, N> {
    fn default() -> Self {
        Self::new(Vec::new(), Vec::new(), Vec::new())
    }
}

impl<S: Space<D, N>, const D: usize, const N: usize> Schedule<S, D, N> {
    /// A schedule of these events, in any order (of two at one time the first comes first), and of sources and sinks.
    pub fn new(mut events: Vec<Event<D, N>>, sources: Vec<Source<D, N>>, sinks: Vec<Sink<D>>) -> Self {
        events.sort_by(|a, b| a.time.total_cmp(&b.time));
        Self { events, next: 0, running: Vec::new(), sources, sinks, inserted: 0, removed: 0 }
    }

    /// Whether nothing ever happens.
    pub fn is_empty(&self) -> bool {
        self.events.is_empty() && self.sources.is_empty() && self.sinks.is_empty()
    }

    /// How many bodies have come so far from sources.
    pub fn inserted(&self) -> u64 {
        self.inserted
    }

    /// How many bodies have been removed so far, by sinks or at their times.
    pub fn removed(&self) -> u64 {
        self.removed
    }

    /// Bodies that come from a source, and such as are set free.
    pub(crate) fn freed(&self) -> impl Iterator<Item = usize> {
        let frees = |event: &&Event<D, N>| matches!(event.change, Change::Drive(Drive::Free(_)));
        let later = self.events.iter().filter(frees).map(|event| event.body);
        self.sources.iter().flat_map(Source::bodies).chain(later)
    }

    /// Does what is due at `time`, the beginning of a step of length `h`; returns the energy of free bodies that it brought, J.
    pub(crate) fn act(&mut self, bodies: &mut Bodies<S, D, N>, gravity: &[f64; D], time: f64, h: f64) -> f64 {
        let now = time + EARLY * h;
        let mut brought = 0.0;
        while self.events.get(self.next).is_some_and(|event| event.time <= now) {
            let body = self.events[self.next].body;
            let energy = |bodies: &Bodies<S, D, N>| bodies.energy(body, gravity).iter().sum::<f64>();
            let before = energy(bodies);
            self.happen(bodies, time, h);
            brought += energy(bodies) - before;
        }
        for source in &mut self.sources {
            let came = source.rain(bodies, time, now);
            self.inserted += came.len() as u64;
            brought += came.flat_map(|i| bodies.energy(i, gravity)).sum::<f64>();
        }
        if !self.sinks.is_empty() {
            brought -= self.swallow(bodies, gravity);
        }
        brought
    }

    /// Lets the next event happen. What is absent stays so.
    fn happen(&mut self, bodies: &mut Bodies<S, D, N>, time: f64, h: f64) {
        let Event { body, change, .. } = &self.events[self.next];
        let i = *body;
        if let Some(ended) = self.running.iter().position(|running| self.events[running.event].body == i) {
            bodies.load[i] = self.running.remove(ended).load;
        }
        if bodies.is_present(i) {
            match change {
                Change::Remove => {
                    bodies.set_motion(i, Motion::Absent);
                    self.removed += 1;
                }
                Change::Drive(drive) => {
                    self.running.push(Running { event: self.next, since: time, start: bodies.pose[i], load: bodies.load[i] });
                    match drive {
                        Drive::Free(_) => bodies.set_motion(i, Motion::Free),
                        Drive::Imposed(imposed) => {
                            bodies.set_motion(i, Motion::Driven);
                            bodies.velocity[i] = imposed.velocity::<S, N>(bodies.pose[i].rotation, time, EARLY * h);
                        }
                    }
                }
            }
        }
        self.next += 1;
    }

    /// Takes out the free bodies that have got into a sink; returns the energy that they had, J.
    fn swallow(&mut self, bodies: &mut Bodies<S, D, N>, gravity: &[f64; D]) -> f64 {
        let (mut taken, mut count) = (0.0, 0);
        for i in 0..bodies.len() {
            if bodies.is_free(i) && self.sinks.iter().any(|sink| sink.holds(&bodies.pose[i].position)) {
                taken += bodies.energy(i, gravity).iter().sum::<f64>();
                bodies.set_motion(i, Motion::Absent);
                count += 1;
            }
        }
        if count > 0 {
            let events = &self.events;
            self.running.retain(|running| bodies.is_present(events[running.event].body));
            self.removed += count;
        }
        taken
    }

    /// What drives give at the beginning of a (part of a) step of length `h` at `time`: the velocities of driven bodies, which may jump
    /// here, and the mean loads of free ones, theory (62) and (64).
    pub(crate) fn begin_step(&self, bodies: &mut Bodies<S, D, N>, time: f64, h: f64) {
        for (i, running, drive) in self.at_work() {
            match drive {
                Drive::Free(load) => {
                    let mean = mean(load, time, h);
                    bodies.load[i] = std::array::from_fn(|k| running.load[k] + mean[k]);
                }
                Drive::Imposed(imposed) => {
                    bodies.velocity[i] = imposed.velocity::<S, N>(bodies.pose[i].rotation, time, EARLY * h);
                }
            }
        }
    }

    /// The velocities of driven bodies at the end, theory (62), into those that bodies have without contacts.
    pub(crate) fn end_velocities(&self, bodies: &Bodies<S, D, N>, time: f64, h: f64, free: &mut [[f64; N]]) {
        for (i, _, drive) in self.at_work() {
            if let Drive::Imposed(imposed) = drive {
                free[i] = imposed.velocity::<S, N>(bodies.pose[i].rotation, time + h, -EARLY * h);
            }
        }
    }

    /// Puts driven bodies where they are to be at `time`, theory (63).
    pub(crate) fn place(&self, bodies: &mut Bodies<S, D, N>, time: f64) {
        for (i, running, drive) in self.at_work() {
            if let Drive::Imposed(imposed) = drive {
                bodies.pose[i] = imposed.pose::<S, N>(&running.start, running.since, time);
            }
        }
    }

    /// The drives that are at work, each with its body.
    fn at_work(&self) -> impl Iterator<Item = (usize, &Running<S::Rotation, D, N>, &Drive<D, N>)> {
        self.running.iter().filter_map(|running| match &self.events[running.event] {
            Event { body, change: Change::Drive(drive), .. } => Some((*body, running, drive)),
            Event { change: Change::Remove, .. } => None,
        })
    }
}
