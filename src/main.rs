//! The `drypoint` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    drypoint::command::run(std::env::args_os())
}
