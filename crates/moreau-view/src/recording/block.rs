//! Frames as a page reads them: little-endian numbers in single precision, one array after the other, deflated together.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use moreau::trajectory::{Trajectory, TrajectoryError, TrajectoryFrame};
use std::io::Write as _;

/// These frames of a trajectory.
///
/// # Errors
/// Where they cannot be read.
pub fn block(trajectory: &Trajectory, frames: &[usize]) -> Result<Vec<u8>, TrajectoryError> {
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::default());
    let mut bytes = Vec::new();
    for &i in frames {
        bytes.clear();
        put(&mut bytes, &trajectory.frame(i)?);
        // A vector takes all that is written.
        let _ = packed.write_all(&bytes);
    }
    Ok(packed.finish().unwrap_or_default())
}

fn put(bytes: &mut Vec<u8>, frame: &TrajectoryFrame) {
    for reals in [&frame.position, &frame.rotation, &frame.velocity, &frame.spin] {
        singles(bytes, reals);
    }
    whole_words(bytes, &frame.motion);
    for bodies in &frame.pairs {
        bytes.extend(bodies.iter().flat_map(|body| body.to_le_bytes()));
    }
    for reals in [&frame.point, &frame.normal, &frame.impulse, &frame.gap] {
        singles(bytes, reals);
    }
    whole_words(bytes, &frame.status);
}

fn whole_words(bytes: &mut Vec<u8>, numbers: &[u8]) {
    bytes.extend(numbers);
    bytes.resize(bytes.len().next_multiple_of(4), 0);
}

fn singles(bytes: &mut Vec<u8>, reals: &[f64]) {
    bytes.extend(reals.iter().flat_map(|&x| (x as f32).to_le_bytes()));
}
