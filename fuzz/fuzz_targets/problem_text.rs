//! Whatever the bytes are, reading them as text gives a problem or an error; a problem is written and read back the same.
#![no_main]

use libfuzzer_sys::fuzz_target;
use moreau_solve::files;

fuzz_target!(|bytes: &[u8]| {
    let Ok(problem) = files::read_text(bytes) else { return };
    problem.check().expect("what is read passes its own check");
    let text = files::write_text(&problem).expect("what was text can be text");
    files::read_text(text.as_bytes()).expect("text that was written is read").same_as(&problem).expect("text");
    // An index may need more than the 32 bits that FCLIB has.
    if let Ok(bytes) = files::write_fclib(&problem) {
        files::read_fclib(&bytes).expect("FCLIB's format that was written is read").same_as(&problem).expect("FCLIB");
    }
    let _ = problem.any_problem();
});
