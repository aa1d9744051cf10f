//! moreau computes how many rigid bodies move when they touch: nonsmooth contact dynamics, Moreau-Jean time stepping.

// Bits must not depend on the system's mathematics library; see docs/determinism.md.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod bodies;
pub mod checkpoint;
pub mod compare;
pub mod contacts;
pub mod convergence;
pub mod detect;
mod disjoint;
pub mod drive;
pub mod events;
pub mod io;
pub mod joints;
pub mod laws;
pub mod measure;
pub mod mesh;
pub mod observe;
mod random;
pub mod run;
pub mod scene;
pub mod shape;
pub mod space;
pub mod step;
mod symmetric;
pub mod trajectory;
pub mod world;

pub use moreau_solve as solve;

// The program of the README is run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
