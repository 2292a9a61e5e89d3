//! The graphics card of a command, where the command is built with one.

use super::Talk;
use drypoint::Failure;
#[cfg(feature = "gpu")]
pub(super) use drypoint::gpu::Gpu;

/// The adapter of a command without one.
#[cfg(not(feature = "gpu"))]
pub(super) enum Gpu {}

/// Opens the adapter, and notes which one it is.
///
/// # Errors
/// No adapter, or a command that was built without graphics.
#[cfg(feature = "gpu")]
pub(super) fn open(talk: Talk) -> Result<Gpu, Failure> {
    let gpu = drypoint::gpu::open()?;
    if talk.verbose || gpu.is_software() {
        super::report::note(talk, format_args!("graphics: {}", gpu.describe()));
    }
    Ok(gpu)
}

/// Says how to get a command with graphics.
///
/// # Errors
/// Always.
#[cfg(not(feature = "gpu"))]
pub(super) fn open(_: Talk) -> Result<Gpu, Failure> {
    let what = "this command was built without the GPU backend";
    let remedy = "build it with `cargo build --release --features gpu`, or leave --backend out: the CPU renders";
    Err(Failure::new(what, "--backend gpu", remedy))
}
