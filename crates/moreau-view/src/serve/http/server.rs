//! The thread that serves, from its beginning to its end.

use super::connection::connection;
use super::connections::Connections;
use super::{Answers, Limits};
use std::net::TcpListener;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;
use tokio::sync::Semaphore;
use tokio::time::{Instant, sleep, timeout};

/// Number of threads that make answers.
const WORKERS: usize = 4;
/// Time between two checks whether the server must end, and between two attempts to accept a client where the system refuses.
const PAUSE: Duration = Duration::from_millis(50);
/// Time that answers under way have when the server ends: that to an order to stop should arrive.
const LAST: Duration = Duration::from_millis(300);

/// A server in a thread of its own, which ends when this is dropped: within a second, whatever clients and answers do.
pub(in super::super) struct Server {
    end: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Server {
    /// Answers the clients of a listener.
    ///
    /// # Errors
    /// If the system has no thread or file descriptor left.
    pub(in super::super) fn start(listener: TcpListener, site: Arc<dyn Answers>, limits: Limits) -> std::io::Result<Self> {
        listener.set_nonblocking(true)?;
        let mut builder = tokio::runtime::Builder::new_current_thread();
        let runtime = builder.enable_io().enable_time().max_blocking_threads(WORKERS).thread_name("viewer").build()?;
        let listener = {
            let _guard = runtime.enter();
            tokio::net::TcpListener::from_std(listener)?
        };
        let end = Arc::new(AtomicBool::new(false));
        let ends = end.clone();
        let shared = Shared { site, limits, workers: Arc::new(Semaphore::new(WORKERS)) };
        let thread = std::thread::Builder::new().name("viewer".to_owned()).spawn(move || {
            runtime.block_on(accept(&listener, &shared, &ends));
            // An answer that is still being made is left to itself.
            runtime.shutdown_timeout(PAUSE);
        })?;
        Ok(Self { end, thread: Some(thread) })
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.end.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            // Its own panic is no reason to fail here.
            let _ = thread.join();
        }
    }
}

/// What connections share.
#[derive(Clone)]
pub(super) struct Shared {
    pub(super) site: Arc<dyn Answers>,
    pub(super) limits: Limits,
    /// A turn for each worker. A client that leaves gives up its place in the queue.
    pub(super) workers: Arc<Semaphore>,
}

async fn accept(listener: &tokio::net::TcpListener, shared: &Shared, end: &AtomicBool) {
    let mut connections = Connections::new(shared.limits.connections);
    while !end.load(Ordering::Relaxed) {
        match timeout(PAUSE, listener.accept()).await {
            Ok(Ok((stream, _))) => connections.add(|answering| tokio::spawn(connection(stream, shared.clone(), answering))),
            // The system has no file descriptor left, for example.
            Ok(Err(_)) => sleep(PAUSE).await,
            Err(_) => {}
        }
    }
    let until = Instant::now() + LAST;
    while connections.answering() && Instant::now() < until {
        sleep(PAUSE / 5).await;
    }
}
