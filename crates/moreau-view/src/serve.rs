//! A run as a page that is served to this machine alone.
//!
//! The server listens on the loopback address, and answers only to who knows a token that is drawn anew each time, names the server by that
//! address and does not come from another page. It hands out the page, what there is to know, and blocks of frames as they are asked for;
//! of a run that goes on it also takes orders.

use crate::page;
use crate::recording::{Recording, RecordingError, block};
use crate::report::blocks;
use std::io::Read as _;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tiny_http::{Header, Method, Request, Response, Server};

/// The longest body of a request that is looked at, bytes.
const LONGEST: u64 = 64;

/// A file that grows may be met half-way: so often it is read again, after so long.
const TRIES: u32 = 25;
const BETWEEN: Duration = Duration::from_millis(20);

/// What can be asked of a run that goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Wait before the next step.
    Pause,
    /// Go on.
    Resume,
    /// Take one step and wait again.
    Step,
    /// End as after Ctrl-C.
    Stop,
}

/// What keeps a run from being served.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    /// There is no free port, or no source of chance.
    #[error("cannot listen on {address}: {reason}")]
    Listen {
        /// Where.
        address: SocketAddr,
        /// Why.
        reason: String,
    },
    /// The run cannot be read.
    #[error(transparent)]
    Recording(#[from] RecordingError),
}

/// A server for one run.
pub struct Viewer {
    server: Server,
    address: SocketAddr,
    token: String,
    folder: PathBuf,
    /// Opened with the first request: a run that has just begun has no file yet.
    recording: Option<Recording>,
    /// Whether the run went on when the request at hand came.
    live: bool,
}

