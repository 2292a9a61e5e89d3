//! The verb `info`: the contents of a volume file.

use super::raw::RawArgs;
use super::report::{Progress, print, print_json};
use super::{Outcome, Talk};
use crate::scene::volume::info;
use clap::Args;
use std::path::PathBuf;

/// Describe a volume file: size, type, spacing, range, invalid voxels, histogram.
#[derive(Debug, Args)]
pub(super) struct InfoArgs {
    /// Volume file
    #[arg(value_name = "VOLUME")]
    volume: PathBuf,
    #[command(flatten)]
    raw: RawArgs,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl InfoArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let info = {
            let _reading = Progress::new(talk, "reading");
            info::Info::new(&self.volume, &self.raw.read(&self.volume)?)
        };
        if self.json { print_json(serde_json::to_string_pretty(&info)) } else { print(&format!("{info}\n")) }
    }
}
