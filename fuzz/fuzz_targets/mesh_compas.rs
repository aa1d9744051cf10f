//! Whatever the bytes are, reading them as an assembly of COMPAS gives blocks or an error; corners and pairs are among what there is.
#![no_main]

use libfuzzer_sys::fuzz_target;
use moreau::mesh::compas::Assembly;

fuzz_target!(|bytes: &[u8]| {
    let Ok(assembly) = Assembly::from_json(bytes, "fuzz.json") else { return };
    for block in &assembly.blocks {
        assert!(block.mesh.faces.iter().flatten().all(|&point| (point as usize) < block.mesh.points.len()));
        let _ = block.mesh.triangulated().closed();
    }
    assert!(assembly.interfaces.iter().flat_map(|interface| interface.blocks).all(|block| block < assembly.blocks.len()));
});
