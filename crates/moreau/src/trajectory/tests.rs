//! What is written is read again, to the last frame that is whole.

use super::{Batch, Header, Precision, Trajectory, TrajectoryWriter};
use crate::observe::COLUMNS;

fn header() -> Header {
    Header {
        dimension: 3,
        title: "two balls on a floor".to_owned(),
        step: 1e-3,
        every: 10,
        radius: vec![0.5, 0.25, f64::INFINITY],
        mass: vec![1.0, 2.0, f64::INFINITY],
        material: vec![0, 1, 0],
        free: vec![true, true, false],
    }
}

/// Frame `k` of three bodies with `k` contacts; every number tells where it should be.
fn frame(k: u64) -> Batch {
    let numbers = |count: u64, first: f64| (0..count).map(|i| first + 100.0 * k as f64 + i as f64).collect::<Vec<f64>>();
    let mut row = [0.0; COLUMNS.len()];
    row[0] = k as f64;
    row[COLUMNS.len() - 1] = 1.0 / 3.0;
    Batch {
        step: vec![10 * k],
        time: vec![0.01 * k as f64],
        contacts: vec![k],
        reals: [
            numbers(9, 0.1),
            numbers(12, 0.2),
            numbers(9, 0.3),
            numbers(9, 0.4),
            numbers(3 * k, 0.5),
            numbers(3 * k, 0.6),
            numbers(3 * k, 0.7),
            numbers(k, 0.8),
        ],
        motion: vec![2, if k < 5 { 0 } else { 2 }, 1],
        pairs: [vec![0; k as usize], vec![2; k as usize]],
        status: vec![1; k as usize],
        rows: vec![row],
    }
}

#[test]
fn frames_are_read_as_they_were_written() {
    let folder = tempfile::tempdir().unwrap();
    for (precision, epsilon) in [(Precision::Double, 0.0), (Precision::Single, 1e-7)] {
        let path = folder.path().join("trajectory.h5");
        let mut writer = TrajectoryWriter::create(&path, &header(), precision).unwrap();
        assert_eq!(Trajectory::open(&path).unwrap().frames(), 0);
        for k in 0..40 {
            writer.append(&frame(k)).unwrap();
            if k == 20 {
                // While the writer has it open.
                let trajectory = Trajectory::open(&path).unwrap();
                assert_eq!((trajectory.frames(), trajectory.contacts(20)), (21, 20));
                assert_eq!(trajectory.frame(20).unwrap().pairs[1], vec![2; 20]);
            }
        }
        writer.finish().unwrap();
        let trajectory = Trajectory::open(&path).unwrap();
        assert_eq!(trajectory.header(), &header());
        assert_eq!(trajectory.frames(), 40);
        for k in [0, 1, 7, 39] {
            let (written, read) = (frame(k), trajectory.frame(k as usize).unwrap());
            assert_eq!((read.step, read.time), (10 * k, 0.01 * k as f64));
            let reals =
                [&read.position, &read.rotation, &read.velocity, &read.spin, &read.point, &read.normal, &read.impulse, &read.gap];
            for (written, read) in written.reals.iter().zip(reals) {
                assert_eq!(written.len(), read.len());
                assert!(written.iter().zip(read).all(|(w, r)| (w - r).abs() <= epsilon * w), "{written:?} {read:?}");
            }
            assert_eq!((read.motion, read.pairs, read.status), (written.motion, written.pairs, written.status));
        }
        let columns = trajectory.columns().unwrap();
        assert_eq!(columns[0], (0..40).map(f64::from).collect::<Vec<_>>());
        assert_eq!(columns[COLUMNS.len() - 1], vec![1.0 / 3.0; 40]);
        assert!(trajectory.frame(40).unwrap_err().to_string().contains("there is no frame 40"));
    }
}

#[test]
fn what_is_no_trajectory_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("trajectory.h5");
    std::fs::write(&path, "time,step\n0,0\n").unwrap();
    assert!(Trajectory::open(&path).is_err());
    let mut other = hdf5_pure::FileBuilder::new();
    other.create_dataset("numbers").with_f64_data(&[1.0]);
    other.write(&path).unwrap();
    let error = Trajectory::open(&path).err().unwrap().to_string();
    assert!(error.contains("it is no trajectory"), "{error}");
}

/// Libraries from HDF5 2.0 on refuse chunks of 65 536 numbers and more as hdf5-pure writes them.
#[test]
fn chunks_of_many_bodies_are_short() {
    let folder = tempfile::tempdir().unwrap();
    for bodies in [16_384, 20_001, 70_003, 262_144] {
        let header = Header {
            radius: vec![1.0; bodies],
            mass: vec![1.0; bodies],
            material: vec![0; bodies],
            free: vec![true; bodies],
            ..header()
        };
        let path = folder.path().join(format!("{bodies}.h5"));
        drop(TrajectoryWriter::create(&path, &header, Precision::Single).unwrap());
        let file = hdf5_pure::File::open(&path).unwrap();
        for name in
            ["frames/position", "frames/rotation", "frames/spin", "contacts/impulse", "bodies/radius", "bodies/free", "steps"]
        {
            let chunk = file.dataset(name).unwrap().chunk_shape().unwrap().expect("it has chunks")[0];
            assert!((1..65_536).contains(&chunk), "{name} of {bodies} bodies has chunks of {chunk}");
            // Frames end with chunks, so that none is written twice.
            let frame = bodies as u64 * if name == "frames/rotation" { 4 } else { 3 };
            assert!(
                !name.starts_with("frames/") || bodies == 70_003 || frame.is_multiple_of(chunk),
                "{name}: {chunk} in {frame}"
            );
        }
    }
}

/// More numbers than the bytes of a file can stand for are refused, before memory for them is taken.
#[test]
fn numbers_that_a_file_cannot_hold_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("many.h5");
    let count = 1_100_000;
    let (radius, mass) = (vec![1.0; count], vec![1.0; count]);
    let header = Header { radius, mass, material: vec![0; count], free: vec![true; count], ..header() };
    drop(TrajectoryWriter::create(&path, &header, Precision::Single).unwrap());
    let file = hdf5_pure::File::open(&path).unwrap();
    let length = std::fs::metadata(&path).unwrap().len();
    assert!(super::read::holds(&file, &path, length).is_ok());
    // As if all of its bytes but a few were gone.
    let error = super::read::holds(&file, &path, 10).unwrap_err().to_string();
    assert!(error.contains("bodies/radius claims 1100000 numbers, which the 10 bytes"), "{error}");
}
