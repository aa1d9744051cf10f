//! A run that is watched while it goes on: frames arrive, orders are taken, and nobody else gets anything.
#![cfg(unix)]

mod common;

use common::watched::Watched;
use common::{Place, TEN};
use std::io::Write;
use std::net::TcpStream;
use std::time::Duration;

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
    let code = run.end(Duration::from_secs(20));
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
    let twice = format!("GET /{token}/meta.json HTTP/1.1\r\nHost: {address}\r\nHost: {address}");
    assert_eq!(code(&twice, ""), 404, "two names");
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
