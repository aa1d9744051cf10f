//! Clients that mean harm: a run that is watched goes on, answers others, ends in time and computes the same.
#![cfg(unix)]

mod common;

use common::watched::Watched;
use common::{Place, TEN};
use moreau::checkpoint;
use moreau::trajectory::Trajectory;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// Time from the last step, or from Ctrl-C, to the end of the program: a second, and room for a busy machine.
const END: Duration = Duration::from_secs(3);

/// The words of a run of some seconds.
fn words<'a>(out: &'a str, steps: &'a str) -> Vec<&'a str> {
    let output = "output={kinds=[\"trajectory\"],every=2000}";
    vec!["run", "ten.toml", "--quiet", "--threads", "1", "--set", output, "--out", out, "--steps", steps]
}

/// Connects and sends bytes. A server that refuses them has closed the connection, which is no fault.
fn send(run: &Watched, bytes: &[u8]) -> TcpStream {
    let mut stream = TcpStream::connect(&run.address).expect("the server listens");
    stream.set_read_timeout(Some(Duration::from_millis(10))).unwrap();
    stream.set_write_timeout(Some(Duration::from_millis(100))).unwrap();
    let _ = stream.write_all(bytes);
    stream
}

/// Clients that hold on to the server; they stay as long as what is returned.
fn leeches(run: &Watched) -> Vec<TcpStream> {
    let (address, token) = (&run.address, &run.token);
    let mut held = Vec::new();
    for head in ["POST / HTTP/1.1\r\nHost: x".to_owned(), format!("POST /{token}/control HTTP/1.1\r\nHost: {address}")] {
        held.push(send(run, format!("{head}\r\nContent-Length: 1000000000000000\r\n\r\n").as_bytes()));
        held.push(send(run, format!("{head}\r\nContent-Length: 5000\r\n\r\n").as_bytes()));
        held.push(send(run, format!("{head}\r\nContent-Length: 50\r\n\r\n").as_bytes()));
        held.push(send(run, format!("{head}\r\nTransfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n").as_bytes()));
    }
    // A header without end.
    let mut endless = send(run, b"GET / HTTP/1.1\r\nEndless: ");
    (0..200).any(|_| endless.write_all(&[b'x'; 65536]).is_err());
    held.push(endless);
    held.extend((0..100).map(|_| send(run, b"")));
    // Clients that read nothing.
    held.extend((0..4).map(|_| send(run, format!("GET /{token}/ HTTP/1.1\r\nHost: {address}\r\n\r\n").as_bytes())));
    held
}

/// An odd request, and true if it has a right to an answer.
fn odd(random: &mut Pcg64Mcg, run: &Watched) -> (Vec<u8>, bool) {
    let mut one_of = |words: &[&str]| words[random.next_u64() as usize % words.len()].to_owned();
    let long = "x".repeat(40_000);
    let (page, below) = (format!("/{}/", run.token), format!("/{}/control", run.token));
    let ours = format!("Host: {}\r\n", run.address);
    let method = one_of(&["GET", "POST", "HEAD", "CONNECT", "get", "G\0T", "", "\u{fffd}", "POST POST", &long]);
    let target = one_of(&[&page, &below, "/", "*", "", "/\0", "http://evil.example/", "/%00/../..", &format!("/{long}")]);
    let host = one_of(&[
        &ours,
        &ours,
        &ours.repeat(2),
        &format!("{ours}Host: evil.example\r\n"),
        "Host: evil.example\r\n",
        "",
        "Host\0: \0\r\n",
    ]);
    let version = one_of(&["HTTP/1.1", "HTTP/1.1", "HTTP/1.0", "HTTP/2.0", "HTTP/9", ""]);
    let length = one_of(&[
        "",
        "Content-Length: 5\r\n",
        "Content-Length: -1\r\n",
        "Content-Length: 99999999999999999999999\r\n",
        "Content-Length: 5\r\nContent-Length: 6\r\n",
        "Transfer-Encoding: chunked\r\n",
        "Transfer-Encoding: chunked\r\nContent-Length: 3\r\n",
        "Transfer-Encoding: chunked, chunked, gzip\r\n",
        "Expect: 100-continue\r\nContent-Length: 5\r\n",
    ]);
    let body = one_of(&[
        "",
        "x",
        "wrong",
        "5\r\nwrong\r\n0\r\n\r\n",
        "fffffffffffffffff\r\n",
        "-1\r\n",
        "0\r\nTrailer: x\r\n\r\n",
        &long,
    ]);
    let end = one_of(&["\r\n", "\r\n", "\r\n", "\n", "", "\r"]);
    let once = format!("{method} {target} {version}\r\n{host}{length}{end}{body}");
    let times = one_of(&["1", "1", "1", "20"]).parse().unwrap_or(1);
    (once.repeat(times).into_bytes(), target.starts_with(&page) && host == ours)
}

