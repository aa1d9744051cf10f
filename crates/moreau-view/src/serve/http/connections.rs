//! Clients that are connected: a bounded number, so that many of them cannot take the file descriptors that the run needs.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tokio::task::{AbortHandle, JoinHandle};

/// Connections, oldest first.
pub(super) struct Connections {
    most: usize,
    connections: VecDeque<Connection>,
}

struct Connection {
    task: AbortHandle,
    /// True while an admitted request is answered.
    answering: Arc<AtomicBool>,
}

impl Connection {
    fn answers(&self) -> bool {
        self.answering.load(Ordering::Relaxed)
    }
}

impl Connections {
    /// Room for at most so many.
    pub(super) fn new(most: usize) -> Self {
        Self { most, connections: VecDeque::new() }
    }

    /// Adds one. A new client always gets in: if there are too many, the oldest that was not admitted is closed, or else the oldest.
    pub(super) fn add(&mut self, spawn: impl FnOnce(Arc<AtomicBool>) -> JoinHandle<()>) {
        self.connections.retain(|connection| !connection.task.is_finished());
        if self.connections.len() >= self.most {
            let oldest = self.connections.iter().position(|connection| !connection.answers()).unwrap_or(0);
            if let Some(connection) = self.connections.remove(oldest) {
                connection.task.abort();
            }
        }
        let answering = Arc::new(AtomicBool::new(false));
        let task = spawn(answering.clone()).abort_handle();
        self.connections.push_back(Connection { task, answering });
    }

    /// Returns true while any client waits for the answer to an admitted request.
    pub(super) fn answering(&self) -> bool {
        self.connections.iter().any(|connection| !connection.task.is_finished() && connection.answers())
    }
}
