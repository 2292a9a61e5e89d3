//! The verb `completions`.

use super::{Cli, Outcome};
use clap::{Args, CommandFactory};

/// Print completions for a shell.
#[derive(Debug, Args)]
pub(super) struct CompletionsArgs {
    /// The shell
    shell: clap_complete::Shell,
}

impl CompletionsArgs {
    pub(super) fn run(self) -> Outcome {
        let mut text = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "drypoint", &mut text);
        super::report::print(&String::from_utf8_lossy(&text))
    }
}
