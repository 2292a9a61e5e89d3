//! `plan`: what a scene calls for, and why.

use super::Outcome;
use super::input::{self, Set};
use super::report::print;
use clap::Args;
use drypoint::scene::file::write_full;
use std::path::PathBuf;

/// Say what a scene calls for, and which line asked.
#[derive(Debug, Args)]
pub(super) struct Plan {
    /// A scene or a volume; without either, the embedded scene
    #[arg(value_name = "SCENE|VOLUME")]
    input: Option<PathBuf>,
    /// Print the scene with every default filled in, as a valid scene
    #[arg(long)]
    full: bool,
    #[command(flatten)]
    set: Set,
}

impl Plan {
    pub(super) fn run(self) -> Outcome {
        let job = input::load(self.input.as_ref(), &self.set.overrides(&[])?)?;
        print(&if self.full { write_full(&job.scene) } else { job.plan.to_string() })
    }
}
