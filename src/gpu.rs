//! Pictures of jobs on graphics cards.

use crate::Failure;
use crate::frames::Frames;
use crate::job::{Job, SceneVariant, render_failure, room_for_picture};
use crate::stippling::PointTest;
use drypoint_gpu::{CardInputs, CardRenderer};
pub use drypoint_gpu::{Gpu, GpuError, Interpolation, Precision, ShaderKernel, wgpu};
pub use drypoint_gpu::{HiddenPoints, Hiding, UploadedVolume};
use drypoint_reference::ray::lattice::samples_in;
use drypoint_reference::ray::{measure, within_planes};
use drypoint_reference::surface::IsoSurface;
use drypoint_scene::counts::Counts;
use drypoint_scene::file::Given;
use drypoint_scene::fragments::Fragments;
use drypoint_scene::inputs::Inputs;
use drypoint_scene::measured::Measured;
use drypoint_scene::picture::Picture;
use drypoint_scene::plan::{Pass, Plan};
use drypoint_scene::shot::Shot;
use drypoint_scene::space::Grid;
use drypoint_scene::tables::Scene;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A job whose volume is uploaded to a graphics card.
pub struct GpuJob<'a> {
    job: &'a Job,
    gpu: &'a Gpu,
    uploaded: Uploaded,
}

/// Data of a shot on a graphics card.
struct Uploaded {
    shot: Shot,
    /// The facts of the volume, then those of the parts of objects. Their numbers are on the card.
    measured: Vec<Measured>,
    /// The volume, then those that objects have of their own.
    volumes: Vec<UploadedVolume>,
    /// For each entry of `measured`, the index of its volume in `volumes`.
    places: Vec<usize>,
    /// For each entry of `measured`, the volume that was measured.
    of: Vec<Arc<drypoint_scene::volume::Volume>>,
    /// Whether frames can have lines inside the volume.
    has_lines: bool,
}

impl Uploaded {
    /// Measures the data of a job's shot, without a renderer, and uploads them.
    fn new(
        (job, gpu): (&Job, &Gpu),
        shot: Shot,
        (scene, plan): (&Scene, &Plan),
        precision: Precision,
    ) -> Result<Self, Failure> {
        let measured = measure(&shot, &job.inputs(&shot)).map_err(|error| render_failure(&error, scene))?;
        let (mut volumes, mut places) = (Vec::new(), Vec::<usize>::new());
        for (i, own) in measured.iter().enumerate() {
            // Objects of one volume share its numbers.
            let same = measured[..i].iter().position(|other| Arc::ptr_eq(&other.numbers, &own.numbers));
            places.push(same.map_or(volumes.len(), |same| places[same]));
            if same.is_none() {
                volumes.push(UploadedVolume::new(gpu, own, precision).map_err(|error| failure(&error, &scene.given))?);
            }
        }
        let measured = measured.into_iter().map(Measured::without_numbers).collect();
        let has_lines = plan.has_pass(Pass::MergedStrokes);
        let of = job.volumes(&shot).cloned().collect();
        Ok(Self { shot, measured, volumes, places, of, has_lines })
    }

    /// The data of a job with their facts.
    fn inputs<'i>(&'i self, data: &'i Inputs<'i>) -> CardInputs<'i> {
        CardInputs { data, measured: &self.measured, places: &self.places, has_lines: self.has_lines }
    }

    /// Whether the volumes are those of a job's shot.
    fn are_of(&self, job: &Job, shot: &Shot) -> bool {
        self.of.iter().map(Arc::as_ptr).eq(job.volumes(shot).map(Arc::as_ptr))
    }
}

impl<'a> GpuJob<'a> {
    /// Measures the volume of a job and uploads it.
    ///
    /// # Errors
    /// The errors of [`Job::renderer`], and those of the adapter.
    pub fn new(job: &'a Job, gpu: &'a Gpu, precision: Precision) -> Result<Self, Failure> {
        Self::upload((job, gpu), job.shot()?, (&job.scene, &job.plan), precision)
    }

    /// Measures the volume of a job for a scene with other knobs, and uploads it.
    ///
    /// # Errors
    /// The errors of [`GpuJob::new`].
    pub fn of(job: &'a Job, gpu: &'a Gpu, variant: &SceneVariant, precision: Precision) -> Result<Self, Failure> {
        Self::upload((job, gpu), job.shot_of(variant)?, (&variant.scene, &variant.plan), precision)
    }

    fn upload(
        (job, gpu): (&'a Job, &'a Gpu),
        shot: Shot,
        (scene, plan): (&Scene, &Plan),
        precision: Precision,
    ) -> Result<Self, Failure> {
        has_room(job, scene, plan)?;
        Ok(Self { job, gpu, uploaded: Uploaded::new((job, gpu), shot, (scene, plan), precision)? })
    }

