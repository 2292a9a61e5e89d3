//! `schema`: the JSON Schema of scene files.

use super::Outcome;
use clap::Args;

/// Print the JSON Schema of scene files.
#[derive(Debug, Args)]
pub(super) struct Schema {}

impl Schema {
    pub(super) fn run(self) -> Outcome {
        super::report::print(&format!("{:#}\n", drypoint::scene::file::schema()))
    }
}
