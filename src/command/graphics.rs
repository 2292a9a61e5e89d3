//! The graphics card of a command, where the command is built with one.

use super::Talk;
use drypoint::Failure;
#[cfg(feature = "gpu")]
pub(super) use drypoint::gpu::Gpu;

/// The adapter of a command without one.
#[cfg(not(feature = "gpu"))]
pub(super) enum Gpu {}

/// Opens the adapter, and notes which one it is. With `fast` its texture unit interpolates between voxels.
///
/// # Errors
/// No adapter, or a command that was built without graphics.
#[cfg(feature = "gpu")]
pub(super) fn open(talk: Talk, fast: bool) -> Result<Gpu, Failure> {
    use drypoint::gpu::Interpolation;
    let gpu = drypoint::gpu::open(if fast { Interpolation::Fast } else { Interpolation::Exact })?;
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
pub(super) fn open(_: Talk, _: bool) -> Result<Gpu, Failure> {
    let what = "this command was built without the GPU backend";
    let remedy = "build it with `cargo build --release --features gpu`, or leave --backend out: the CPU renders";
    Err(Failure::new(what, "--backend", remedy))
}
