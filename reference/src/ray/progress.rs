//! The progress of a frame, and its early stop.

use std::sync::atomic::{AtomicBool, Ordering};

/// The progress of a frame or of a part of it.
#[derive(Clone, Copy)]
pub(crate) struct FrameProgress<'p> {
    /// Receives the share of the frame that is done, on any thread.
    pub(crate) hear: &'p (dyn Fn(f64) + Sync),
    /// The flag that stops the frame.
    pub(crate) stop: &'p AtomicBool,
    /// Whether the frame was stopped. Once set, it stays set, whatever happens to `stop`.
    pub(crate) stopped: &'p AtomicBool,
    /// The shares of the frame at which the part begins and ends.
    pub(crate) between: [f64; 2],
}

impl FrameProgress<'_> {
    /// The progress of a part between two shares of this one.
    pub(crate) fn part(self, shares: [f64; 2]) -> Self {
        let between = shares.map(|share| self.of_frame(share));
        Self { between, ..self }
    }

    /// Reports the share that is done.
    pub(crate) fn tell(self, share: f64) {
        (self.hear)(self.of_frame(share));
    }

    /// Whether drawing has been stopped.
    pub(crate) fn is_stopped(self) -> bool {
        self.stopped.fetch_or(self.stop.load(Ordering::Relaxed), Ordering::Relaxed);
        self.stopped.load(Ordering::Relaxed)
    }

    fn of_frame(self, share: f64) -> f64 {
        let [from, to] = self.between;
        from + (to - from) * share
    }
}
