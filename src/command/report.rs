//! Output of the command: standard output, notes on standard error, progress.

use super::{Done, Outcome, Talk};
use crate::Failure;
use crate::scene::unprintable::is_unprintable;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{ErrorKind, IsTerminal, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// Writes to standard output. A closed pipe is not an error.
pub(super) fn print(text: &str) -> Outcome {
    write_out(&escaped(text))
}

fn write_out(text: &str) -> Outcome {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::new(error, "standard output", "send it to a place that has room").into())
        }
        _ => Ok(Done::Yes),
    }
}

/// Writes JSON from `serde_json` to standard output.
pub(super) fn print_json(text: serde_json::Result<String>) -> Outcome {
    match text {
        Ok(text) => write_out(&(escaped_json(&text) + "\n")),
        Err(error) => Err(Failure::new(error, "the result as JSON", "leave --json out").into()),
    }
}

/// Writes a line to standard error, unless `-q`. Line breaks, which a file's name may have, are escaped.
pub(super) fn note(talk: Talk, text: impl std::fmt::Display) {
    if !talk.quiet {
        say(text.to_string().replace('\n', "\\n"));
    }
}

/// Writes a line to standard error.
pub(super) fn say(text: impl std::fmt::Display) {
    // With a closed standard error nobody reads it, and work goes on.
    let _ = writeln!(std::io::stderr(), "{}", escaped(&text.to_string()));
}

/// Escapes unprintable characters for a terminal: ESC becomes `\u{1b}`. A name with such characters could change
/// colours or the writing direction around it. Line ends and tabs are kept.
fn escaped(text: &str) -> String {
    with_escapes(text, |c| c.escape_unicode().to_string())
}

/// Escapes unprintable characters as JSON does, so that values are kept. These characters occur only in strings.
fn escaped_json(text: &str) -> String {
    with_escapes(text, |c| format!("\\u{:04x}", u32::from(c)))
}

fn with_escapes(text: &str, escape: impl Fn(char) -> String) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        if is_unprintable(c) && c != '\n' && c != '\t' {
            escaped += &escape(c);
        } else {
            escaped.push(c);
        }
    }
    escaped
}

/// Time until a bar is shown, and until an estimate is made. Shorter work needs neither.
const PATIENCE: Duration = Duration::from_secs(1);

/// Work that is expected to take this long announces its time.
const LONG: Duration = Duration::from_secs(5);

/// Share of the work that allows an estimate before [`LONG`] has passed.
const ENOUGH: f64 = 0.1;

/// Progress of work. Work expected to take five seconds or more announces its time in one line. On a terminal, work of
/// more than a second has a bar. Nothing is shown in quiet mode.
pub(super) struct Progress {
    shown: Option<Arc<ProgressState>>,
}

/// State of work, shown by a thread of its own.
struct ProgressState {
    doing: String,
    start: Instant,
    bar: Option<ProgressBar>,
    amount: OnceLock<String>,
    /// Bits of the finished share, in [0, 1].
    share: AtomicU64,
    ended: (Mutex<bool>, Condvar),
}

impl Progress {
    /// Begins work of unknown length: a spinner with a text.
    pub(super) fn new(talk: Talk, doing: impl std::fmt::Display) -> Self {
        let shown = (!talk.quiet).then(|| {
            let doing = escaped(&doing.to_string());
            let bar = std::io::stderr().is_terminal().then(|| {
                let hidden = ProgressDrawTarget::hidden();
                let bar = ProgressBar::with_draw_target(Some(1000), hidden).with_message(doing.clone());
                if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}") {
                    bar.set_style(style);
                }
                bar
            });
            let (amount, share) = (OnceLock::new(), AtomicU64::new(0));
            let ended = (Mutex::new(false), Condvar::new());
            let shown = Arc::new(ProgressState { doing, start: Instant::now(), bar, amount, share, ended });
            let watched = shown.clone();
            // Without a thread nothing is shown, and the work goes on.
            let _ = std::thread::Builder::new().spawn(move || watched.watch());
            shown
        });
        Self { shown }
    }

    /// Announces the amount of work, such as `3.1e6 dots`. Only the first call counts.
    pub(super) fn amount(&self, amount: impl FnOnce() -> String) {
        if let Some(shown) = &self.shown {
            shown.amount.get_or_init(amount);
        }
    }

    /// Sets the finished share, in [0, 1], and shows it from then on.
    pub(super) fn hear(&self, share: f64) {
        let Some(shown) = &self.shown else { return };
        let before = f64::from_bits(shown.share.swap(share.to_bits(), Ordering::Relaxed));
        let Some(bar) = &shown.bar else { return };
        if before == 0.0 {
            bar.reset_eta();
            if let Ok(style) = ProgressStyle::with_template("{msg} {bar:40} {percent:>3} %  {eta} left") {
                bar.set_style(style);
            }
        }
        bar.set_position((share * 1000.0) as u64);
    }
}