/// Sends an odd request, sometimes in two parts or to leave at once, and reads what is answered.
fn annoy(random: &mut Pcg64Mcg, run: &Watched) {
    let (request, fair) = odd(random, run);
    let (half, mood) = (random.next_u64() as usize % (request.len() + 1), random.next_u64() % 4);
    let mut stream = send(run, &request[..half]);
    if mood == 0 {
        std::thread::sleep(Duration::from_millis(1));
    }
    let _ = stream.write_all(&request[half..]);
    let mut answer = [0; 12];
    if mood < 3 && stream.read_exact(&mut answer).is_ok() {
        assert!(fair || &answer[9..] != b"200", "{}", String::from_utf8_lossy(&request));
    }
}

/// The two runs have the same state at the end, the same frames and the same records of steps.
fn same(place: &Place, one: &str, other: &str) {
    let state = |folder: &str| checkpoint::newest(&place.path(folder)).expect("a checkpoint").0;
    let (ours, theirs) = (state(one), state(other));
    assert_eq!((ours.steps(), ours.state_digest()), (theirs.steps(), theirs.state_digest()), "the state");
    let open = |folder: &str| Trajectory::open(&place.path(&format!("{folder}/trajectory.h5"))).expect("a trajectory");
    let (ours, theirs) = (open(one), open(other));
    assert_eq!(ours.steps(), theirs.steps());
    (0..ours.frames()).for_each(|i| assert!(ours.frame(i).unwrap() == theirs.frame(i).unwrap(), "frame {i}"));
    // The rest of the columns are seconds.
    let numbers = |trajectory: &Trajectory| trajectory.columns().unwrap()[..30].to_vec();
    assert!(numbers(&ours) == numbers(&theirs), "records of steps");
}

#[test]
fn a_run_is_the_same_whatever_its_clients_do() {
    let place = Place::with("ten.toml", TEN);
    let mut alone =
        place.command(&words("alone", "250000")).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
    let mut run = Watched::start(&place, &[words("seen", "250000"), vec!["--view"]].concat());
    let before = run.more_than(0);
    let summary = place.path("seen/summary.json");

    let _held = leeches(&run);
    run.meta();
    let mut random = Pcg64Mcg::seed_from_u64(7);
    for round in 0..10 {
        (0..100).for_each(|_| annoy(&mut random, &run));
        let asked = Instant::now();
        assert_eq!(run.get("").0, 200, "a proper client in round {round}");
        assert!(asked.elapsed() < END, "a proper client waits for {:?}", asked.elapsed());
    }
    assert!(run.frames() > before, "the run goes on");

    let until = Instant::now() + Duration::from_secs(60);
    while !summary.exists() {
        assert!(Instant::now() < until, "the run does not end");
        std::thread::sleep(Duration::from_millis(20));
    }
    let changed = |name: &str| std::fs::metadata(place.path(&format!("seen/{name}"))).unwrap().modified().unwrap();
    let took = changed("summary.json").duration_since(changed("trajectory.h5")).unwrap_or_default();
    assert!(took < END, "{took:?} from the last frame to the summary");
    // The page stays until Ctrl-C, which nobody delays.
    let _more = leeches(&run);
    run.interrupt();
    assert_eq!(run.end(END), Some(0));
    assert!(alone.wait().unwrap().success());
    same(&place, "seen", "alone");
}

#[test]
fn clients_do_not_delay_ctrl_c() {
    let place = Place::with("ten.toml", TEN);
    let mut run = Watched::start(&place, &[words("seen", "1000000000"), vec!["--view"]].concat());
    run.more_than(0);
    let _held = leeches(&run);
    run.interrupt();
    assert_eq!(run.end(END), Some(130));
    assert!(place.path("seen/summary.json").exists());
}
