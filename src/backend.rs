//! The back end that draws the frames of a job.

use crate::Failure;
use crate::frames::{Frames, ReferenceFrames};
use crate::gpu::Gpu;
#[cfg(feature = "gpu")]
use crate::gpu::GpuFrames;
use crate::job::{Job, SceneVariant};
use drypoint_scene::counts::Counts;
use std::time::Instant;

/// Prepares frames of a job, or of a variant of its scene, on a graphics card or by the reference. Adds the cost of
/// the preparation to `counts`.
///
/// # Errors
/// The errors of [`Job::renderer`], and those of the adapter.
pub(crate) fn frames<'a>(
    job: &'a Job,
    variant: Option<&SceneVariant>,
    card: Option<&Gpu>,
    counts: &mut Counts,
) -> Result<Box<dyn Frames + 'a>, Failure> {
    match card {
        None => {
            let start = Instant::now();
            let renderer = variant.map_or_else(|| job.renderer(), |variant| job.renderer_of(variant))?;
            counts.add(renderer.prepared());
            counts.seconds.insert("prepare".into(), start.elapsed().as_secs_f64());
            Ok(Box::new(ReferenceFrames::new(renderer, &job.scene)))
        }
        #[cfg(feature = "gpu")]
        Some(gpu) => {
            let frames =
                variant.map_or_else(|| GpuFrames::new(job, gpu), |variant| GpuFrames::of(job, gpu, variant))?;
            counts.bytes.insert("volume on the card".into(), frames.bytes());
            Ok(Box::new(frames))
        }
        #[cfg(not(feature = "gpu"))]
        Some(gpu) => match *gpu {},
    }
}