impl ProgressState {
    /// Shows the bar in time, and announces the duration of long work.
    fn watch(&self) {
        if self.ended_within(PATIENCE) {
            return;
        }
        if let Some(bar) = &self.bar {
            bar.set_draw_target(ProgressDrawTarget::stderr());
            bar.enable_steady_tick(Duration::from_millis(100));
        }
        let mut said = 0.0;
        loop {
            let (elapsed, share) = (self.start.elapsed(), f64::from_bits(self.share.load(Ordering::Relaxed)));
            let all = elapsed.as_secs_f64() / share;
            // The first rays meet little, so an early estimate may be far too low. An estimate twice as long is
            // announced again.
            let ventured = elapsed >= LONG || (ENOUGH..1.0).contains(&share);
            if ventured && share > 0.0 && share < 1.0 && all >= LONG.as_secs_f64().max(2.0 * said) {
                self.say(&format!("about {} in all", duration(all)));
                said = all;
            } else if elapsed >= LONG && said == 0.0 {
                self.say("it takes more than 5 seconds");
                said = LONG.as_secs_f64();
            }
            if self.ended_within(PATIENCE / 4) {
                return;
            }
        }
    }

    /// Waits, and returns whether the work ended meanwhile.
    fn ended_within(&self, time: Duration) -> bool {
        let ended = self.ended.0.lock().unwrap_or_else(PoisonError::into_inner);
        let waited = self.ended.1.wait_timeout_while(ended, time, |ended| !*ended);
        *waited.unwrap_or_else(PoisonError::into_inner).0
    }

    fn say(&self, time: &str) {
        let amount = self.amount.get().map(|amount| format!("{amount}, ")).unwrap_or_default();
        let line = format!("{}: {amount}{time}", self.doing);
        match &self.bar {
            Some(bar) => bar.suspend(|| say(line)),
            None => say(line),
        }
    }
}

/// Returns a duration in its natural unit.
fn duration(seconds: f64) -> String {
    let units =
        [("seconds", 1.0), ("minutes", 60.0), ("hours", 3600.0), ("days", 86400.0), ("years", 365.25 * 86400.0)];
    let (unit, length) = units.into_iter().rev().find(|(_, length)| seconds >= 1.5 * length).unwrap_or(units[0]);
    format!("{:.0} {unit}", seconds / length)
}

impl Drop for Progress {
    fn drop(&mut self) {
        let Some(shown) = &self.shown else { return };
        *shown.ended.0.lock().unwrap_or_else(PoisonError::into_inner) = true;
        shown.ended.1.notify_all();
        if let Some(bar) = &shown.bar {
            bar.finish_and_clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_change_nothing_around_them() {
        assert_eq!(escaped("a\u{1b}[31m\u{202e}\u{9b}b\t×\n"), "a\\u{1b}[31m\\u{202e}\\u{9b}b\t×\n");
        let name = "a\u{1b}\u{202e}\u{7f}\u{9b}\n\"b";
        let json = escaped_json(&serde_json::to_string_pretty(&[name]).unwrap());
        assert!(json.chars().all(|c| c == '\n' || !is_unprintable(c)), "{json}");
        assert_eq!(serde_json::from_str::<Vec<String>>(&json).unwrap(), [name]);
    }

    #[test]
    fn times_in_the_units_of_people() {
        for (seconds, text) in
            [(7.2, "7 seconds"), (89.0, "89 seconds"), (90.0, "2 minutes"), (7200.0, "2 hours"), (1e9, "32 years")]
        {
            assert_eq!(duration(seconds), text);
        }
    }
}