    /// Returns a renderer of the job's picture.
    ///
    /// # Errors
    /// An effect has no shader, or the adapter fails.
    pub fn renderer(&self) -> Result<CardRenderer, Failure> {
        self.edited(&|text| text)
    }

    /// Returns the text of the shader with numbers of a precision.
    ///
    /// # Errors
    /// An effect has no shader.
    pub fn text(&self, precision: Precision) -> Result<String, Failure> {
        let data = self.job.inputs(&self.uploaded.shot);
        let text = CardRenderer::text(self.gpu, precision, &self.uploaded.shot, &self.uploaded.inputs(&data));
        text.map_err(|error| self.failure(&error))
    }

    /// Returns a renderer with an edited shader. Tests use it to check that a comparison notices a fault.
    ///
    /// # Errors
    /// The errors of [`GpuJob::renderer`].
    pub fn edited(&self, edit: &dyn Fn(String) -> String) -> Result<CardRenderer, Failure> {
        let Uploaded { shot, volumes, .. } = &self.uploaded;
        let data = self.job.inputs(shot);
        let renderer = CardRenderer::edited(self.gpu, volumes, shot, &self.uploaded.inputs(&data), edit);
        renderer.map_err(|error| self.failure(&error))
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
        failure(error, &self.job.scene.given)
    }
}

/// Frames of a job on a graphics card. They own their data, so that a viewer can keep them beside a job that changes.
pub struct GpuFrames {
    gpu: Gpu,
    uploaded: Uploaded,
    renderer: CardRenderer,
    grid: Grid,
    /// The keys of the scene, for errors.
    given: Given,
    /// The size of the following frames.
    drawn: [usize; 2],
    /// The texture of a viewer, if a frame has been shown.
    shown: Option<wgpu::Texture>,
}

impl GpuFrames {
    /// Uploads the volume of a job and prepares its shader.
    ///
    /// # Errors
    /// The errors of [`Job::renderer`], an effect without a shader, and errors of the adapter.
    pub fn new(job: &Job, gpu: &Gpu) -> Result<Self, Failure> {
        Self::of_job(GpuJob::new(job, gpu, Precision::Single)?)
    }

    /// Prepares frames of a scene with other knobs.
    ///
    /// # Errors
    /// The errors of [`GpuFrames::new`].
    pub fn of(job: &Job, gpu: &Gpu, variant: &SceneVariant) -> Result<Self, Failure> {
        Self::of_job(GpuJob::of(job, gpu, variant, Precision::Single)?)
    }

    fn of_job(on_gpu: GpuJob<'_>) -> Result<Self, Failure> {
        let (renderer, GpuJob { job, gpu, uploaded }) = (on_gpu.renderer()?, on_gpu);
        let (grid, given, drawn) = (job.volume.grid().clone(), job.scene.given.clone(), uploaded.shot.view.size);
        Ok(Self { gpu: gpu.clone(), uploaded, renderer, grid, given, drawn, shown: None })
    }

    /// Takes another scene for the following frames, for example after the user has moved a clip plane. Lines inside
    /// the volume are removed. Facts of volumes that both jobs share are kept, and so are the volumes on the card,
    /// unless the scene needs others ([`Shot::keeps_facts_of`]). Then everything is measured and uploaded anew, while
    /// the previous data are still in memory. Pipelines are kept if the shader's text stays the same
    /// ([`CardRenderer::change`]).
    ///
    /// # Errors
    /// The errors of [`GpuFrames::new`]. The frames then keep their previous scene.
    pub fn change(&mut self, job: &Job) -> Result<(), Failure> {
        self.take(job, job.shot()?, (&job.scene, &job.plan))
    }

    fn take(&mut self, job: &Job, shot: Shot, (scene, plan): (&Scene, &Plan)) -> Result<(), Failure> {
        let has_lines = plan.has_pass(Pass::MergedStrokes);
        has_room(job, scene, plan)?;
        if self.uploaded.are_of(job, &shot) && shot.keeps_facts_of(&self.uploaded.shot) {
            within_planes(&shot, job.volume.grid()).map_err(|error| render_failure(&error, scene))?;
            let data = job.inputs(&shot);
            let inputs = CardInputs { has_lines, ..self.uploaded.inputs(&data) };
            let changed = self.renderer.change(&self.uploaded.volumes, &shot, &inputs);
            changed.map_err(|error| failure(&error, &scene.given))?;
            (self.uploaded.shot, self.uploaded.has_lines) = (shot, has_lines);
        } else {
            let renewed = Uploaded::new((job, &self.gpu), shot, (scene, plan), Precision::Single)?;
            let data = job.inputs(&renewed.shot);
            let changed = self.renderer.change(&renewed.volumes, &renewed.shot, &renewed.inputs(&data));
            changed.map_err(|error| failure(&error, &scene.given))?;
            self.uploaded = renewed;
        }
        self.drawn = self.uploaded.shot.view.size;
        (self.grid, self.given) = (job.volume.grid().clone(), scene.given.clone());
        Ok(())
    }

