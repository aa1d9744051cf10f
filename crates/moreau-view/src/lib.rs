//! What a simulation of rigid bodies looks like.
//!
//! [`picture`] draws bodies and the forces between them into files, in space and in the plane, and makes movies of them. It needs
//! neither a display nor a graphics card.

pub mod picture;
