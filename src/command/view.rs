//! The verb `view`: the window of the package `drypoint-viewer`, a program of its own.

use super::{Done, Outcome};
use crate::Failure;
use clap::Args;
use std::env::consts::EXE_SUFFIX;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::Command;

/// Open a window in which a volume is turned and its scene file edited.
#[derive(Debug, Args)]
pub(super) struct ViewArgs {
    /// Scene or volume; without one the embedded scene
    input: Option<PathBuf>,
}

impl ViewArgs {
    pub(super) fn run(self) -> Outcome {
        let name = format!("drypoint-viewer{EXE_SUFFIX}");
        let beside =
            std::env::current_exe().ok().map(|own| own.with_file_name(&name)).filter(|program| program.is_file());
        // Without one beside the command the system looks in PATH.
        let program = beside.map_or_else(|| OsString::from(&name), PathBuf::into_os_string);
        let failure = |what: String| {
            let remedy = "install it with cargo install --path viewer --locked";
            Failure::new(what, program.to_string_lossy(), remedy)
        };
        let status = Command::new(&program).args(self.input).status();
        let status = status.map_err(|error| failure(format!("the window cannot be opened: {error}")))?;
        match status.success() {
            true => Ok(Done::Yes),
            false => Err(failure(format!("the window ended with {status}")).into()),
        }
    }
}
