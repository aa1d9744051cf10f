//! Files that cannot be read or written end the program with code 1 before anything is computed.

mod common;

use common::{Place, TEN};
use std::fs;

#[test]
fn a_scene_file_must_exist() {
    let place = Place::new();
    fs::create_dir(place.path("folder.toml")).unwrap();
    for file in ["none.toml", "no/such/scene.toml", "folder.toml"] {
        let wanted = [&format!("error: {file}: "), "cannot read the scene"];
        for command in ["run", "check", "compare"] {
            place.refuses(&[command, file], 1, &wanted);
        }
    }
}

#[test]
fn a_scene_is_utf8() {
    let place = Place::new();
    place.write("latin1.toml", [TEN.as_bytes(), b"title = \"caf\xe9\"\n"].concat());
    // The bytes can be read; what they say is wrong: this is the scene's fault.
    for command in ["run", "check"] {
        place.refuses(&[command, "latin1.toml"], 3, &["error: latin1.toml", "UTF-8"]);
    }
}

#[test]
fn a_file_in_the_place_of_the_folder_stays() {
    let place = Place::with("ten.toml", TEN);
    place.write("taken", "mine");
    place.write("out", "mine as well");
    place.refuses(&["run", "ten.toml", "--out", "taken"], 1, &["cannot write into taken"]);
    place.refuses(&["run", "ten.toml", "--out", "taken/be/low"], 1, &["cannot write into taken/be/low"]);
    place.refuses(&["run", "ten.toml"], 1, &["cannot write into out/ten"]);
    let words = ["run", "ten.toml", "--set", "output.folder=taken/here"];
    place.refuses(&words, 1, &["cannot write into taken/here"]);
}

/// The folder holds an earlier run, but `taken` is a folder in the place of a file, or the other way round.
#[track_caller]
fn cannot_be_replaced(taken: &str) {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml", "--out", "old"]).fine();
    let path = place.path("old").join(taken);
    if path.is_dir() {
        fs::remove_dir_all(&path).unwrap();
        fs::write(&path, "a file in the place of the folder").unwrap();
    } else {
        fs::remove_file(&path).unwrap();
        fs::create_dir(&path).unwrap();
    }
    place.refuses(&["run", "ten.toml", "--out", "old", "--steps", "3", "--force"], 1, &["cannot write", taken]);
}

#[test]
fn a_file_in_the_place_of_vtk_is_found_before_anything_is_touched() {
    cannot_be_replaced("vtk");
}

#[test]
fn a_folder_in_the_place_of_the_steps_is_found_before_anything_is_touched() {
    cannot_be_replaced("steps.csv");
}

#[test]
fn a_folder_in_the_place_of_the_summary_is_found_before_anything_is_touched() {
    cannot_be_replaced("summary.json");
}

#[test]
fn a_folder_in_the_place_of_the_scene_is_found_before_anything_is_touched() {
    cannot_be_replaced("scene.toml");
}

#[cfg(unix)]
#[test]
fn a_folder_without_permission_stays_empty() {
    use std::os::unix::fs::PermissionsExt;
    let place = Place::with("ten.toml", TEN);
    let folder = place.path("locked");
    fs::create_dir(&folder).unwrap();
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o555)).unwrap();
    // Permissions do not bind the superuser.
    if fs::write(folder.join("probe"), "").is_ok() {
        return;
    }
    for out in ["locked", "locked/new"] {
        place.refuses(&["run", "ten.toml", "--out", out], 1, &["cannot write", "locked"]);
    }
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o755)).unwrap();
}

#[test]
fn a_run_never_overwrites_the_scene_that_it_reads() {
    // The folder's scene.toml is the scene with all defaults, without the comments of the one who wrote it.
    let place = Place::with("scene.toml", &format!("# Mine, with a remark.\n{TEN}"));
    place.refuses(&["run", "scene.toml", "--out", "."], 1, &["cannot write into .: it holds scene.toml"]);
    assert!(place.read("scene.toml").starts_with("# Mine, with a remark."), "the scene was overwritten");
}

#[test]
fn compare_asks_for_its_files_before_it_computes() {
    let place = Place::with("ten.toml", TEN);
    for option in ["--csv", "--plot"] {
        // A table on the standard output would show that all was computed first; `fails` wants none.
        let words = ["compare", "ten.toml", "--local", "pdas", option, "no/such/file"];
        place.refuses(&words, 1, &["cannot write no/such/file"]);
    }
}

#[test]
fn messages_do_not_name_files_that_the_program_made_up() {
    let place = Place::with("ten.toml", TEN);
    for words in [&["compare", "ten.toml", "--local", "pdas", "--csv", "no/such/file"][..], &["new", "no/such/scene"]] {
        let ran = place.moreau(words);
        assert_eq!(ran.code, Some(1), "{ran:?}");
        assert!(ran.err.contains("cannot write no/such") && !ran.err.contains("/.moreau"), "{}", ran.err);
    }
}
