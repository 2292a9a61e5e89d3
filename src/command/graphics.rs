//! The graphics card of a command, where the command is built with one.

use super::Talk;
use drypoint::Failure;
use drypoint::gpu::Gpu;

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

/// The settings of the knob `backend` of a sweep of the knobs `only`, or of all if there is none: the card with its texture
/// unit, and with the shader's interpolation. None where the knob is not asked for, and there is no card or only software.
///
/// # Errors
/// The knob is asked for by name, and there is no adapter.
#[cfg(feature = "gpu")]
pub(super) fn knob(talk: Talk, only: &[String]) -> Result<Vec<(&'static str, Gpu)>, Failure> {
    use drypoint::gpu::Interpolation;
    let is_named = only.iter().any(|key| key == drypoint::cost::BACKEND);
    let gpu = match Gpu::new() {
        _ if !is_named && !only.is_empty() => return Ok(Vec::new()),
        Ok(gpu) if is_named || !gpu.is_software() => gpu,
        Err(_) if is_named => open(talk, false)?,
        _ => return Ok(Vec::new()),
    };
    super::report::note(talk, format_args!("graphics: {}", gpu.describe()));
    let fast = gpu.interpolating(Interpolation::Fast).ok().map(|fast| ("gpu-fast", fast));
    Ok(fast.into_iter().chain([("gpu", gpu)]).collect())
}

/// No settings of the knob `backend`.
///
/// # Errors
/// The knob is asked for by name.
#[cfg(not(feature = "gpu"))]
pub(super) fn knob(talk: Talk, only: &[String]) -> Result<Vec<(&'static str, Gpu)>, Failure> {
    let is_named = only.iter().any(|key| key == drypoint::cost::BACKEND);
    if is_named { open(talk, false).map(|_| Vec::new()) } else { Ok(Vec::new()) }
}
