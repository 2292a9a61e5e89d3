//! The verb `schema`: the JSON Schema of scene and figure files.

use super::{Outcome, report::print_json};
use crate::scene::file;
use clap::Args;

/// Print the JSON Schema of scene files.
#[derive(Debug, Args)]
pub(super) struct SchemaArgs {
    /// Print that of figure files
    #[arg(long)]
    figure: bool,
}

impl SchemaArgs {
    pub(super) fn run(self) -> Outcome {
        let schema = if self.figure { file::figure_schema() } else { file::schema() };
        print_json(serde_json::to_string_pretty(&schema))
    }
}
