//! Whatever the bytes are, reading them as FCLIB's HDF5 gives a problem or an error; a problem is written and read back the same.
#![no_main]

use libfuzzer_sys::fuzz_target;
use moreau_solve::files;

fuzz_target!(|bytes: &[u8]| {
    let Ok(problem) = files::read_fclib(bytes) else { return };
    problem.check().expect("what is read passes its own check");
    let again = files::write_fclib(&problem).expect("what was FCLIB's can be");
    files::read_fclib(&again).expect("what was written is read").same_as(&problem).expect("FCLIB");
    // Text has no place for equality constraints, nor for rolling in the plane of no contact.
    if let Ok(text) = files::write_text(&problem) {
        files::read_text(text.as_bytes()).expect("text that was written is read").same_as(&problem).expect("text");
    }
    let _ = problem.any_problem();
});
