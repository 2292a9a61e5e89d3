//! `--threads`: how many there are.

use clap::builder::RangedU64ValueParser;
use drypoint::Failure;

/// Threads, as verbs that draw take them.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct Threads {
    /// Threads [default: one a processor]
    #[arg(long = "threads", value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(1..=1024))]
    number: Option<usize>,
}

impl Threads {
    /// Starts them; what is computed before has those of the default.
    pub(super) fn start(self) -> Result<(), Failure> {
        let Some(threads) = self.number else { return Ok(()) };
        let started = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
        started.map_err(|e| Failure::new(e, format!("--threads {threads}"), "ask for fewer"))
    }
}
