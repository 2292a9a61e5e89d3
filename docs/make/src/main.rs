//! Writes the generated pages and pictures of the repository.

mod styles;

use std::process::ExitCode;

fn main() -> ExitCode {
    let what = std::env::args().nth(1);
    let done = match what.as_deref() {
        Some("styles") => styles::write(),
        _ => Err("usage: drypoint-docs styles".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}
