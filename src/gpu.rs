//! Pictures of jobs on graphics cards.

use crate::Failure;
use crate::job::{Job, KnobVariant, render_failure, room_for_picture};
use crate::stippling::PointTest;
use drypoint_gpu::{CardInputs, Renderer};
pub use drypoint_gpu::{Gpu, GpuError, Interpolation, Kernel, Precision, wgpu};
pub use drypoint_gpu::{HiddenPoints, Hiding, Volume};
use drypoint_reference::ray::lattice::samples_in;
use drypoint_reference::ray::measure;
use drypoint_reference::surface::IsoSurface;
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragments;
use drypoint_scene::measured::Measured;
use drypoint_scene::picture::Picture;
use drypoint_scene::plan::{Pass, Plan};
use drypoint_scene::shot::Shot;
use drypoint_scene::tables::Scene;
use std::sync::Arc;

/// A job whose volume lies on a graphics card.
pub struct GpuJob<'a> {
    job: &'a Job,
    gpu: &'a Gpu,
    shot: Shot,
    /// The facts of the volume, then of those of the parts of objects.
    measured: Vec<Measured>,
    /// The volume, then those that objects have of their own.
    volumes: Vec<Volume>,
    /// For each entry of `measured` the place of its volume.
    places: Vec<usize>,
    /// Whether frames can have lines inside the volume.
    has_lines: bool,
}

impl<'a> GpuJob<'a> {
    /// Measures the volume of a job and uploads it.
    ///
    /// # Errors
    /// Same errors as [`Job::renderer`], and those of the adapter.
    pub fn new(job: &'a Job, gpu: &'a Gpu, precision: Precision) -> Result<Self, Failure> {
        let shot = job.shot()?;
        let measured = measured(job, &job.scene, &job.plan, &shot)?;
        Self::upload(job, gpu, shot, measured, &job.plan, precision)
    }

    /// Measures the volume of a job for a scene with other knobs, and uploads it.
    ///
    /// # Errors
    /// Same errors as [`GpuJob::new`].
    pub fn of(job: &'a Job, gpu: &'a Gpu, variant: &KnobVariant, precision: Precision) -> Result<Self, Failure> {
        let shot = job.shot_of(variant)?;
        let measured = measured(job, &variant.scene, &variant.plan, &shot)?;
        Self::upload(job, gpu, shot, measured, &variant.plan, precision)
    }

    fn upload(
        job: &'a Job,
        gpu: &'a Gpu,
        shot: Shot,
        measured: Vec<Measured>,
        plan: &Plan,
        precision: Precision,
    ) -> Result<Self, Failure> {
        let (mut volumes, mut places) = (Vec::new(), Vec::<usize>::new());
        for (i, own) in measured.iter().enumerate() {
            // Objects of one volume share its numbers.
            let same = measured[..i].iter().position(|other| Arc::ptr_eq(&other.numbers, &own.numbers));
            places.push(same.map_or(volumes.len(), |same| places[same]));
            if same.is_none() {
                volumes.push(Volume::new(gpu, own, precision).map_err(|error| failure(&error, job))?);
            }
        }
        Ok(Self { job, gpu, shot, measured, volumes, places, has_lines: plan.has_pass(Pass::MergedStrokes) })
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
        let (measured, places, has_lines) = (&self.measured, &self.places, self.has_lines);
        let inputs = CardInputs { data: &self.job.inputs(&self.shot), measured, places, has_lines };
        let renderer = Renderer::edited(self.gpu, &self.volumes, &self.shot, &inputs, edit);
        renderer.map_err(|error| failure(&error, self.job))
    }

    /// Draws one frame.
    ///
    /// # Errors
    /// Same errors as [`GpuJob::renderer`].
    pub fn frame(&self, progress: &dyn Fn(f64)) -> Result<Picture, Failure> {
        self.renderer()?.frame(progress).map_err(|error| self.failure(&error))
    }

