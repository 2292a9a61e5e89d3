//! The verb `schema`: the JSON Schema of scene files.

use super::{Outcome, report::print_json};
use clap::Args;

/// Print the JSON Schema of scene files.
#[derive(Debug, Args)]
pub(super) struct SchemaArgs {}

impl SchemaArgs {
    pub(super) fn run(self) -> Outcome {
        print_json(serde_json::to_string_pretty(&crate::scene::file::schema()))
    }
}
