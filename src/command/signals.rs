//! Signals that end the command. Unfinished files are removed.

use crate::scene::atomic;
#[cfg(unix)]
use std::sync::{Arc, atomic::AtomicBool};

/// Ends the process on SIGINT, SIGTERM and SIGHUP, after removing unfinished files. The exit code is 128 plus the
/// signal's number, as in shells: 130, 143 and 129. SIGXFSZ does not end the process. Instead, the write beyond the
/// limit of file sizes fails, and the writer reports the failure.
///
/// An unfinished file remains, under a temporary name, if no handler can be set or no thread started.
#[cfg(unix)]
pub(super) fn remove_unfinished_at_the_end() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    // Any handler takes the place of the default, which ends the process. Nobody reads the flag.
    let _ = signal_hook::flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
    let ending = [SIGINT, SIGTERM].into_iter().chain(ends_on_hangup().then_some(SIGHUP));
    let Ok(mut signals) = signal_hook::iterator::Signals::new(ending) else { return };
    let _ = std::thread::Builder::new().spawn(move || {
        if let Some(signal) = signals.forever().next() {
            atomic::remove_unfinished();
            std::process::exit(128 + signal);
        }
    });
}

/// Whether SIGHUP ends the process. `nohup` starts a program with SIGHUP ignored, which a handler would undo. If the
/// system does not tell whether SIGHUP is ignored, no handler is set.
#[cfg(unix)]
fn ends_on_hangup() -> bool {
    let ignored = std::fs::read_to_string("/proc/self/status").ok().and_then(|status| {
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"))?;
        u64::from_str_radix(mask.trim(), 16).ok()
    });
    // The lowest bit is that of the first signal, SIGHUP.
    ignored.is_some_and(|mask| mask & 1 == 0)
}

/// Ends the process with exit code 130 on Ctrl-C and when its console closes, after removing unfinished files.
///
/// An unfinished file stays, under a temporary name, if no handler can be set.
#[cfg(not(unix))]
pub(super) fn remove_unfinished_at_the_end() {
    let _ = ctrlc::set_handler(|| {
        atomic::remove_unfinished();
        std::process::exit(130);
    });
}
