//! Saying things: standard output, notes on standard error, progress.

use super::{Done, Outcome, Talk};
use drypoint::Failure;
use drypoint::scene::unprintable::is_unprintable;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{ErrorKind, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Writes to standard output. A reader that has gone away is no error.
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

/// A value, as `serde_json` has it, on standard output.
pub(super) fn print_json(text: serde_json::Result<String>) -> Outcome {
    match text {
        Ok(text) => write_out(&(escaped_json(&text) + "\n")),
        Err(error) => Err(Failure::new(error, "the result as JSON", "leave --json out").into()),
    }
}

/// A line on standard error, unless `-q`.
pub(super) fn note(talk: Talk, text: impl std::fmt::Display) {
    if !talk.quiet {
        say(text);
    }
}

/// A line on standard error.
pub(super) fn say(text: impl std::fmt::Display) {
    // Where standard error is closed nobody hears it, and work goes on.
    let _ = writeln!(std::io::stderr(), "{}", escaped(&text.to_string()));
}

/// Escapes a text for a terminal, where a name in it could change what is shown around it, by a colour or the direction of
/// writing: ESC becomes `\u{1b}`. Line ends and tabs stay.
fn escaped(text: &str) -> String {
    with_escapes(text, |c| c.escape_unicode().to_string())
}

/// Escapes JSON as JSON does, so that its value stays: unprintable characters stand in its strings alone.
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

/// Time until a bar is shown: what is done by then needs none.
const PATIENCE: Duration = Duration::from_secs(1);

/// What is being done, on a terminal, for what takes over a second; nothing where output is piped or quiet.
pub(super) struct Progress {
    bar: Option<ProgressBar>,
    has_share: AtomicBool,
}

impl Progress {
    /// Begins without a known share: a spinner with a text.
    pub(super) fn new(talk: Talk, doing: impl std::fmt::Display) -> Self {
        let bar = (!talk.quiet && std::io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::with_draw_target(Some(1000), ProgressDrawTarget::hidden())
                .with_message(escaped(&doing.to_string()));
            if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}") {
                bar.set_style(style);
            }
            let shown = bar.clone();
            std::thread::spawn(move || {
                std::thread::sleep(PATIENCE);
                if !shown.is_finished() {
                    shown.set_draw_target(ProgressDrawTarget::stderr());
                    shown.enable_steady_tick(Duration::from_millis(100));
                }
            });
            bar
        });
        Self { bar, has_share: AtomicBool::new(false) }
    }

    /// Hears the share that is done, in [0, 1], and shows it from then on.
    pub(super) fn hear(&self, share: f64) {
        let Some(bar) = &self.bar else { return };
        if !self.has_share.swap(true, Ordering::Relaxed) {
            bar.reset_eta();
            if let Ok(style) = ProgressStyle::with_template("{msg} {bar:40} {percent:>3} %  {eta} left") {
                bar.set_style(style);
            }
        }
        bar.set_position((share * 1000.0) as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
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
}
