//! Whatever the text is, reading it as a scene gives a scene or an error; a scene that is written is read back the same.
#![no_main]

use libfuzzer_sys::fuzz_target;
use moreau::scene::Scene;

fuzz_target!(|text: &str| {
    // Files that it names are not there.
    let Ok(scene) = Scene::parse(text, "nowhere/fuzz.toml") else { return };
    let _ = scene.estimate();
    let written = scene.to_toml();
    assert!(Scene::parse(&written, "nowhere/fuzz.toml").expect("a scene that was written is read") == scene, "{written}");
});
