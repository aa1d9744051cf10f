//! One client: a request, its answer, and the end.

use super::server::Shared;
use super::{Answer, Head, Limits};
use http_body_util::{BodyExt as _, Full, Limited};
use hyper::body::{Body as _, Bytes, Incoming};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper::{Request, Response};
use hyper_util::rt::{TokioIo, TokioTimer};
use std::convert::Infallible;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;
use tokio::time::timeout;

/// Bytes that are read and forgotten after an answer, and the time for it.
const LEFTOVER: usize = 1 << 20;
const LEFTOVER_TIME: Duration = Duration::from_secs(1);

/// Answers one client. `answering` is true between its admission and its answer.
pub(super) async fn connection(stream: TcpStream, shared: Shared, answering: Arc<AtomicBool>) {
    let Limits { head, headers, time, whole, .. } = shared.limits;
    let _ = stream.set_nodelay(true);
    let mut builder = http1::Builder::new();
    builder.timer(TokioTimer::new()).header_read_timeout(time).max_header_size(head).max_buf_size(head).max_headers(headers);
    builder.keep_alive(false).half_close(true);
    let service = service_fn(|request| respond(request, &shared, &answering));
    let served = timeout(whole, builder.serve_connection(TokioIo::new(stream), service).without_shutdown()).await;
    answering.store(false, Ordering::Relaxed);
    if let Ok(Ok(parts)) = served {
        let _ = timeout(LEFTOVER_TIME, close(parts.io.into_inner())).await;
    }
}

/// Closes a connection. What its client still sends is read first: otherwise the system would reset the connection, and the client could
/// lose the answer.
async fn close(mut stream: TcpStream) -> std::io::Result<()> {
    stream.shutdown().await?;
    let (mut bytes, mut left) = ([0; 4096], LEFTOVER);
    while left > 0 {
        match stream.read(&mut bytes).await? {
            0 => break,
            read => left = left.saturating_sub(read),
        }
    }
    Ok(())
}

async fn respond(
    request: Request<Incoming>,
    shared: &Shared,
    answering: &AtomicBool,
) -> Result<Response<Full<Bytes>>, Infallible> {
    let (parts, body) = request.into_parts();
    let head = Head { method: parts.method.to_string(), target: parts.uri.to_string(), headers: parts.headers };
    if !shared.site.admits(&head) {
        return Ok(shared.site.refusal().response());
    }
    answering.store(true, Ordering::Relaxed);
    let answer = match read(body, shared.limits).await {
        Ok(body) => answer(head, body, shared).await,
        Err(refusal) => refusal,
    };
    Ok(answer.response())
}

async fn read(body: Incoming, limits: Limits) -> Result<Bytes, Answer> {
    let wrong = || Answer::text(400, format!("a body of at most {} bytes is right", limits.body));
    if body.size_hint().lower() > limits.body as u64 {
        return Err(wrong());
    }
    match timeout(limits.time, Limited::new(body, limits.body).collect()).await {
        Ok(Ok(body)) => Ok(body.to_bytes()),
        Ok(Err(_)) => Err(wrong()),
        Err(_) => Err(Answer::text(408, "the body did not arrive in time")),
    }
}

/// Makes an answer in a thread where it may take its time.
async fn answer(head: Head, body: Bytes, shared: &Shared) -> Answer {
    let failed = || Answer::text(500, "the answer failed");
    let Ok(turn) = shared.workers.clone().acquire_owned().await else { return failed() };
    let site = shared.site.clone();
    let made = tokio::task::spawn_blocking(move || {
        let _turn = turn;
        site.answer(&head, &body)
    });
    made.await.unwrap_or_else(|_| failed())
}
