//! Whatever the bytes are, reading them as a trajectory gives frames and records or errors.
#![no_main]

use libfuzzer_sys::fuzz_target;
use moreau::trajectory::Trajectory;

fuzz_target!(|bytes: &[u8]| {
    let file = tempfile::NamedTempFile::new().expect("a place for it");
    std::fs::write(file.path(), bytes).expect("it is written");
    let Ok(trajectory) = Trajectory::open(file.path()) else { return };
    for i in 0..trajectory.frames().min(8) {
        let _ = trajectory.frame(i);
    }
    let _ = trajectory.columns();
});
