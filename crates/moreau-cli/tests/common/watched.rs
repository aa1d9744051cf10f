//! A run with `--view`, and its client.

use super::Place;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A run that is watched, and does not outlive its test.
pub(crate) struct Watched {
    pub(crate) child: Child,
    /// 127.0.0.1 and the port.
    pub(crate) address: String,
    pub(crate) token: String,
}

impl Drop for Watched {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Watched {
    /// Starts the program and reads the address that it prints.
    pub(crate) fn start(place: &Place, words: &[&str]) -> Self {
        let mut child = place.command(words).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("the program starts");
        let mut line = String::new();
        BufReader::new(child.stdout.as_mut().expect("a pipe")).read_line(&mut line).expect("it says where");
        let url = line.trim().strip_prefix("open http://").unwrap_or_else(|| panic!("{line}"));
        let (address, token) = url.trim_end_matches('/').split_once('/').expect("a token");
        Self { address: address.to_owned(), token: token.to_owned(), child }
    }

    /// Sends a request as it stands, and gives the code and the body.
    pub(crate) fn ask(&self, head: &str, body: &str) -> (u16, Vec<u8>) {
        let mut stream = TcpStream::connect(&self.address).expect("the server listens");
        stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        write!(stream, "{head}\r\nConnection: close\r\nContent-Length: {}\r\n\r\n{body}", body.len()).unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).expect("an answer");
        let end = bytes.windows(4).position(|four| four == b"\r\n\r\n").expect("a head") + 4;
        let code = std::str::from_utf8(&bytes[9..12]).unwrap().parse().unwrap();
        (code, bytes[end..].to_vec())
    }

    /// Asks for a path below the token.
    pub(crate) fn get(&self, path: &str) -> (u16, Vec<u8>) {
        self.ask(&format!("GET /{}/{path} HTTP/1.1\r\nHost: {}", self.token, self.address), "")
    }

    /// Sends an order and returns the code of the answer.
    pub(crate) fn order(&self, word: &str) -> u16 {
        self.ask(
            &format!("POST /{}/control HTTP/1.1\r\nHost: {}\r\nOrigin: http://{}", self.token, self.address, self.address),
            word,
        )
        .0
    }

    /// What is at `path`, as soon as it can be read.
    pub(crate) fn arrives(&self, path: &str) -> Vec<u8> {
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
    pub(crate) fn meta(&self) -> serde_json::Value {
        serde_json::from_slice(&self.arrives("meta.json")).expect("JSON")
    }

    /// Returns the number of frames.
    pub(crate) fn frames(&self) -> usize {
        self.meta()["frames"]["step"].as_array().expect("frames").len()
    }

    /// Waits until there are more frames than that.
    pub(crate) fn more_than(&self, frames: usize) -> usize {
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

    /// Sends SIGINT, as a terminal does on Ctrl-C.
    pub(crate) fn interrupt(&self) {
        let status = Command::new("sh").args(["-c", "kill -INT \"$0\"", &self.child.id().to_string()]).status().expect("sh");
        assert!(status.success(), "the program ended before it was interrupted");
    }

    /// Waits for the end, at most so long, and returns the exit code.
    pub(crate) fn end(&mut self, most: Duration) -> Option<i32> {
        let until = Instant::now() + most;
        loop {
            if let Some(status) = self.child.try_wait().expect("the child is there") {
                return status.code();
            }
            assert!(Instant::now() < until, "a run that is stopped goes on");
            std::thread::sleep(Duration::from_millis(10));
        }
    }
}