    /// Returns an error of a renderer with the scene's key, if one is at fault.
    pub fn failure(&self, error: &GpuError) -> Failure {
        failure(error, self.job)
    }
}

/// Frames of a job on a graphics card.
pub struct GpuFrames<'a> {
    job: &'a Job,
    gpu: &'a Gpu,
    renderer: Renderer<'a>,
    /// A viewer's texture, where frames are shown.
    shown: Option<wgpu::Texture>,
    samples: f64,
    rays_across: usize,
    bytes: u64,
}

impl<'a> GpuFrames<'a> {
    /// Uploads the volume of a job and prepares its shader.
    ///
    /// # Errors
    /// Same errors as [`Job::renderer`], an effect without a shader, and errors of the adapter.
    pub fn new(job: &'a Job, gpu: &'a Gpu) -> Result<Self, Failure> {
        Self::of_job(&GpuJob::new(job, gpu, Precision::Single)?)
    }

    /// Prepares frames of a scene with other knobs.
    ///
    /// # Errors
    /// Same errors as [`GpuFrames::new`].
    pub fn of(job: &'a Job, gpu: &'a Gpu, variant: &KnobVariant) -> Result<Self, Failure> {
        Self::of_job(&GpuJob::of(job, gpu, variant, Precision::Single)?)
    }

    fn of_job(on_gpu: &GpuJob<'a>) -> Result<Self, Failure> {
        let (job, shot, renderer) = (on_gpu.job, &on_gpu.shot, on_gpu.renderer()?);
        let rays = (shot.rays_across * shot.rays_across) as f64;
        let samples = samples_in(&shot.lattice, &shot.view, job.volume.grid()) * rays;
        Ok(Self {
            job,
            gpu: on_gpu.gpu,
            renderer,
            shown: None,
            samples,
            rays_across: shot.rays_across,
            bytes: on_gpu.volumes.iter().map(Volume::bytes).sum(),
        })
    }

    /// Returns about how many samples a frame has without skipping.
    pub fn samples(&self) -> f64 {
        self.samples
    }

    /// Returns the bytes of the volume's numbers on the card.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Returns n of the n×n rays of a pixel, before it is refined.
    pub fn rays_across(&self) -> usize {
        self.rays_across
    }

    /// Puts lines inside the frames that follow, or takes them out.
    ///
    /// # Errors
    /// Lines in a scene whose plan has none inside the volume.
    pub fn merge(&mut self, lines: Option<Fragments>) -> Result<(), Failure> {
        self.renderer.merge(lines).map_err(|error| failure(&error, self.job))
    }

    /// Takes the camera and the lights of another shot of the job.
    ///
    /// # Errors
    /// A camera too far away.
    pub fn turn(&mut self, shot: &Shot) -> Result<(), Failure> {
        self.renderer.turn(shot, self.job.volume.grid()).map_err(|error| failure(&error, self.job))
    }

    /// Draws a frame into a texture, as a viewer does, and waits for it. Returns the seconds of its rays by the adapter's
    /// clock; none where it has no clock.
    ///
    /// # Errors
    /// Errors of the adapter, and a picture without a beauty.
    pub fn show(&mut self) -> Result<Option<f64>, Failure> {
        let texture = match self.shown.take() {
            Some(texture) => texture,
            None => {
                let texture = self.gpu.viewer_texture(self.job.scene.picture.size);
                texture.map_err(|error| failure(&error, self.job))?
            }
        };
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        self.shown = Some(texture);
        let shown =
            self.renderer.frame_into(&view).and_then(|()| self.gpu.wait()).and_then(|()| self.renderer.seconds());
        shown.map_err(|error| failure(&error, self.job))
    }

    /// The texture of the last frame that was shown.
    pub fn shown(&self) -> Option<&wgpu::Texture> {
        self.shown.as_ref()
    }

