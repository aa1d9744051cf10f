//! A thread that writes what a run hands over, while the run goes on.
//!
//! Things are written in the order in which they are given, and at most [`WAITING`] of them wait: whoever gives one more waits until
//! there is room, so that a slow disk slows the run down and does not fill the memory.

#[cfg(test)]
mod tests;

use super::OutputError;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::thread::{Builder, JoinHandle};
use std::time::Duration;

/// How many things may wait, besides the one that is being written.
pub(super) const WAITING: usize = 1;

/// After so long without work a writer is told that it has a pause.
const PAUSE: Duration = Duration::from_millis(500);

/// Who writes on the thread.
pub(super) trait Writer<T>: Send + 'static {
    /// Writes one thing.
    fn write(&mut self, thing: &T) -> Result<(), OutputError>;

    /// Writes what can be put off: called when there is nothing to do, and at the end, also after an error.
    fn catch_up(&mut self) -> Result<(), OutputError>;

    /// As [`Self::catch_up`], and asks the disk to keep it.
    fn sync(&mut self) -> Result<(), OutputError> {
        self.catch_up()
    }
}

/// What the thread is asked for.
enum Order<T> {
    Write(T),
    /// To have all before on the disk, and say so.
    Sync(Sender<()>),
}

/// The thread, as the run sees it. It ends with the first error, or when this is finished or dropped, after all that was given.
#[derive(Debug)]
pub(super) struct Background<T> {
    give: Option<SyncSender<Order<T>>>,
    back: Receiver<T>,
    thread: Option<JoinHandle<Result<(), OutputError>>>,
}

impl<T: Send + 'static> Background<T> {
    /// Starts it.
    ///
    /// # Errors
    /// Where the system has no thread to give.
    pub(super) fn start(writer: impl Writer<T>) -> std::io::Result<Self> {
        let (give, things) = sync_channel(WAITING);
        let (done, back) = channel();
        let thread = Builder::new().name("output".to_owned()).spawn(move || work(writer, &things, &done))?;
        Ok(Self { give: Some(give), back, thread: Some(thread) })
    }

    /// Something that was written and may be filled anew.
    pub(super) fn used(&self) -> Option<T> {
        self.back.try_recv().ok()
    }

    /// Hands one thing over, and waits for room.
    ///
    /// # Errors
    /// Where something given before could not be written; this is told once.
    pub(super) fn give(&mut self, thing: T) -> Result<(), OutputError> {
        match &self.give {
            Some(give) if give.send(Order::Write(thing)).is_ok() => Ok(()),
            _ => self.finish(),
        }
    }

    /// Waits until all that was given is on the disk.
    ///
    /// # Errors
    /// As for [`Self::give`].
    pub(super) fn sync(&mut self) -> Result<(), OutputError> {
        let (done, wait) = channel();
        let asked = self.give.as_ref().is_some_and(|give| give.send(Order::Sync(done)).is_ok());
        // It does not answer where it ended, which is an error.
        if asked && wait.recv().is_ok() { Ok(()) } else { self.finish() }
    }

    /// Whether all went well so far; does not wait.
    ///
    /// # Errors
    /// As for [`Self::give`].
    pub(super) fn check(&mut self) -> Result<(), OutputError> {
        if self.thread.as_ref().is_some_and(JoinHandle::is_finished) { self.finish() } else { Ok(()) }
    }

    /// Waits until all is written.
    ///
    /// # Errors
    /// As for [`Self::give`].
    pub(super) fn finish(&mut self) -> Result<(), OutputError> {
        self.give = None;
        let ended = self.thread.take().map_or(Ok(Ok(())), JoinHandle::join);
        // A panic over there is one here, as if there were no thread.
        ended.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    }
}

/// All that the thread does. What was written goes back, for its memory.
fn work<T>(mut writer: impl Writer<T>, things: &Receiver<Order<T>>, done: &Sender<T>) -> Result<(), OutputError> {
    let mut next = || match things.recv_timeout(PAUSE) {
        Ok(Order::Sync(done)) => {
            writer.sync()?;
            // Nobody waits for it where the run is over.
            let _ = done.send(());
            Ok(true)
        }
        Ok(Order::Write(thing)) => {
            writer.write(&thing)?;
            // Nobody takes it back where the run is over.
            let _ = done.send(thing);
            Ok(true)
        }
        Err(RecvTimeoutError::Timeout) => writer.catch_up().map(|()| true),
        Err(RecvTimeoutError::Disconnected) => Ok(false),
    };
    let written = loop {
        match next() {
            Ok(true) => {}
            Ok(false) => break Ok(()),
            Err(error) => break Err(error),
        }
    };
    let caught_up = writer.catch_up();
    written.and(caught_up)
}

impl<T> Drop for Background<T> {
    /// Waits for the thread, so that nothing is written once this is gone.
    fn drop(&mut self) {
        self.give = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
