//! Whatever the bytes are, reading them as STL gives a mesh or an error, and so do the checks; a closed mesh has a volume.
#![no_main]

use libfuzzer_sys::fuzz_target;
use moreau::mesh::Mesh;
use moreau::shape::solid::Surface;

fuzz_target!(|bytes: &[u8]| {
    let Ok(mesh) = Mesh::from_stl(bytes, "fuzz.stl") else { return };
    let _ = Surface::new(mesh.clone());
    if let Ok(closed) = mesh.closed() {
        assert!(closed.mass().volume > 0.0);
    }
});
