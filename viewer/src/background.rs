//! A thread beside the window's, which serves the newest of its requests.

use crate::mailbox::{Mail, Mailbox};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

/// A handle of the thread, which ends when it is dropped.
pub(crate) struct Background<Q, A> {
    mailbox: Arc<Mailbox<Q>>,
    answers: Receiver<A>,
    thread: Option<JoinHandle<()>>,
}

/// The thread's end of a [`Background`].
pub(crate) struct Desk<Q, A> {
    /// Requests.
    pub(crate) mailbox: Arc<Mailbox<Q>>,
    sender: Sender<A>,
    wake: Box<dyn Fn() + Send>,
}

impl<Q: Send + 'static, A: Send + 'static> Background<Q, A> {
    /// Starts the thread. `wake` is called after each answer, on the thread.
    pub(crate) fn new(name: &str, wake: Box<dyn Fn() + Send>, work: impl FnOnce(Desk<Q, A>) + Send + 'static) -> Self {
        let mailbox = Arc::new(Mailbox::new());
        let (sender, answers) = channel();
        let desk = Desk { mailbox: Arc::clone(&mailbox), sender, wake };
        let thread = std::thread::Builder::new().name(name.into()).spawn(|| work(desk)).ok();
        Self { mailbox, answers, thread }
    }

    /// Puts a request in the place of all before it.
    pub(crate) fn ask(&self, request: Q) {
        self.mailbox.put(request);
    }

    /// Returns the place of requests.
    pub(crate) fn mailbox(&self) -> Arc<Mailbox<Q>> {
        Arc::clone(&self.mailbox)
    }

    /// Returns the answers since the last call.
    pub(crate) fn answers(&self) -> impl Iterator<Item = A> + '_ {
        self.answers.try_iter()
    }

    /// Whether the thread is there. A fault of the program ends it, or the system does not start it.
    pub(crate) fn is_alive(&self) -> bool {
        self.thread.as_ref().is_some_and(|thread| !thread.is_finished())
    }
}

impl<Q, A> Drop for Background<Q, A> {
    fn drop(&mut self) {
        self.mailbox.close();
        // A thread that panicked has nothing to hand over.
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

impl<Q, A> Desk<Q, A> {
    /// Waits for a request. Returns none once there will be none.
    pub(crate) fn wait(&self) -> Option<Q> {
        match self.mailbox.take(None) {
            Mail::Request(request) => Some(request),
            Mail::Nothing | Mail::Closed => None,
        }
    }

    /// Hands an answer to the window.
    pub(crate) fn answer(&self, answer: A) {
        // Nobody listens only while the window closes.
        let _ = self.sender.send(answer);
        (self.wake)();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, Instant};

    #[test]
    fn a_thread_that_panics_is_seen() {
        let (sender, woken) = channel();
        let wake = Box::new(move || sender.send(()).unwrap_or_default());
        let background: Background<u32, u32> = Background::new("panics", wake, |desk| {
            while let Some(n) = desk.wait() {
                desk.answer(6_u32.checked_div(n).expect("a number that is not 0"));
            }
        });
        background.ask(2);
        woken.recv_timeout(Duration::from_secs(60)).unwrap();
        assert_eq!((background.answers().collect(), background.is_alive()), (vec![3], true));
        background.ask(0);
        let start = Instant::now();
        while background.is_alive() {
            assert!(start.elapsed() < Duration::from_secs(60), "the thread has not ended");
            std::thread::yield_now();
        }
    }
}
