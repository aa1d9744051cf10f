//! Clients that mean harm, and answers that fail.

use super::{Answer, Answers, Head, Limits, Server};
use std::io::{Read as _, Write as _};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Panics, is slow, or answers much, as it is asked to.
struct Moody;

impl Answers for Moody {
    fn admits(&self, head: &Head) -> bool {
        head.target != "/forbidden"
    }

    fn refusal(&self) -> Answer {
        Answer::text(404, "")
    }

    fn answer(&self, head: &Head, body: &[u8]) -> Answer {
        match head.target.as_str() {
            "/panic" => panic!("as it was asked to"),
            "/slow" => std::thread::sleep(Duration::from_secs(20)),
            "/much" => return Answer::new("text/plain", vec![0; 64 << 20]),
            _ => {}
        }
        Answer::text(200, String::from_utf8_lossy(body))
    }
}

fn serve(limits: Limits) -> (Server, SocketAddr) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    (Server::start(listener, Arc::new(Moody), limits).unwrap(), address)
}

fn short() -> Limits {
    Limits { connections: 4, time: Duration::from_millis(200), whole: Duration::from_millis(800), ..Limits::default() }
}

fn send(address: SocketAddr, bytes: &str) -> TcpStream {
    let mut stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(10))).unwrap();
    stream.write_all(bytes.as_bytes()).unwrap();
    stream
}

/// Returns the code of the answer, or 0 if the connection is closed without one.
fn code(mut stream: TcpStream) -> u16 {
    let mut bytes = Vec::new();
    let _ = stream.read_to_end(&mut bytes);
    bytes.get(9..12).and_then(|code| std::str::from_utf8(code).ok()?.parse().ok()).unwrap_or(0)
}

fn get(address: SocketAddr, path: &str) -> u16 {
    code(send(address, &format!("GET {path} HTTP/1.1\r\nHost: x\r\n\r\n")))
}

#[test]
fn a_panic_costs_its_own_answer() {
    let (_server, address) = serve(Limits::default());
    for _ in 0..8 {
        assert_eq!((get(address, "/panic"), get(address, "/")), (500, 200));
    }
}

#[test]
fn requests_have_limits() {
    let (_server, address) = serve(short());
    let ask = |request: &str| code(send(address, request));
    assert_eq!(ask("POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 4\r\n\r\nstop"), 200);
    assert_eq!(ask("POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 1000000000000000\r\n\r\n"), 400, "a large body");
    assert_eq!(ask("POST /forbidden HTTP/1.1\r\nHost: x\r\nContent-Length: 5000\r\n\r\n"), 404, "no body is read from strangers");
    assert_eq!(ask("POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 50\r\n\r\n"), 408, "a body that does not come");
    let chunk = format!("41\r\n{}\r\n0\r\n\r\n", "x".repeat(65));
    assert_eq!(ask(&format!("POST / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n{chunk}")), 400, "a large chunk");
    assert_eq!(ask(&format!("GET / HTTP/1.1\r\nHost: x\r\nLong: {}\r\n\r\n", "x".repeat(15 << 10))), 200);
    assert_eq!(ask(&format!("GET / HTTP/1.1\r\nHost: x\r\nLong: {}\r\n\r\n", "x".repeat(17 << 10))), 431, "a long header");
    assert_eq!(ask(&format!("GET / HTTP/1.1\r\nHost: x\r\n{}\r\n", "A: b\r\n".repeat(64))), 431, "many headers");
    assert_eq!(ask("GET / HTTP/1.1\r\nHost: x\r\nHalf"), 0, "a head that does not end");
}

#[test]
fn a_new_client_always_gets_in() {
    let (_server, address) = serve(Limits { time: Duration::from_secs(60), whole: Duration::from_secs(60), ..short() });
    let _much: Vec<TcpStream> = (0..6).map(|_| send(address, "GET /much HTTP/1.1\r\nHost: x\r\n\r\n")).collect();
    let _silent: Vec<TcpStream> = (0..20).map(|_| send(address, "")).collect();
    let begin = Instant::now();
    assert_eq!(get(address, "/"), 200);
    assert!(begin.elapsed() < Duration::from_secs(10));
}

#[test]
fn a_server_ends_whatever_its_clients_do() {
    let (server, address) = serve(Limits::default());
    let requests = ["", "GET / HT", "GET /slow HTTP/1.1\r\nHost: x\r\n\r\n", "GET /much HTTP/1.1\r\nHost: x\r\n\r\n"];
    let _clients = requests.map(|request| send(address, request));
    std::thread::sleep(Duration::from_millis(200));
    let begin = Instant::now();
    drop(server);
    assert!(begin.elapsed() < Duration::from_secs(2), "{:?}", begin.elapsed());
    assert!(TcpStream::connect(address).is_err());
}
