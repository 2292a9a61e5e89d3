//! A place for the newest request to a thread: older ones are dropped.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Holds the newest request, and stops the work on the one before it.
#[derive(Debug)]
pub(crate) struct Mailbox<T> {
    slot: Mutex<Slot<T>>,
    changed: Condvar,
    stop: AtomicBool,
}

#[derive(Debug)]
struct Slot<T> {
    newest: Option<T>,
    is_closed: bool,
}

/// The outcome of waiting for a request.
#[derive(Debug)]
pub(crate) enum Mail<T> {
    /// A request.
    Request(T),
    /// There was none in the time.
    Nothing,
    /// There will be none.
    Closed,
}

impl<T> Mailbox<T> {
    pub(crate) fn new() -> Self {
        let slot = Mutex::new(Slot { newest: None, is_closed: false });
        Self { slot, changed: Condvar::new(), stop: AtomicBool::new(false) }
    }

    /// Puts a request in the place of the one before it.
    pub(crate) fn put(&self, request: T) {
        let mut slot = self.lock();
        slot.newest = Some(request);
        self.stop.store(true, Ordering::Relaxed);
        self.changed.notify_one();
    }

    /// Ends the waiting for good.
    pub(crate) fn close(&self) {
        self.lock().is_closed = true;
        self.stop.store(true, Ordering::Relaxed);
        self.changed.notify_one();
    }

    /// Takes the request, or waits for one, at most for some time.
    pub(crate) fn take(&self, most: Option<Duration>) -> Mail<T> {
        let slot = self.lock();
        let is_empty = |slot: &mut Slot<T>| slot.newest.is_none() && !slot.is_closed;
        let mut slot = match most {
            None => self.changed.wait_while(slot, is_empty).unwrap_or_else(PoisonError::into_inner),
            Some(most) => {
                let waited = self.changed.wait_timeout_while(slot, most, is_empty);
                waited.unwrap_or_else(PoisonError::into_inner).0
            }
        };
        if slot.is_closed {
            return Mail::Closed;
        }
        self.stop.store(false, Ordering::Relaxed);
        slot.newest.take().map_or(Mail::Nothing, Mail::Request)
    }

    /// Stops the work on the request that was taken last.
    pub(crate) fn interrupt(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Returns a flag that becomes true once a newer request is there, or the work is of no more use.
    pub(crate) fn stop(&self) -> &AtomicBool {
        &self.stop
    }

    fn lock(&self) -> MutexGuard<'_, Slot<T>> {
        self.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
