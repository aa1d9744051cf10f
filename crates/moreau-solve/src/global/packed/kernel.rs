//! What a packed visit is made of.

use crate::Cone;
use crate::block::Vector;
use crate::operator::balls::{RoundBody, RoundContact};
use crate::wide::{Four, LANES, Wide};

/// The bodies' rows of a group's four contacts.
pub(super) type Rows<F, const B: usize> = [[F; B]; LANES];

/// The two sides of a group.
pub(super) type Sides<F, const B: usize> = [Rows<F, B>; 2];

/// One contact on its way into a lane.
pub(crate) struct Lane<'a, const D: usize> {
    pub contact: &'a RoundContact<D>,
    /// Where its bodies are in the state.
    pub rows: [u32; 2],
    pub q: &'a Vector<D>,
    pub cone: Cone,
}

/// Where bodies are read.
pub(crate) trait Seen<T> {
    fn get(&self, i: usize) -> &T;
}

/// Where bodies are read and written during a sweep.
pub(crate) trait Places<T>: Seen<T> {
    fn set(&mut self, i: usize, value: T);
}

impl<T> Seen<T> for &[T] {
    #[inline(always)]
    fn get(&self, i: usize) -> &T {
        &self[i]
    }
}

impl<T> Seen<T> for &mut [T] {
    #[inline(always)]
    fn get(&self, i: usize) -> &T {
        &self[i]
    }
}

impl<T> Places<T> for &mut [T] {
    #[inline(always)]
    fn set(&mut self, i: usize, value: T) {
        self[i] = value;
    }
}

/// One law for four contacts, with B rows of four numbers a body and C components an impulse.
///
/// Kernels count in the norm of the diagonal of W: with its largest entry w, impulses are √w times the problem's and velocities 1/√w
/// times, so that a visit knows no other unit and sums of squares need no weights.
pub(crate) trait Kernel<const B: usize, const C: usize>: 'static {
    /// All that is read of four contacts; its default is four empty lanes.
    type Group: Copy + Clone + std::fmt::Debug + Default + Send + Sync;

    /// The rows of a body at rest.
    fn body(body: RoundBody) -> [Four; B];
    /// Puts a contact into a lane.
    fn fill<const D: usize>(group: &mut Self::Group, lane: usize, contact: &Lane<'_, D>);
    /// Gives empty lanes a body that is none.
    fn blank(group: &mut Self::Group, row: u32);
    /// √w.
    fn scale<const D: usize>(contact: &RoundContact<D>) -> f64;
    /// `by` times an impulse or velocity, in the kernel's components.
    fn pack<const D: usize>(contact: &RoundContact<D>, x: &Vector<D>, by: f64) -> [f64; C];
    /// `by` times what is in the kernel's components, in the contact's frame.
    fn unpack<const D: usize>(contact: &RoundContact<D>, x: &[f64; C], by: f64) -> Vector<D>;

    /// Rows of the two bodies of each contact.
    fn pairs(group: &Self::Group) -> &[[u32; 2]; LANES];
    /// u, with q.
    fn velocity<W: Wide>(w: W, group: &Self::Group, sides: &Sides<W::F, B>) -> [W::F; C];
    /// The new impulse from the old one, y, and the velocity u that goes with it.
    fn visit<W: Wide>(w: W, group: &Self::Group, y: &[W::F; C], u: &[W::F; C]) -> [W::F; C];
    /// The velocity that the visit claims for z.
    fn claim<W: Wide>(w: W, group: &Self::Group, u: &[W::F; C], change: &[W::F; C]) -> [W::F; C];
    /// Adds the change of the impulses to the bodies, which are at `pairs`: by value, since no store may seem to change it.
    fn push<W: Wide>(
        w: W,
        group: &Self::Group,
        pairs: [[u32; 2]; LANES],
        bodies: &mut impl Places<[Four; B]>,
        sides: &Sides<W::F, B>,
        change: &[W::F; C],
    );
    /// ‖ũ − u‖², of the components that the law knows, in the problem's unit.
    fn apart<W: Wide>(w: W, group: &Self::Group, claimed: &[W::F; C], u: &[W::F; C]) -> W::F;
}
