//! The Delassus operator W = H* M⁻¹ H (eq. 17), two ways: through the bodies, or stored.

mod delassus;
mod matrix_free;

pub use delassus::Delassus;
pub use matrix_free::{MatrixFree, NONE};

use crate::block::{Matrix, Vector};

/// What a Gauss-Seidel sweep asks of W. `State` stands for the impulses applied so far.
pub trait Operator<const D: usize>: Sync {
    /// Body velocities, or the impulses themselves.
    type State: Default + Clone + Send;

    /// Makes `state` that of the impulses `r`, from nothing.
    fn start(&self, r: &[Vector<D>], state: &mut Self::State);

    /// The diagonal block W_cc.
    fn diagonal(&self, c: usize) -> &Matrix<D>;

    /// (W r)_c.
    fn apply(&self, state: &Self::State, c: usize) -> Vector<D>;

    /// Orders the contacts so that neighbours in the order share no body, as far as that can be had; see [`crate::Order::Coloured`].
    /// An operator that does not know its bodies leaves `order` as it is.
    fn colour(&self, _order: &mut [u32]) {}

    /// One visit: gives W_cc and (W r)_c to `visit`, and adds the change of the impulse that it returns.
    fn relax(&self, state: &mut Self::State, c: usize, visit: impl FnOnce(&Matrix<D>, Vector<D>) -> Vector<D>);
}