    /// Returns the bytes of the volume's numbers on the card.
    pub fn bytes(&self) -> u64 {
        self.uploaded.volumes.iter().map(UploadedVolume::bytes).sum()
    }

    /// The texture of the last shown frame.
    pub fn shown(&self) -> Option<&wgpu::Texture> {
        self.shown.as_ref()
    }

    /// Returns an error of the adapter with the scene's key, if one is at fault.
    fn failure(&self, error: &GpuError) -> Failure {
        failure(error, &self.given)
    }
}

impl Frames for GpuFrames {
    fn samples(&self) -> f64 {
        let Shot { lattice, view, rays_across, .. } = &self.uploaded.shot;
        samples_in(lattice, view, &self.grid) * (rays_across * rays_across) as f64
    }

    fn rays_across(&self) -> usize {
        self.uploaded.shot.rays_across
    }

    fn merge(&mut self, lines: Option<Fragments>) -> Result<(), Failure> {
        self.renderer.merge(lines).map_err(|error| self.failure(&error))
    }

    fn turn(&mut self, shot: &Shot) -> Result<(), Failure> {
        let size = |shot: &Shot| (shot.view.size, shot.rays_across);
        let refines = |shot: &Shot| shot.refine_above.is_some();
        let old = &self.uploaded.shot;
        if size(shot) != size(old) && !self.renderer.takes_sizes() || refines(shot) && !refines(old) {
            let what = "frames with funnels or a picture behind them have one size on a graphics card";
            return Err(Failure::new(what, "--backend", "prepare frames of a scene of that size"));
        }
        self.renderer.turn(shot, &self.grid).map_err(|error| self.failure(&error))?;
        self.drawn = shot.view.size;
        Ok(())
    }

    fn change_to(&mut self, job: &Job, variant: &SceneVariant) -> Result<bool, Failure> {
        self.take(job, job.shot_of(variant)?, (&variant.scene, &variant.plan)).map(|()| true)
    }

    fn frame_until(
        &mut self,
        progress: &(dyn Fn(f64) + Sync),
        stop: &AtomicBool,
    ) -> Result<Option<(Picture, Counts)>, Failure> {
        let drawn = self.renderer.frame_until(progress, stop).map_err(|error| self.failure(&error))?;
        let Some(picture) = drawn else { return Ok(None) };
        let mut counts = Counts::default();
        let on_card = self.renderer.seconds().map_err(|error| self.failure(&error))?;
        counts.seconds.extend(on_card.map(|seconds| ("rays on the card".into(), seconds)));
        Ok(Some((picture, counts)))
    }

    fn show(&mut self) -> Result<Option<f64>, Failure> {
        let size = self.drawn.map(|n| n as u32);
        let shown = self.shown.take().filter(|texture| [texture.width(), texture.height()] == size);
        let texture = match shown {
            Some(texture) => texture,
            None => self.gpu.viewer_texture(self.drawn).map_err(|error| self.failure(&error))?,
        };
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        self.shown = Some(texture);
        let shown =
            self.renderer.frame_into(&view).and_then(|()| self.gpu.wait()).and_then(|()| self.renderer.seconds());
        shown.map_err(|error| self.failure(&error))
    }
}

/// Checks that there is memory for measuring and for the picture.
fn has_room(job: &Job, scene: &Scene, plan: &Plan) -> Result<(), Failure> {
    job.room_for_preparing(scene, plan)?;
    room_for_picture(scene, 0)
}

/// Prepares the test for points that a surface hides.
///
/// # Errors
/// Errors of the adapter.
pub(crate) fn point_test(job: &Job, gpu: &Gpu, surface: &IsoSurface<'_, '_>, near: f64) -> Result<PointTest, Failure> {
    let failure = |error: GpuError| Failure::new(error.to_string(), "--backend", remedy(&error));
    let measured = surface.measured();
    let volume = UploadedVolume::new(gpu, &measured, Precision::Single).map_err(failure)?;
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
/// There is no adapter, or it gives no device, or it lacks the interpolation.
pub fn open(interpolation: Interpolation) -> Result<Gpu, Failure> {
    let gpu = Gpu::new().and_then(|gpu| gpu.interpolating(interpolation));
    let place = match interpolation {
        Interpolation::Exact => "--backend gpu",
        Interpolation::Fast => "--backend gpu-fast",
    };
    gpu.map_err(|error| Failure::new(error.to_string(), place, remedy(&error)))
}

/// Returns an error of the adapter with the scene's key, if one is at fault.
fn failure(error: &GpuError, given: &Given) -> Failure {
    let place = match error {
        GpuError::Missing { key, .. } => given.position(key),
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
        GpuError::TooManyLists { .. }
        | GpuError::Missing { .. }
        | GpuError::NoDouble { .. }
        | GpuError::NoLines
        | GpuError::Material => "leave --backend out: the CPU renders it",
    }
}
