//! The Delassus operator W = H* M⁻¹ H (eq. 17), three ways: through the bodies, through bodies that are round, or stored.

pub mod balls;
pub(crate) mod colouring;
mod delassus;
mod lightest;
mod matrix_free;

pub use balls::Balls;
pub use delassus::Delassus;
pub use lightest::{Lightest, Standing};
pub use matrix_free::{MatrixFree, NONE};

use crate::block::{Matrix, Vector};
use std::borrow::Cow;

/// What a Gauss-Seidel sweep asks of W. `State` stands for the impulses applied so far.
pub trait Operator<const D: usize>: Sync {
    /// Body velocities, or the impulses themselves.
    type State: Default + Clone + Send + Sync;

    /// Makes `state` that of the impulses `r`, from nothing.
    fn start(&self, r: &[Vector<D>], state: &mut Self::State);

    /// The diagonal block W_cc.
    fn diagonal(&self, c: usize) -> Matrix<D>;

    /// (W r)_c.
    fn apply(&self, state: &Self::State, c: usize) -> Vector<D>;

    /// Orders the contacts so that neighbours in the order share no body, as far as that can be had; see [`crate::Order::Coloured`].
    /// An operator that does not know its bodies leaves `order` as it is.
    fn colour(&self, _order: &mut [u32]) {}

    /// state ← state + β (state − previous): the state of extrapolated impulses, since it is linear in them.
    fn extrapolate(&self, state: &mut Self::State, previous: &Self::State, beta: f64);

    /// W in stored blocks, for methods that factorise it.
    fn stored(&self) -> Cow<'_, Delassus<D>>;

    /// J of W = J Jᵀ, for methods that factorise through the bodies; `None` where the operator knows W alone.
    fn root(&self) -> Option<Root> {
        None
    }

    /// The operator as contacts of round bodies, if it is one: such contacts can be visited several at a time.
    fn balls(&self) -> Option<&Balls<D>> {
        None
    }

    /// One visit: gives W_cc and (W r)_c to `visit`, and adds the change of the impulse that it returns.
    fn relax(&self, state: &mut Self::State, c: usize, visit: impl Visit<D>);
}

/// J of W = J Jᵀ: a row for each component of each contact, a column for each degree of freedom of a body.
#[derive(Clone, Debug, Default)]
pub struct Root {
    /// How many columns it has.
    pub columns: usize,
    /// Row, column and value of what is not zero.
    pub entries: Vec<(usize, usize, f64)>,
}

/// What is done at a visit. A type, not a closure, since a closure cannot insist on being compiled into the sweep: left out of it, a
/// visit takes three times as long.
pub trait Visit<const D: usize> {
    /// The change of the impulse, from W_cc and (W r)_c.
    fn change(self, w: &Matrix<D>, wr: Vector<D>) -> Vector<D>;
}

/// The visit that adds an impulse, whatever is there.
struct Add<'a, const D: usize>(&'a Vector<D>);

impl<const D: usize> Visit<D> for Add<'_, D> {
    #[inline(always)]
    fn change(self, _: &Matrix<D>, _: Vector<D>) -> Vector<D> {
        *self.0
    }
}

/// a ← a + β (a − b), for states that are arrays of vectors.
fn extrapolate<const K: usize>(a: &mut [[f64; K]], b: &[[f64; K]], beta: f64) {
    for (a, b) in a.iter_mut().zip(b) {
        for k in 0..K {
            a[k] += beta * (a[k] - b[k]);
        }
    }
}
