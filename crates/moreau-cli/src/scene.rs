//! Loading a scene, with the memory of this machine.

use crate::Failure;
use moreau::scene::{AnyWorld, Scene};
use std::path::Path;

/// Bytes that programs may still take; no limit where the system does not tell.
pub(crate) fn available_memory() -> u64 {
    let mut system = sysinfo::System::new();
    system.refresh_memory();
    match system.available_memory() {
        0 => u64::MAX,
        bytes => bytes,
    }
}

/// Bytes that this program holds; zero where the system does not tell.
pub(crate) fn memory_in_use() -> u64 {
    let Ok(pid) = sysinfo::get_current_pid() else { return 0 };
    let mut system = sysinfo::System::new();
    system.refresh_processes(sysinfo::ProcessesToUpdate::Some(&[pid]), true);
    system.process(pid).map_or(0, sysinfo::Process::memory)
}

/// How many threads the machine runs at once.
pub(crate) fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

/// As many threads as the user asks for.
pub(crate) fn pool(threads: usize) -> Result<rayon::ThreadPool, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(|error| Failure::computation(format!("cannot start {threads} threads: {error}")))
}

/// Reads a scene with its overrides, and prints what is remarked about its files.
pub(crate) fn load(path: &Path, sets: &[String]) -> Result<Scene, Failure> {
    if let Err(error) = std::fs::read(path) {
        let hint = "give the path of a scene file, or make one with `moreau new NAME`";
        return Err(Failure::file(format!("{}: cannot read the scene: {error}; {hint}", path.display())));
    }
    let scene = Scene::load_with(path, sets).map_err(Failure::scene)?;
    scene.remarks().iter().for_each(|remark| crate::failure::remark(remark));
    Ok(scene)
}

/// Makes the scene's world, if it fits into memory.
pub(crate) fn build(scene: &Scene) -> Result<AnyWorld, Failure> {
    scene.build(available_memory()).map_err(Failure::scene)
}

/// The scene's name: its file's.
pub(crate) fn name(path: &Path) -> String {
    path.file_stem().map_or_else(|| "scene".to_owned(), |stem| stem.to_string_lossy().into_owned())
}
