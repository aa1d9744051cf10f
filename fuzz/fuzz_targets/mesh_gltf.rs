//! Whatever the bytes are, reading them as glTF gives a mesh or an error, and so do the checks; a closed mesh has a volume.
#![no_main]

use libfuzzer_sys::fuzz_target;
use moreau::mesh::MeshFile;
use moreau::shape::solid::Surface;

fuzz_target!(|bytes: &[u8]| {
    let Ok(file) = MeshFile::from_gltf(bytes, "fuzz.gltf") else { return };
    let _ = Surface::new(file.mesh.clone());
    if let Ok(closed) = file.mesh.closed() {
        assert!(closed.mass().volume > 0.0);
    }
});
