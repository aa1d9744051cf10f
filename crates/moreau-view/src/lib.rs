//! What a run looks like.
//!
//! [`recording`] opens the folder of a run, and [`report`](report::report) makes a page of it that plays in a browser, from one file and
//! without a network; [`render`] makes pictures of its frames, and [`serve`] hands a run to a browser on this machine while it goes on.
//! [`picture`] draws bodies and the forces between them into files, in space and in the plane, and makes movies of them; it needs neither a
//! display nor a graphics card.

mod page;
pub mod picture;
pub mod recording;
pub mod render;
pub mod report;
pub mod serve;
