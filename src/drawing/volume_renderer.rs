//! Renderers of the volume of a frame: the reference, or a graphics card.

use crate::Failure;
#[cfg(feature = "gpu")]
use crate::gpu::GpuFrames;
use crate::job::{Job, render_failure};
use drypoint_reference::ray::Renderer;
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragments;
use drypoint_scene::picture::Picture;
use drypoint_scene::shot::Shot;

/// A renderer of the volume.
pub(super) enum VolumeRenderer<'a> {
    /// The reference.
    Reference(Box<Renderer<'a>>),
    /// A graphics card.
    #[cfg(feature = "gpu")]
    Gpu(Box<GpuFrames<'a>>),
}

impl VolumeRenderer<'_> {
    /// About how many samples a frame has without skipping.
    pub(super) fn samples(&self) -> f64 {
        match self {
            Self::Reference(renderer) => renderer.samples(),
            #[cfg(feature = "gpu")]
            Self::Gpu(frames) => frames.samples(),
        }
    }

    /// n of the n×n rays of a pixel.
    pub(super) fn rays_across(&self) -> usize {
        match self {
            Self::Reference(renderer) => renderer.rays_across(),
            #[cfg(feature = "gpu")]
            Self::Gpu(frames) => frames.rays_across(),
        }
    }

    /// Puts lines inside the frames that follow, or takes them out.
    pub(super) fn merge(&mut self, lines: Option<Fragments>) -> Result<(), Failure> {
        match self {
            Self::Reference(renderer) => renderer.merge(lines),
            #[cfg(feature = "gpu")]
            Self::Gpu(frames) => return frames.merge(lines),
        }
        Ok(())
    }

    /// Takes the camera of another shot.
    pub(super) fn turn(&mut self, shot: &Shot, job: &Job) -> Result<(), Failure> {
        match self {
            Self::Reference(renderer) => renderer.turn(shot).map_err(|error| render_failure(&error, &job.scene)),
            #[cfg(feature = "gpu")]
            Self::Gpu(frames) => frames.turn(shot),
        }
    }

    /// Renders a frame, with its own counts.
    pub(super) fn frame(&mut self, progress: &(dyn Fn(f64) + Sync)) -> Result<(Picture, Counts), Failure> {
        match self {
            Self::Reference(renderer) => Ok(renderer.again(progress)),
            #[cfg(feature = "gpu")]
            Self::Gpu(frames) => frames.frame(progress),
        }
    }
}
