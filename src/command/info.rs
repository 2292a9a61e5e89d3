//! `info`: what a volume file holds.

use super::{Outcome, report::print};
use clap::Args;
use drypoint::Failure;
use drypoint::scene::volume::{info, read};
use std::path::PathBuf;

/// Say what a volume file holds: dims, type, spacing, range, invalid voxels, histogram.
#[derive(Debug, Args)]
pub(super) struct Info {
    /// A volume
    #[arg(value_name = "VOLUME")]
    volume: PathBuf,
    /// As JSON
    #[arg(long)]
    json: bool,
}

impl Info {
    pub(super) fn run(self) -> Outcome {
        let volume = read::read(&self.volume, None).map_err(|e| Failure::new(e.what(), e.place(), e.remedy()))?;
        let info = info::Info::new(&self.volume, &volume);
        if !self.json {
            return print(&info.to_string());
        }
        let json = serde_json::to_string_pretty(&info)
            .map_err(|e| Failure::new("the facts cannot be written as JSON", e, "this is a fault of the program"))?;
        print(&format!("{json}\n"))
    }
}
