//! Renderers of the volume of a frame: the reference, or a graphics card.

use crate::Failure;
use crate::gpu::Gpu;
#[cfg(feature = "gpu")]
use crate::gpu::GpuFrames;
use crate::job::{Job, KnobVariant, render_failure};
use drypoint_reference::ray::Renderer;
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragments;
use drypoint_scene::picture::Picture;
use drypoint_scene::shot::Shot;
use std::time::Instant;

/// A renderer of the volume.
pub(crate) enum VolumeRenderer<'a> {
    /// The reference.
    Reference(Box<Renderer<'a>>),
    /// A graphics card.
    #[cfg(feature = "gpu")]
    Gpu(Box<GpuFrames<'a>>),
}

impl<'a> VolumeRenderer<'a> {
    /// Prepares frames of a job, or of its scene with other knobs, on a graphics card or by the reference. The cost of
    /// preparing goes to `counts`.
    pub(crate) fn new(
        job: &'a Job,
        knobs: Option<&'a KnobVariant>,
        card: Option<&'a Gpu>,
        counts: &mut Counts,
    ) -> Result<Self, Failure> {
        match card {
            None => {
                let start = Instant::now();
                let renderer = knobs.map_or_else(|| job.renderer(), |knobs| job.renderer_of(knobs))?;
                counts.add(renderer.prepared());
                counts.seconds.insert("prepare".into(), start.elapsed().as_secs_f64());
                Ok(Self::Reference(Box::new(renderer)))
            }
            #[cfg(feature = "gpu")]
            Some(gpu) => {
                let frames = knobs.map_or_else(|| GpuFrames::new(job, gpu), |knobs| GpuFrames::of(job, gpu, knobs))?;
                counts.bytes.insert("volume on the card".into(), frames.bytes());
                Ok(Self::Gpu(Box::new(frames)))
            }
            #[cfg(not(feature = "gpu"))]
            Some(gpu) => match *gpu {},
        }
    }

    /// About how many samples a frame has without skipping.
    pub(crate) fn samples(&self) -> f64 {
        match self {
            Self::Reference(renderer) => renderer.samples(),
            #[cfg(feature = "gpu")]
            Self::Gpu(frames) => frames.samples(),
        }
    }

    /// n of the n×n rays of a pixel.
    pub(crate) fn rays_across(&self) -> usize {
        match self {
            Self::Reference(renderer) => renderer.rays_across(),
            #[cfg(feature = "gpu")]
            Self::Gpu(frames) => frames.rays_across(),
        }
    }

    /// Puts lines inside the frames that follow, or takes them out.
    pub(crate) fn merge(&mut self, lines: Option<Fragments>) -> Result<(), Failure> {
        match self {
            Self::Reference(renderer) => renderer.merge(lines),
            #[cfg(feature = "gpu")]
            Self::Gpu(frames) => return frames.merge(lines),
        }
        Ok(())
    }

    /// Takes the camera of another shot.
    pub(crate) fn turn(&mut self, shot: &Shot, job: &Job) -> Result<(), Failure> {
        match self {
            Self::Reference(renderer) => renderer.turn(shot).map_err(|error| render_failure(&error, &job.scene)),
            #[cfg(feature = "gpu")]
            Self::Gpu(frames) => frames.turn(shot),
        }
    }

    /// Renders a frame, with its own counts and seconds.
    pub(crate) fn frame(&mut self, progress: &(dyn Fn(f64) + Sync)) -> Result<(Picture, Counts), Failure> {
        let start = Instant::now();
        let (picture, mut counts) = match self {
            Self::Reference(renderer) => renderer.again(progress),
            #[cfg(feature = "gpu")]
            Self::Gpu(frames) => frames.frame(progress)?,
        };
        counts.seconds.insert("rays".into(), start.elapsed().as_secs_f64());
        Ok((picture, counts))
    }

    /// Draws a frame where a viewer has it: the reference in memory, a graphics card in its texture.
    pub(crate) fn show(&mut self) -> Result<(), Failure> {
        match self {
            Self::Reference(renderer) => {
                renderer.again(&|_| ());
            }
            #[cfg(feature = "gpu")]
            Self::Gpu(frames) => {
                frames.show()?;
            }
        }
        Ok(())
    }
}
