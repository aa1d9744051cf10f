//! A run that is watched while it goes on: frames arrive, orders are taken, and nobody else gets anything.
#![cfg(unix)]

mod common;

use common::{Place, TEN};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

struct Watched {
    child: Child,
    /// 127.0.0.1 and the port.
    address: String,
    token: String,
}

impl Drop for Watched {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Watched {
    fn start(place: &Place, words: &[&str]) -> Self {
        let mut child = place.command(words).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("the program starts");
        let mut line = String::new();
        BufReader::new(child.stdout.as_mut().expect("a pipe")).read_line(&mut line).expect("it says where");
        let url = line.trim().strip_prefix("open http://").unwrap_or_else(|| panic!("{line}"));
        let (address, token) = url.trim_end_matches('/').split_once('/').expect("a token");
        Self { address: address.to_owned(), token: token.to_owned(), child }
    }

    /// Sends a request as it stands, and gives the code and the body.
    fn ask(&self, head: &str, body: &str) -> (u16, Vec<u8>) {
        let mut stream = TcpStream::connect(&self.address).expect("the server listens");
        stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        write!(stream, "{head}\r\nConnection: close\r\nContent-Length: {}\r\n\r\n{body}", body.len()).unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).expect("an answer");
        let end = bytes.windows(4).position(|four| four == b"\r\n\r\n").expect("a head") + 4;
        let code = std::str::from_utf8(&bytes[9..12]).unwrap().parse().unwrap();
        (code, bytes[end..].to_vec())
    }

    fn get(&self, path: &str) -> (u16, Vec<u8>) {
        self.ask(&format!("GET /{}/{path} HTTP/1.1\r\nHost: {}", self.token, self.address), "")
    }

    fn order(&self, word: &str) -> u16 {
        self.ask(
            &format!("POST /{}/control HTTP/1.1\r\nHost: {}\r\nOrigin: http://{}", self.token, self.address, self.address),
            word,
        )
        .0
    }

    /// What is at `path`, as soon as it can be read.
    fn arrives(&self, path: &str) -> Vec<u8> {
        let until = Instant::now() + Duration::from_secs(30);
        loop {
            let (code, body) = self.get(path);
            if code == 200 {
                return body;
            }
            assert!(code == 503 && Instant::now() < until, "{code}: {}", String::from_utf8_lossy(&body));
            std::thread::sleep(Duration::from_millis(100));
        }
    }

    /// What the page would know now.
    fn meta(&self) -> serde_json::Value {
        serde_json::from_slice(&self.arrives("meta.json")).expect("JSON")
    }

    fn frames(&self) -> usize {
        self.meta()["frames"]["step"].as_array().expect("frames").len()
    }

    /// Waits until there are more frames than that.
    fn more_than(&self, frames: usize) -> usize {
        let until = Instant::now() + Duration::from_secs(60);
        loop {
            let now = self.frames();
            if now > frames {
                return now;
            }
            assert!(Instant::now() < until, "no frame after {frames}");
            std::thread::sleep(Duration::from_millis(100));
        }
    }
}

/// Ten balls for hours, a frame each two thousand steps.
const LONG: [&str; 8] =
    ["run", "ten.toml", "--view", "--steps", "1000000000", "--quiet", "--set", "output={kinds=[\"trajectory\"],every=2000}"];

#[test]
fn a_run_is_seen_while_it_goes_on_and_obeys() {
    let place = Place::with("ten.toml", TEN);
    let mut run = Watched::start(&place, &LONG);
    let (code, page) = run.get("");
    assert!(code == 200 && page.starts_with(b"<!doctype html>"));
    let some = run.more_than(1);
    let more = run.more_than(some);
    let meta = run.meta();
    assert_eq!(meta["live"], true);
    let blocks = meta["blocks"].as_array().unwrap().len();
    assert!(more > some && blocks > 0);
    assert!(!run.arrives(&format!("block/{}", blocks - 1)).is_empty());

    assert_eq!(run.order("pause"), 200);
    // What was under way arrives within a pause of the writer.
    std::thread::sleep(Duration::from_secs(3));
    let still = run.frames();
    std::thread::sleep(Duration::from_secs(2));
    assert_eq!(run.frames(), still, "a run that is paused goes on");
    assert_eq!(run.order("step"), 200);
    assert_eq!(run.order("resume"), 200);
    run.more_than(still);
    assert_eq!(run.order("stop"), 200);
    let until = Instant::now() + Duration::from_secs(20);
    let code = loop {
        match run.child.try_wait().unwrap() {
            Some(status) => break status.code(),
            None => assert!(Instant::now() < until, "a run that is stopped goes on"),
        }
        std::thread::sleep(Duration::from_millis(50));
    };
    assert_eq!(code, Some(130), "it ends as after Ctrl-C");
    assert!(place.path("out/ten/summary.json").exists());
}

#[test]
fn nobody_else_gets_anything() {
    let place = Place::with("ten.toml", TEN);
    let run = Watched::start(&place, &LONG);
    run.more_than(0);
    let (address, token) = (run.address.clone(), run.token.clone());
    let port = address.strip_prefix("127.0.0.1:").expect("the loopback address");
    assert_eq!(token.len(), 32);

    let code = |head: &str, body: &str| run.ask(head, body).0;
    let wrong = "0".repeat(32);
    assert_eq!(code(&format!("GET /{wrong}/meta.json HTTP/1.1\r\nHost: {address}"), ""), 404, "another token");
    assert_eq!(code(&format!("GET / HTTP/1.1\r\nHost: {address}"), ""), 404, "no token");
    assert_eq!(code(&format!("GET /{token}/meta.json HTTP/1.1\r\nHost: evil.example:{port}"), ""), 404, "another name");
    let foreign = format!("\r\nHost: {address}\r\nOrigin: http://evil.example");
    assert_eq!(code(&format!("GET /{token}/meta.json HTTP/1.1{foreign}"), ""), 404, "another page");
    assert_eq!(code(&format!("POST /{token}/control HTTP/1.1{foreign}"), "stop"), 404, "another page's order");
    assert_eq!(code(&format!("GET /{token}/../../etc/passwd HTTP/1.1\r\nHost: {address}"), ""), 404);
    assert_eq!(code(&format!("GET /{token}/block/99999999999999999999 HTTP/1.1\r\nHost: {address}"), ""), 404);
    assert_eq!(code(&format!("GET /{token}/block/-1 HTTP/1.1\r\nHost: {address}"), ""), 404);
    assert_eq!(code(&format!("DELETE /{token}/meta.json HTTP/1.1\r\nHost: {address}"), ""), 405);
    assert_eq!(run.order("destroy"), 400);
    assert_eq!(run.order(&"x".repeat(100_000)), 400);
    let mut noise = TcpStream::connect(&address).unwrap();
    noise.write_all(b"\x16\x03\x01 no HTTP at all\r\n\r\n").unwrap();
    drop(noise);
    run.meta();

    // Of all sockets that listen on this port each is bound to 127.0.0.1.
    if let Ok(sockets) = std::fs::read_to_string("/proc/net/tcp") {
        let port = format!(":{:04X}", port.parse::<u16>().unwrap());
        let listens = |line: &&str| line.split_whitespace().nth(3) == Some("0A");
        let bound = sockets.lines().filter(listens).filter_map(|line| line.split_whitespace().nth(1));
        let ours: Vec<&str> = bound.filter(|local| local.ends_with(&port)).collect();
        assert_eq!(ours, [format!("0100007F{port}")]);
    }
}
