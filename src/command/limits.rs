//! The options `--threads` and `--memory`.

use crate::Failure;
use crate::scene::memory;
use clap::builder::RangedU64ValueParser;

/// Address space of a thread: its stack of 2 MiB, and room for what it allocates as it starts.
const BYTES_OF_A_THREAD: usize = 3 << 20;

/// Resource limits of every verb.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub(super) struct LimitArgs {
    /// Number of threads [default: one per processor]
    #[arg(long, global = true, value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(1..=1024))]
    threads: Option<usize>,
    /// Memory limit, such as 4GiB; larger tasks are refused [default: free memory]
    #[arg(long, global = true, value_name = "SIZE", value_parser = bytes)]
    memory: Option<u64>,
}

impl LimitArgs {
    /// Sets the memory budget and starts the one pool of threads, before any verb works.
    ///
    /// # Errors
    /// The system refuses the threads.
    pub(super) fn apply(self) -> Result<(), Failure> {
        if let Some(bytes) = self.memory {
            memory::limit(bytes);
        }
        let of_machine = || std::thread::available_parallelism().map_or(1, usize::from);
        let threads = self.threads.unwrap_or_else(of_machine);
        let refused = |error: &dyn std::fmt::Display| {
            let what = format!("the threads cannot be started: {error}");
            let place = self.threads.map_or("--threads".into(), |n| format!("--threads {n}"));
            Failure::new(what, place, "ask for fewer with --threads, or allow the process more memory")
        };
        // A thread that starts and finds no memory would abort the process, so the address space is tried before.
        let tried = std::hint::black_box(&mut Vec::<u8>::new()).try_reserve_exact(threads * BYTES_OF_A_THREAD);
        tried.map_err(|error| refused(&error))?;
        rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().map_err(|error| refused(&error))
    }
}

/// Parses a size such as `4GiB` or `512 MiB` into bytes.
fn bytes(text: &str) -> Result<u64, &'static str> {
    let unit = |suffix: &str, shift: u32| Some((text.trim().strip_suffix(suffix)?.trim_end(), shift));
    let number = |(number, shift): (&str, u32)| {
        let bytes = number.parse::<f64>().ok()? * f64::from(shift).exp2();
        (bytes >= 1.0 && bytes.is_finite()).then_some(bytes as u64)
    };
    let found = unit("GiB", 30).or_else(|| unit("MiB", 20)).and_then(number);
    found.ok_or("a size is a number with MiB or GiB, such as 4GiB")
}

#[cfg(test)]
mod tests {
    use super::bytes;

    #[test]
    fn sizes_by_hand() {
        for (text, expected) in [("4GiB", 4 << 30), (" 512 MiB ", 512 << 20), ("0.5GiB", 1 << 29)] {
            assert_eq!(bytes(text), Ok(expected), "{text}");
        }
        for text in ["4", "GiB", "-1GiB", "0GiB", "4 GB", "nanGiB", "infGiB", ""] {
            assert!(bytes(text).is_err(), "{text}");
        }
    }
}