impl Viewer {
    /// Listens for the run in a folder; 0 is any free port.
    ///
    /// # Errors
    /// Where the port is taken.
    pub fn listen(folder: &Path, port: u16) -> Result<Self, ServeError> {
        let address = SocketAddr::from((Ipv4Addr::LOCALHOST, port));
        let wrong = |reason: String| ServeError::Listen { address, reason };
        let server = Server::http(address).map_err(|error| wrong(error.to_string()))?;
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes).map_err(|error| wrong(error.to_string()))?;
        let token = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        let address = server.server_addr().to_ip().unwrap_or(address);
        Ok(Self { server, address, token, folder: folder.to_owned(), recording: None, live: false })
    }

    /// Where a browser finds the page. Who knows it can see the run.
    pub fn url(&self) -> String {
        format!("http://{}/{}/", self.address, self.token)
    }

    /// Answers until `stop` is set; `running` says whether the run goes on, `order` gets what is asked of it.
    pub fn serve(&mut self, stop: &AtomicBool, running: &AtomicBool, mut order: impl FnMut(Order)) {
        while !stop.load(Ordering::Relaxed) {
            // A request that fails is the browser's affair.
            if let Ok(Some(request)) = self.server.recv_timeout(Duration::from_millis(100)) {
                self.live = running.load(Ordering::Relaxed);
                let _ = self.answer(request, &mut order);
            }
        }
    }

    fn answer(&mut self, mut request: Request, order: &mut impl FnMut(Order)) -> std::io::Result<()> {
        let (code, kind, body) = match self.route(&mut request, order) {
            Ok((kind, body)) => (200, kind, body),
            Err((code, reason)) => (code, "text/plain; charset=utf-8", reason.into_bytes()),
        };
        let header = |name: &str, value: &str| Header::from_bytes(name, value).ok();
        let mut response = Response::from_data(body).with_status_code(code).with_chunked_threshold(usize::MAX);
        let headers = [
            ("Content-Type", kind),
            ("Cache-Control", "no-store"),
            ("X-Content-Type-Options", "nosniff"),
            ("Referrer-Policy", "no-referrer"),
            ("Cross-Origin-Resource-Policy", "same-origin"),
            ("X-Frame-Options", "DENY"),
        ];
        for header in headers.into_iter().filter_map(|(name, value)| header(name, value)) {
            response.add_header(header);
        }
        request.respond(response)
    }

    /// The kind and bytes of an answer, or a code and a reason.
    fn route(&mut self, request: &mut Request, order: &mut impl FnMut(Order)) -> Result<(&'static str, Vec<u8>), (u16, String)> {
        let nothing = || (404, "there is nothing here".to_owned());
        self.is_ours(request).then_some(()).ok_or_else(nothing)?;
        let path = request.url().strip_prefix('/').and_then(|path| path.strip_prefix(self.token.as_str()));
        let path = path.ok_or_else(nothing)?.to_owned();
        match (request.method(), path.as_str()) {
            (Method::Get, "/") => Ok(("text/html; charset=utf-8", page::served().into_bytes())),
            (Method::Get, "/meta.json") => {
                self.patiently(Self::meta).map(|meta| ("application/json", meta)).map_err(|error| not_now(&error))
            }
            (Method::Get, path) => {
                let number = path.strip_prefix("/block/").and_then(|number| number.parse().ok());
                let number = number.ok_or_else(nothing)?;
                let bytes = self.patiently(|viewer| viewer.block(number)).map_err(|error| not_now(&error))?;
                Ok(("application/octet-stream", bytes.ok_or_else(nothing)?))
            }
            (Method::Post, "/control") if self.live => {
                let mut text = String::new();
                let read = request.as_reader().take(LONGEST).read_to_string(&mut text);
                let known = match (read, text.as_str()) {
                    (Ok(_), "pause") => Order::Pause,
                    (Ok(_), "resume") => Order::Resume,
                    (Ok(_), "step") => Order::Step,
                    (Ok(_), "stop") => Order::Stop,
                    _ => return Err((400, "pause, resume, step or stop is right".to_owned())),
                };
                order(known);
                Ok(("text/plain", Vec::new()))
            }
            _ => Err((405, "this cannot be asked here".to_owned())),
        }
    }

    /// Whether the request names this server by its address, so that no name that leads here serves, and is not another page's.
    fn is_ours(&self, request: &Request) -> bool {
        let value = |name: &'static str| {
            request.headers().iter().find(|header| header.field.equiv(name)).map(|header| header.value.as_str().to_owned())
        };
        let names = [self.address.to_string(), format!("localhost:{}", self.address.port())];
        let origin = value("Origin").is_none_or(|origin| names.iter().any(|name| origin == format!("http://{name}")));
        value("Host").is_some_and(|host| names.contains(&host)) && origin
    }

    /// What can be read, now or in a moment.
    fn patiently<T>(&mut self, read: impl Fn(&mut Self) -> Result<T, RecordingError>) -> Result<T, RecordingError> {
        for _ in 1..TRIES {
            match read(self) {
                Err(_) if self.live => std::thread::sleep(BETWEEN),
                done => return done,
            }
        }
        read(self)
    }

    /// The run as it was when it was looked at last.
    fn recording(&mut self) -> Result<&mut Recording, RecordingError> {
        match &mut self.recording {
            Some(recording) => Ok(recording),
            none => Ok(none.insert(Recording::open(&self.folder)?)),
        }
    }

    fn meta(&mut self) -> Result<Vec<u8>, RecordingError> {
        let live = self.live;
        let recording = self.recording()?;
        recording.renew()?;
        let frames: Vec<usize> = (0..recording.trajectory.frames()).collect();
        Ok(recording.meta(&frames, &blocks(recording, &frames), 1, live).to_string().into_bytes())
    }

    fn block(&mut self, number: usize) -> Result<Option<Vec<u8>>, RecordingError> {
        let recording = self.recording()?;
        recording.renew_frames()?;
        let frames: Vec<usize> = (0..recording.trajectory.frames()).collect();
        let blocks = blocks(recording, &frames);
        let Some(range) = blocks.get(number) else { return Ok(None) };
        Ok(Some(block(&recording.trajectory, &frames[range.clone()])?))
    }
}

/// A run that has just begun has nothing to show yet: the page asks again.
fn not_now(error: &RecordingError) -> (u16, String) {
    (503, error.to_string())
}
