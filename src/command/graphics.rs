//! The graphics card of a command that is built with graphics.

use super::Talk;
use crate::Failure;
use crate::gpu::Gpu;

/// Opens the adapter and notes its name. With `fast`, the texture unit interpolates between voxels.
///
/// # Errors
/// There is no adapter, or it gives no device, or its texture unit does not interpolate.
#[cfg(feature = "gpu")]
pub(super) fn open(talk: Talk, fast: bool) -> Result<Gpu, Failure> {
    use crate::gpu::Interpolation;
    let gpu = crate::gpu::open(if fast { Interpolation::Fast } else { Interpolation::Exact })?;
    if talk.verbose || gpu.is_software() {
        super::report::note(talk, format_args!("graphics: {}", gpu.describe()));
    }
    Ok(gpu)
}

/// Fails, and tells how to get a command with graphics.
///
/// # Errors
/// Always.
#[cfg(not(feature = "gpu"))]
pub(super) fn open(_: Talk, _: bool) -> Result<Gpu, Failure> {
    let what = "this command was built without the GPU backend";
    let remedy = "build it with `cargo build --release --features gpu`, or leave --backend out: the CPU renders";
    Err(Failure::new(what, "--backend gpu", remedy))
}

/// The settings of the knob `backend`, if it is among the knobs `only` of a sweep. They are the card with the
/// interpolation of its texture unit, and with that of the shader.
///
/// # Errors
/// The errors of [`open`].
pub(super) fn knob(talk: Talk, only: &[String]) -> Result<Vec<(&'static str, Gpu)>, Failure> {
    if only.iter().all(|key| key != crate::cost::BACKEND) {
        return Ok(Vec::new());
    }
    let gpu = open(talk, false)?;
    #[cfg(feature = "gpu")]
    {
        let fast = gpu.interpolating(crate::gpu::Interpolation::Fast).ok().map(|fast| ("gpu-fast", fast));
        Ok(fast.into_iter().chain([("gpu", gpu)]).collect())
    }
    #[cfg(not(feature = "gpu"))]
    match gpu {}
}
