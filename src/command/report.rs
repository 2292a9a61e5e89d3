//! Saying things: standard output, notes on standard error, progress.

use super::{Done, Outcome, Talk};
use drypoint::Failure;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{ErrorKind, IsTerminal, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Writes to standard output. A reader that has gone away is no error.
pub(super) fn print(text: &str) -> Outcome {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::new("standard output cannot be written", error, "").into())
        }
        _ => Ok(Done::Yes),
    }
}

/// A line on standard error, unless `-q`.
pub(super) fn note(talk: Talk, text: impl std::fmt::Display) {
    if !talk.quiet {
        eprintln!("{text}");
    }
}

/// A progress bar on a terminal for what takes over a second; nothing where output is piped or quiet.
pub(super) struct Progress {
    bar: Option<ProgressBar>,
    start: Instant,
    shown: AtomicU64,
}

impl Progress {
    /// A bar that is not shown yet.
    pub(super) fn new(talk: Talk) -> Self {
        let bar = (!talk.quiet && std::io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::hidden();
            bar.set_length(1000);
            if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {eta} left") {
                bar.set_style(style);
            }
            bar
        });
        Self { bar, start: Instant::now(), shown: AtomicU64::new(0) }
    }

    /// Hears the share that is done, in [0, 1].
    pub(super) fn hear(&self, share: f64) {
        let Some(bar) = &self.bar else { return };
        if self.start.elapsed() < Duration::from_secs(1) {
            return;
        }
        if self.shown.swap(1, Ordering::Relaxed) == 0 {
            bar.set_draw_target(indicatif::ProgressDrawTarget::stderr());
        }
        bar.set_position((share * 1000.0) as u64);
    }

    /// Takes the bar away.
    pub(super) fn clear(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
