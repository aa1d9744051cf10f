//! What all tests of the program share: a folder of their own, the program run in it, and scenes.
#![allow(dead_code, reason = "each test program takes what it needs")]

pub(crate) mod problems;
pub(crate) mod watched;

use assert_cmd::cargo::cargo_bin;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// Ten balls of random velocity in a narrow box: 20 steps, with contacts from the second on.
pub(crate) const TEN: &str = r#"dimension = 3
gravity = [0.0, 0.0, -9.81]
time = { step = 1e-3, steps = 20 }
solver = { tolerance = 1e-7, start = "warm" }
materials.glass.density = 2500.0
default_law.coulomb = { friction = 0.3, restitution = 0.3 }
output.every = 5
[[containers]]
min = [0.0, 0.0, 0.0]
max = [0.03, 0.03, 0.2]
open = ["+z"]
material = "glass"
[[generate]]
material = "glass"
count = 10
radii.uniform = { min = 0.0045, max = 0.005 }
lattice = { min = [0.0, 0.0, 0.0], max = [0.03, 0.03, 0.1], jitter = 0.5 }
speed = 0.3
"#;

/// A folder that goes with the test, in which the program runs.
pub(crate) struct Place(TempDir);

impl Place {
    /// An empty one.
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder for the test"))
    }

    /// One with a scene.
    pub(crate) fn with(name: &str, scene: &str) -> Self {
        let place = Self::new();
        place.write(name, scene);
        place
    }

    /// Where `name` is.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file, and the folders above it.
    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("folders are made");
        fs::write(path, content).expect("the file is written");
    }

    /// Reads a file of text.
    #[track_caller]
    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Reads summary.json of the run in `folder`.
    #[track_caller]
    pub(crate) fn summary(&self, folder: &str) -> serde_json::Value {
        serde_json::from_str(&self.read(&format!("{folder}/summary.json"))).expect("summary.json is JSON")
    }

    /// All that is below `name`: each file with its content, each folder with none.
    pub(crate) fn all(&self, name: &str) -> BTreeMap<String, Option<Vec<u8>>> {
        let (top, mut all) = (self.path(name), BTreeMap::new());
        collect(&top, &top, &mut all);
        all
    }

    /// The program with its words, to be run here.
    pub(crate) fn command(&self, words: &[&str]) -> Command {
        let mut command = Command::new(cargo_bin!("moreau"));
        command.current_dir(self.0.path()).args(words);
        command
    }

    /// Runs the program to its end, with pipes on both of its outputs.
    pub(crate) fn moreau(&self, words: &[&str]) -> Ran {
        let output = self.command(words).output().expect("the program starts");
        let text = |bytes| String::from_utf8(bytes).expect("the program writes UTF-8");
        Ran { words: words.join(" "), code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
    }

    /// Runs the program, which fails with `code` and all of `wanted`, and leaves every file as it was.
    #[track_caller]
    pub(crate) fn refuses(&self, words: &[&str], code: i32, wanted: &[&str]) {
        let before = self.all(".");
        let ran = self.moreau(words);
        ran.fails(code, wanted);
        let after = self.all(".");
        let names = |all: &BTreeMap<String, _>| all.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(&before), names(&after), "`moreau {}` made or took files", ran.words);
        let changed: Vec<_> = before.keys().filter(|name| before[*name] != after[*name]).collect();
        assert!(changed.is_empty(), "`moreau {}` changed {changed:?}", ran.words);
    }
}

fn collect(top: &Path, folder: &Path, all: &mut BTreeMap<String, Option<Vec<u8>>>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        let name = path.strip_prefix(top).expect("below the top").to_string_lossy().into_owned();
        all.insert(name, fs::read(&path).ok());
        if path.is_dir() {
            collect(top, &path, all);
        }
    }
}

/// How the program ended.
#[derive(Debug)]
pub(crate) struct Ran {
    pub(crate) words: String,
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Ran {
    /// Checks that all went well and nothing was complained of, but for the verdict on a quiet run; gives what was printed.
    #[track_caller]
    pub(crate) fn fine(self) -> String {
        let complaints: Vec<&str> = self.err.lines().filter(|line| !line.contains("the run is not to be relied on")).collect();
        assert_eq!(
            (self.code, complaints.as_slice()),
            (Some(0), [].as_slice()),
            "`moreau {}` printed:\n{}",
            self.words,
            self.out
        );
        self.out
    }

    /// Checks the exit code, that the message has all of `wanted`, and that nothing else was printed.
    #[track_caller]
    pub(crate) fn fails(&self, code: i32, wanted: &[&str]) {
        assert_eq!(self.code, Some(code), "exit code of `moreau {}`, which says:\n{}", self.words, self.err);
        for words in wanted {
            assert!(self.err.contains(words), "`{words}` is not in the message of `moreau {}`:\n{}", self.words, self.err);
        }
        assert!(self.err.starts_with("error: ") && !self.err.contains("panicked"), "{}", self.err);
        assert_eq!(self.out, "", "`moreau {}` printed something", self.words);
    }
}

/// steps.csv without its columns of seconds, which no two runs share.
pub(crate) fn without_seconds(steps_csv: &str) -> Vec<Vec<String>> {
    let header: Vec<&str> = steps_csv.lines().next().unwrap_or_default().split(',').collect();
    let keep = |row: &str| {
        let cells = row.split(',').zip(&header);
        cells.filter(|(_, name)| !name.starts_with("seconds")).map(|(cell, _)| cell.to_owned()).collect()
    };
    steps_csv.lines().map(keep).collect()
}