    /// Draws a frame, with its own counts.
    ///
    /// # Errors
    /// Errors of the adapter.
    pub fn frame(&mut self, progress: &dyn Fn(f64)) -> Result<(Picture, Counts), Failure> {
        let picture = self.renderer.frame(progress).map_err(|error| failure(&error, self.job))?;
        let mut counts = Counts::default();
        let on_card = self.renderer.seconds().map_err(|error| failure(&error, self.job))?;
        counts.seconds.extend(on_card.map(|seconds| ("rays on the card".into(), seconds)));
        Ok((picture, counts))
    }
}

/// Measures the data of a shot of a job, which needs no renderer.
fn measured(job: &Job, scene: &Scene, plan: &Plan, shot: &Shot) -> Result<Vec<Measured>, Failure> {
    job.room_for_preparing(scene, plan)?;
    room_for_picture(scene, 0)?;
    measure(shot, &job.inputs(shot)).map_err(|error| render_failure(&error, scene))
}

/// Prepares the test of which points a surface hides.
///
/// # Errors
/// Errors of the adapter.
pub(crate) fn point_test<'a>(
    job: &Job,
    gpu: &'a Gpu,
    surface: &IsoSurface<'_, '_>,
    near: f64,
) -> Result<PointTest<'a>, Failure> {
    let failure = |error: GpuError| Failure::new(error.to_string(), "--backend", remedy(&error));
    let measured = surface.measured();
    let volume = Volume::new(gpu, &measured, Precision::Single).map_err(failure)?;
    let hiding = Hiding {
        volume: &job.volume,
        measured: &measured,
        reconstruction: surface.field().reconstruction(),
        iso: surface.iso(),
        clip: surface.clip(),
        perspective: job.view()?.perspective,
        near,
    };
    let mut test = HiddenPoints::new(gpu, &volume, &hiding).map_err(failure)?;
    Ok(Box::new(move |view, in_front, points| test.hidden(view, in_front, points).map_err(failure)))
}

/// Opens the adapter.
///
/// # Errors
/// No adapter, one that gives no device, or one without the unit that interpolates.
pub fn open(interpolation: Interpolation) -> Result<Gpu, Failure> {
    let gpu = Gpu::new().and_then(|gpu| gpu.interpolating(interpolation));
    let place = match interpolation {
        Interpolation::Exact => "--backend gpu",
        Interpolation::Fast => "--backend gpu-fast",
    };
    gpu.map_err(|error| Failure::new(error.to_string(), place, remedy(&error)))
}

/// Returns an error of the adapter with the scene's key, if one is at fault.
fn failure(error: &GpuError, job: &Job) -> Failure {
    let place = match error {
        GpuError::Missing { key, .. } => job.scene.given.position(key),
        _ => "--backend".into(),
    };
    Failure::new(error.to_string(), place, remedy(error))
}

/// The remedy of an error.
fn remedy(error: &GpuError) -> &'static str {
    match error {
        GpuError::NoAdapter | GpuError::NoDevice { .. } => {
            "install a Vulkan driver (on Debian without a graphics card: mesa-vulkan-drivers), or leave --backend out"
        }
        GpuError::TooLarge { .. } => "write volume.stride = 2, or leave --backend out: the CPU has more memory",
        GpuError::TooManyBytes { .. } | GpuError::OutOfMemory { .. } => {
            "write a smaller picture.size or volume.stride = 2, or leave --backend out: the CPU has more memory"
        }
        GpuError::Unfinished { .. } => "take fewer rays a pixel or a larger sampling.step, or leave --backend out",
        GpuError::NoFilter { .. } => "write --backend gpu: the shader interpolates then",
        GpuError::TooManyPlanes { .. } => "take a larger sampling.step, or move the eye closer",
        GpuError::Lost { .. } | GpuError::Refused { .. } => "update the driver, or leave --backend out",
        GpuError::Missing { .. } | GpuError::NoDouble { .. } | GpuError::NoLines | GpuError::Material => {
            "leave --backend out: the CPU renders it"
        }
    }
}
