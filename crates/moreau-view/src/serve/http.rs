//! HTTP/1.1 by hyper: the only place that knows the library.
//!
//! A client is not trusted. One thread reads and writes for all connections, each with [`Limits`]; a few more threads make answers. A
//! connection carries one request. `docs/dependencies.md` says why hyper.

mod connection;
mod connections;
mod server;
#[cfg(test)]
mod tests;

use http_body_util::Full;
use hyper::body::Bytes;
use hyper::header::{CACHE_CONTROL, CONTENT_TYPE, HeaderValue, REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS, X_FRAME_OPTIONS};
use hyper::{Response, StatusCode};
pub(super) use server::Server;
use std::time::Duration;

/// What a client may use.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    /// Number of connections at the same time. For one more, the oldest is closed.
    pub(super) connections: usize,
    /// Bytes of a head: request line and headers; at least 8192.
    pub(super) head: usize,
    /// Number of headers.
    pub(super) headers: usize,
    /// Bytes of a body.
    pub(super) body: usize,
    /// Time in which a head must be complete, and then the body.
    pub(super) time: Duration,
    /// Time of a connection from beginning to end.
    pub(super) whole: Duration,
}

impl Default for Limits {
    fn default() -> Self {
        let (time, whole) = (Duration::from_secs(5), Duration::from_secs(60));
        Self { connections: 32, head: 16 << 10, headers: 64, body: 64, time, whole }
    }
}

/// The head of a request.
pub(super) struct Head {
    pub(super) method: String,
    /// The target as the client sent it.
    pub(super) target: String,
    headers: hyper::HeaderMap,
}

impl Head {
    /// Returns all values of a header, whose name is in lower case.
    pub(super) fn values(&self, name: &str) -> Vec<&[u8]> {
        self.headers.get_all(name).iter().map(HeaderValue::as_bytes).collect()
    }
}

/// An answer to a request.
pub(super) struct Answer {
    code: u16,
    kind: &'static str,
    body: Vec<u8>,
}

impl Answer {
    /// What was asked for, with its media type.
    pub(super) fn new(kind: &'static str, body: Vec<u8>) -> Self {
        Self { code: 200, kind, body }
    }

    /// A code with a sentence.
    pub(super) fn text(code: u16, text: impl Into<String>) -> Self {
        Self { code, kind: "text/plain; charset=utf-8", body: text.into().into_bytes() }
    }

    fn response(self) -> Response<Full<Bytes>> {
        let mut response = Response::new(Full::new(Bytes::from(self.body)));
        *response.status_mut() = StatusCode::from_u16(self.code).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let headers = response.headers_mut();
        headers.insert(CONTENT_TYPE, HeaderValue::from_static(self.kind));
        headers.insert(CACHE_CONTROL, HeaderValue::from_static("no-store"));
        headers.insert(X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff"));
        headers.insert(REFERRER_POLICY, HeaderValue::from_static("no-referrer"));
        headers.insert("cross-origin-resource-policy", HeaderValue::from_static("same-origin"));
        headers.insert(X_FRAME_OPTIONS, HeaderValue::from_static("DENY"));
        response
    }
}

/// What is served.
pub(super) trait Answers: Send + Sync + 'static {
    /// Returns true if the request has a right to an answer. No body is read before; it must not wait.
    fn admits(&self, head: &Head) -> bool;
    /// Returns the answer to a request that is not admitted.
    fn refusal(&self) -> Answer;
    /// Returns the answer to a request that is. It may take its time, and a panic costs this answer alone.
    fn answer(&self, head: &Head, body: &[u8]) -> Answer;
}
