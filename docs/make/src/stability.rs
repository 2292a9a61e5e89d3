//! `docs/stability.md`: the hard cases, measured by the tests that hold their bounds.

use crate::files;
use std::process::Command;

/// Has the test that holds the page write it: what it lists are the records of `tests/hard_cases`.
///
/// # Errors
/// A case that does not keep its bound, or a test that cannot be run.
pub(crate) fn write() -> Result<(), String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let words = ["test", "--release", "-p", "drypoint", "--test", "hard_cases", "stability::the_page"];
    let mut command = Command::new(cargo);
    command.args(words).env("DRYPOINT_WRITE_STABILITY", "1").current_dir(files::in_docs(".."));
    let status = command.status().map_err(|e| format!("cargo test: {e}"))?;
    if !status.success() {
        return Err("docs/stability.md is not written: a hard case does not keep its bound".into());
    }
    println!("docs/stability.md");
    Ok(())
}
