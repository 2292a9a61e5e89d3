//! Pictures of jobs on graphics cards.

use crate::Failure;
use crate::job::Job;
pub use drypoint_gpu::{Gpu, GpuError, Kernel, Precision};
use drypoint_gpu::{Inputs, Renderer, Volume};
use drypoint_scene::measured::Measured;
use drypoint_scene::picture::Picture;
use drypoint_scene::shot::Shot;

/// A job whose volume lies on a graphics card.
pub struct GpuJob<'a> {
    job: &'a Job,
    gpu: &'a Gpu,
    shot: Shot,
    measured: Measured,
    volume: Volume,
}

impl<'a> GpuJob<'a> {
    /// Measures the volume of a job and uploads it.
    ///
    /// # Errors
    /// Same errors as [`Job::renderer`], and those of the adapter.
    pub fn new(job: &'a Job, gpu: &'a Gpu, precision: Precision) -> Result<Self, Failure> {
        let shot = job.shot()?;
        let measured = job.renderer()?.measured(&shot);
        let volume = Volume::new(gpu, &measured, precision).map_err(|error| failure(&error, job))?;
        Ok(Self { job, gpu, shot, measured, volume })
    }

    /// Returns a renderer of the job's picture.
    ///
    /// # Errors
    /// An effect without a shader, and errors of the adapter.
    pub fn renderer(&self) -> Result<Renderer<'a>, Failure> {
        self.edited(&|text| text)
    }

    /// Returns a renderer with an edited shader, for tests of whether a comparison notices a fault.
    ///
    /// # Errors
    /// Same errors as [`GpuJob::renderer`].
    pub fn edited(&self, edit: &dyn Fn(String) -> String) -> Result<Renderer<'a>, Failure> {
        let inputs = Inputs {
            volume: &self.job.volume,
            measured: &self.measured,
            labels: self.job.labels.as_ref(),
            further: self.job.further.each_ref().map(Option::as_ref),
            styles: &self.job.styles,
            background: self.job.backdrop(&self.shot),
        };
        let renderer = Renderer::edited(self.gpu, &self.volume, &self.shot, &inputs, edit);
        renderer.map_err(|error| failure(&error, self.job))
    }

    /// Draws one frame.
    ///
    /// # Errors
    /// Same errors as [`GpuJob::renderer`].
    pub fn frame(&self, progress: &dyn Fn(f64)) -> Result<Picture, Failure> {
        self.renderer()?.frame(progress).map_err(|error| failure(&error, self.job))
    }
}

/// Opens the adapter.
///
/// # Errors
/// No adapter, or one that gives no device.
pub fn open() -> Result<Gpu, Failure> {
    Gpu::new().map_err(|error| Failure::new(error.to_string(), "--backend gpu", remedy(&error)))
}

/// Returns an error of the adapter with the scene's key, if one is at fault.
fn failure(error: &GpuError, job: &Job) -> Failure {
    let place = match error {
        GpuError::Missing { key, .. } => job.scene.given.position(key),
        _ => "--backend gpu".into(),
    };
    Failure::new(error.to_string(), place, remedy(error))
}

/// What to do about an error.
fn remedy(error: &GpuError) -> &'static str {
    match error {
        GpuError::NoAdapter | GpuError::NoDevice { .. } => {
            "install a Vulkan driver (on Debian without a graphics card: mesa-vulkan-drivers), or leave --backend out"
        }
        GpuError::TooLarge { .. } | GpuError::TooManyBytes { .. } | GpuError::OutOfMemory { .. } => {
            "write volume.stride = 2, or leave --backend out: the CPU has more memory"
        }
        GpuError::TooManyPlanes { .. } => "take a larger sampling.step, or move the eye closer",
        GpuError::Lost { .. } | GpuError::Refused { .. } => "update the driver, or leave --backend out",
        GpuError::Missing { .. } | GpuError::NoDouble { .. } | GpuError::Material => {
            "leave --backend out: the CPU renders it"
        }
    }
}
