//! Wrong overrides end the program with code 3, other wrong words with code 2, before anything is computed.

mod common;

use common::{Place, TEN};

#[test]
fn overrides_are_as_strict_as_the_file() {
    let place = Place::with("ten.toml", TEN);
    let cases = [
        ("solver.tolernce=1e-9", &["unknown key `tolernce`", "did you mean `tolerance`?", "1 | solver.tolernce=1e-9"][..]),
        ("solver.tolerance", &["an override without `=`", "write it as key.path=value"]),
        ("time.steps=many", &["time.steps: found string \"many\"", "expected a whole number"]),
        ("time.step=nan", &["expected a finite number"]),
        ("generate.0.count=-1", &["expected a whole number, 0 or more"]),
    ];
    for (set, wanted) in cases {
        for command in ["run", "check", "compare"] {
            let place_of_it = "error: --set:1:";
            place.refuses(&[command, "ten.toml", "--set", set], 3, &[&[place_of_it], wanted].concat());
        }
    }
    place.refuses(&["run", "ten.toml", "--steps", "0"], 3, &["0 steps", "expected 1 step or more"]);
}

#[test]
fn wrong_words_are_named() {
    let place = Place::with("ten.toml", TEN);
    let cases = [
        (&["compare", "ten.toml", "--local", "nonsense"][..], &["'nonsense'", "no such local solver", "moreau list local"][..]),
        (&["compare", "ten.toml", "--local", "pdas,nonsense"], &["'nonsense'", "no such local solver"]),
        (&["compare", "ten.toml", "--global", "nonsense"], &["'nonsense'", "no such global solver", "moreau list global"]),
        (&["compare", "ten.toml", "--repeat", "0"], &["'0'", "--repeat"]),
        (&["run", "ten.toml", "--threads", "0"], &["'0'", "--threads", "1..=1024"]),
        (&["run", "ten.toml", "--steps", "few"], &["'few'", "--steps"]),
        (&["run"], &["<SCENE>"]),
        (&["run", "ten.toml", "--thread", "2"], &["'--thread'", "'--threads'"]),
        (&["chek", "ten.toml"], &["'chek'", "'check'"]),
        (&["list", "nonsense"], &["'nonsense'", "local"]),
        (&["new", ""], &["needs a name"]),
    ];
    for (words, wanted) in cases {
        place.refuses(words, 2, wanted);
    }
}
