//! Who is answered, and with what.

use super::Order;
use super::frames::Frames;
use super::http::{Answer, Answers, Head};
use crate::page;
use crate::recording::RecordingError;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

const NOTHING: &str = "there is nothing here";

/// The page of one run, and all that belongs to it.
pub(super) struct Site {
    /// Values of `Host` that name this server.
    names: [String; 2],
    token: String,
    frames: Frames,
    /// True while the run goes on.
    live: AtomicBool,
    order: Box<dyn Fn(Order) + Send + Sync>,
}

impl Site {
    pub(super) fn new(
        address: SocketAddr,
        token: String,
        folder: PathBuf,
        live: bool,
        order: Box<dyn Fn(Order) + Send + Sync>,
    ) -> Self {
        let names = [address.to_string(), format!("localhost:{}", address.port())];
        Self { names, token, frames: Frames::new(folder), live: AtomicBool::new(live), order }
    }

    /// From now on the run is over.
    pub(super) fn run_is_over(&self) {
        self.live.store(false, Ordering::Relaxed);
    }

    /// Returns the part of the target after the token, or nothing without the right token.
    fn path<'a>(&self, head: &'a Head) -> Option<&'a str> {
        head.target.strip_prefix('/')?.strip_prefix(self.token.as_str())
    }

    /// Returns true if the request names this server, exactly once. A name that only leads to this address does not count: another page
    /// could use it.
    fn is_named(&self, head: &Head) -> bool {
        matches!(head.values("host").as_slice(), [host] if self.names.iter().any(|name| *host == name.as_bytes()))
    }

    /// Returns true if no other page sent the request.
    fn is_own(&self, head: &Head) -> bool {
        match head.values("origin").as_slice() {
            [] => true,
            [origin] => self.names.iter().any(|name| *origin == format!("http://{name}").as_bytes()),
            _ => false,
        }
    }

    fn get(&self, path: &str) -> Answer {
        let live = self.live.load(Ordering::Relaxed);
        match path {
            "/" => Answer::new("text/html; charset=utf-8", page::served().into_bytes()),
            "/meta.json" => {
                self.frames.meta(live).map_or_else(|error| not_now(&error), |meta| Answer::new("application/json", meta))
            }
            path => {
                let Some(number) = path.strip_prefix("/block/").and_then(|number| number.parse().ok()) else {
                    return Answer::text(404, NOTHING);
                };
                match self.frames.block(number, live) {
                    Ok(Some(bytes)) => Answer::new("application/octet-stream", bytes),
                    Ok(None) => Answer::text(404, NOTHING),
                    Err(error) => not_now(&error),
                }
            }
        }
    }

    fn control(&self, word: &[u8]) -> Answer {
        let order = match word {
            b"pause" => Order::Pause,
            b"resume" => Order::Resume,
            b"step" => Order::Step,
            b"stop" => Order::Stop,
            _ => return Answer::text(400, "pause, resume, step or stop is right"),
        };
        (self.order)(order);
        Answer::text(200, "")
    }
}

impl Answers for Site {
    fn admits(&self, head: &Head) -> bool {
        self.is_named(head) && self.is_own(head) && self.path(head).is_some()
    }

    fn refusal(&self) -> Answer {
        Answer::text(404, NOTHING)
    }

    fn answer(&self, head: &Head, body: &[u8]) -> Answer {
        match (head.method.as_str(), self.path(head)) {
            (_, None) => self.refusal(),
            ("GET", Some(path)) => self.get(path),
            ("POST", Some("/control")) if self.live.load(Ordering::Relaxed) => self.control(body),
            _ => Answer::text(405, "this cannot be asked here"),
        }
    }
}

/// A run that has just begun has nothing to show yet: the page asks again.
fn not_now(error: &RecordingError) -> Answer {
    Answer::text(503, error.to_string())
}
