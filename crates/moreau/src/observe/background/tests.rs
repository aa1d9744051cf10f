//! The order of things, the bound on what waits, and errors.

use super::*;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

/// Writes numbers into a list, each when it is let, and cannot write 7.
struct Slow {
    let_one: Receiver<()>,
    list: Arc<Mutex<Vec<u64>>>,
}

impl Writer<u64> for Slow {
    fn write(&mut self, thing: &u64) -> Result<(), OutputError> {
        let _ = self.let_one.recv();
        self.list.lock().unwrap().push(*thing);
        let full = || OutputError::io("disk".as_ref())(std::io::Error::other("full"));
        if *thing == 7 { Err(full()) } else { Ok(()) }
    }

    fn catch_up(&mut self) -> Result<(), OutputError> {
        Ok(())
    }
}

type Started = (Background<u64>, Sender<()>, Arc<Mutex<Vec<u64>>>);

fn start() -> Started {
    let (go, let_one) = channel();
    let list = Arc::default();
    let writer = Slow { let_one, list: Arc::clone(&list) };
    (Background::start(writer).unwrap(), go, list)
}

#[test]
fn a_slow_writer_slows_the_giver_down() {
    let (mut background, go, list) = start();
    let given = AtomicU64::new(0);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            for i in 10..30 {
                background.give(i).unwrap();
                given.store(i - 9, Ordering::SeqCst);
            }
        });
        for written in 0..20_u64 {
            // Given are those written, the one at hand, those that wait, however long one looks.
            std::thread::sleep(Duration::from_millis(5));
            assert!(given.load(Ordering::SeqCst) <= written + 1 + WAITING as u64);
            go.send(()).unwrap();
        }
    });
    background.finish().unwrap();
    assert_eq!(*list.lock().unwrap(), (10..30).collect::<Vec<_>>());
    assert!(background.used().is_some_and(|first| first == 10));
}

#[test]
fn an_error_ends_it_and_is_told_once() {
    let (mut background, go, list) = start();
    drop(go);
    let error = loop {
        if let Err(error) = background.give(7).and_then(|()| background.check()) {
            break error;
        }
    };
    assert_eq!(error.to_string(), "cannot write disk: full");
    background.give(8).unwrap();
    background.check().unwrap();
    background.finish().unwrap();
    assert_eq!(*list.lock().unwrap(), [7], "nothing after the error");
}

#[test]
fn what_was_given_is_written_where_it_is_dropped() {
    let (mut background, go, list) = start();
    drop(go);
    background.give(1).unwrap();
    background.give(2).unwrap();
    drop(background);
    assert_eq!(*list.lock().unwrap(), [1, 2]);
}
