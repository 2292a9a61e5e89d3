//! Frames of a scene and their files: the volume with points and lines over it, or either alone.

mod frame_writer;

use crate::Failure;
use crate::annotating::Annotating;
use crate::backend::frames;
use crate::frames::Frames;
use crate::gpu::Gpu;
use crate::job::{Job, RenderTarget, provenance, render_failure};
use crate::marking::{MarkFrames, Marking, add};
use drypoint_output::paint::{fragments, overlay};
use drypoint_reference::ray::Renderer;
use drypoint_scene::color::Rgba;
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Marks, Page, mark_counts};
use drypoint_scene::picture::{Layer, LayerKind, Picture, Provenance};
use drypoint_scene::plan::Plan;
use drypoint_scene::shot::Shot;
use drypoint_scene::tables::{Orbit, Scene};
use drypoint_scene::view::View;
use frame_writer::FrameWriter;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// A job prepared for any number of frames.
pub struct Drawing<'a> {
    job: &'a Job,
    first: View,
    orbit: Option<Orbit>,
    /// The shot of the first camera, if other frames only have other cameras.
    shot: Option<Shot>,
    /// The frame whose scene is prepared; none after a failure. It matters if frames have scenes of their own.
    prepared: Option<usize>,
    draws_volume: bool,
    renderer: Option<Box<dyn Frames + 'a>>,
    marks: Option<MarkFrames<'a>>,
    annotations: Option<Annotating<'a>>,
    /// The reference's renderer for annotations that the volume may hide, if other frames draw the volume.
    sight: Option<Renderer<'a>>,
}

/// Contents of a written file, and notes about them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WriteReport {
    /// Numbers of dots and lines. With a plotter these are the drawn ones; a filled dot counts as a dot.
    pub marks: [usize; 2],
    /// Notes for the user: a plotter's plan, a sentence a layer, or what a list leaves out.
    pub notes: Vec<String>,
}

/// One frame.
pub struct Frame {
    /// Number of the frame, from 0.
    pub number: usize,
    /// The volume with its background, or a picture behind points alone.
    pub picture: Option<Picture>,
    /// Marks over the picture.
    pub marks: Option<Marks>,
    /// Number of lines inside the picture.
    pub inside: usize,
    /// Annotations that are left out, a sentence each.
    pub notes: Vec<String>,
}

impl<'a> Drawing<'a> {
    /// Prepares the rays, and the frames of the job's points and lines. Adds the cost of the preparation to `counts`.
    ///
    /// # Errors
    /// The errors of [`Job::renderer`].
    pub fn new(job: &'a Job, marking: &'a Marking<'a>, counts: &mut Counts) -> Result<Self, Failure> {
        Self::on(job, marking, None, counts)
    }

    /// Like [`Drawing::new`], but a graphics card, if there is one, draws the volume and tests points for visibility.
    ///
    /// # Errors
    /// The errors of [`Job::renderer`], and those of the adapter.
    pub fn on(
        job: &'a Job,
        marking: &'a Marking<'a>,
        card: Option<&'a Gpu>,
        counts: &mut Counts,
    ) -> Result<Self, Failure> {
        let renderer = job.draws_volume().then(|| frames(job, None, card, counts)).transpose()?;
        let mut drawing = Self::with_frames(job, marking, renderer, counts)?;
        if let (Some(marks), Some(gpu)) = (&mut drawing.marks, card) {
            marks.on_gpu(job, gpu)?;
        }
        Ok(drawing)
    }

    /// Like [`Drawing::new`], but with frames of the volume that are already prepared. Without frames the volume is not
    /// drawn.
    ///
    /// # Errors
    /// The camera has no direction, or a legend has a wrong number of names.
    pub fn with_frames(
        job: &'a Job,
        marking: &'a Marking<'a>,
        renderer: Option<Box<dyn Frames + 'a>>,
        counts: &mut Counts,
    ) -> Result<Self, Failure> {
        let marks = marking.frames(counts);
        let (first, orbit) = (job.view()?, job.scene.orbit);
        let draws_volume = renderer.is_some();
        let shot = orbit.filter(|_| draws_volume && !job.moves_selections()).map(|_| job.shot()).transpose()?;
        let annotations = Annotating::new(job)?;
        let asks_rays = annotations.as_ref().is_some_and(Annotating::asks_rays);
        let is_on_card = renderer.as_ref().is_some_and(|renderer| renderer.reference().is_none());
        let sight = (asks_rays && is_on_card).then(|| job.renderer()).transpose()?;
        Ok(Self { job, first, orbit, shot, prepared: Some(0), draws_volume, renderer, marks, annotations, sight })
    }

    /// Keeps labels and what stands in the margin off rectangles of the page, in mm.
    pub(crate) fn keep_labels_off(&mut self, rectangles: Vec<[DVec2; 2]>) {
        if let Some(annotations) = &mut self.annotations {
            annotations.insets = rectangles;
        }
    }

    /// Turns to another camera, which sees the points and lines that were made for the job's camera.
    ///
    /// # Errors
    /// The errors of [`Job::shot`].
    pub fn turn(&mut self, view: View) -> Result<(), Failure> {
        if self.job.moves_selections() {
            self.prepared = None;
        } else if self.draws_volume && self.shot.is_none() {
            self.shot = Some(self.job.shot()?);
        }
        self.first = view;
        Ok(())
    }

    /// Returns the number of frames: those of `[orbit]`, or one.
    pub fn frames(&self) -> usize {
        self.orbit.map_or(1, |orbit| orbit.frames)
    }

    /// Returns about how many samples the rays of all frames have without skipping. Returns none if the volume is not
    /// drawn.
    pub fn samples(&self) -> Option<f64> {
        self.renderer.as_ref().map(|renderer| renderer.samples() * self.frames() as f64)
    }

    /// Draws a frame and returns it with its own counts. `progress` receives the finished share of the rays, on any
    /// thread.
    ///
    /// # Errors
    /// The camera is so far away that sample planes coincide, or there is no memory for the picture.
    pub fn frame(&mut self, frame: usize, progress: &(dyn Fn(f64) + Sync)) -> Result<(Frame, Counts), Failure> {
        let frame = self.frame_until(frame, progress, &AtomicBool::new(false))?;
        Ok(frame.unwrap_or_else(|| unreachable!("nothing stops the frame")))
    }

    /// Like [`Drawing::frame`], but returns none if the frame is stopped. See [`Frames::frame_until`].
    ///
    /// # Errors
    /// The errors of [`Drawing::frame`].
    pub fn frame_until(
        &mut self,
        frame: usize,
        progress: &(dyn Fn(f64) + Sync),
        stop: &AtomicBool,
    ) -> Result<Option<(Frame, Counts)>, Failure> {
        let scene = &self.job.scene;
        let mut counts = Counts::default();
        let view = match self.orbit {
            Some(orbit) => orbit.view(&self.first, &scene.camera, self.job.volume.grid(), frame),
            None => self.first.clone(),
        };
        self.prepare(frame, &view, &mut counts)?;
        // Marks of the frame. Lines inside the volume become fragments on its rays; the others stay over the picture.
        let (mut marks, mut inside) = (None, 0);
        match (&mut self.marks, &mut self.renderer) {
            (Some(frames), Some(renderer)) => {
                let [over, merged] = frames.draw_apart(&view, &mut counts)?;
                inside = mark_counts(&merged.layers)[1];
                if inside > 0 {
                    let lines = fragments(&merged, &view, renderer.rays_across());
                    counts.preprocess.insert("places of lines on rays".into(), lines.len() as u64);
                    counts.bytes.insert("lines on rays".into(), lines.bytes() as u64);
                    renderer.merge(Some(lines))?;
                } else {
                    renderer.merge(None)?;
                }
                marks = Some(over);
            }
            (Some(frames), None) => marks = Some(frames.draw(&view, &mut counts)?),
            (None, _) => {}
        }
        // The volume from the frame's camera, or the picture behind the marks.
        let mut picture = match &mut self.renderer {
            Some(renderer) => {
                if let Some(shot) = &self.shot {
                    let shot = shot.seen_from(view.clone());
                    renderer.turn(&shot)?;
                    if let Some(sight) = &mut self.sight {
                        sight.turn(&shot).map_err(|error| render_failure(&error, scene))?;
                    }
                }
                let start = Instant::now();
                let Some((picture, own)) = renderer.frame_until(progress, stop)? else { return Ok(None) };
                counts.add(&own);
                counts.seconds.insert("rays".into(), start.elapsed().as_secs_f64());
                Some(picture)
            }
            None => self.job.background.as_ref().map(|pixels| of_pixels(pixels, scene.picture.size)),
        };
        // Annotations over both.
        let mut notes = Vec::new();
        if let Some(annotations) = &mut self.annotations {
            let start = Instant::now();
            let of_frames = self.renderer.as_ref().and_then(|renderer| renderer.reference());
            let drawn = annotations.draw(&view, of_frames.or(self.sight.as_ref()))?;
            let marks = marks.get_or_insert_with(|| Marks { page: Page::of(scene), layers: Vec::new() });
            drawn.layers.into_iter().for_each(|layer| add(&mut marks.layers, layer));
            if let Some(picture) = &mut picture {
                let mut lay = |over| overlay(over, scene.picture.blend_space, picture);
                drawn.overlays.iter().try_for_each(&mut lay).map_err(|error| Failure::picture(&error, "a legend"))?;
            }
            notes = drawn.notes;
            counts.seconds.insert("annotations".into(), start.elapsed().as_secs_f64());
        }
        Ok(Some((Frame { number: frame, picture, marks, inside, notes }, counts)))
    }

    /// Prepares the scene of a frame, if frames have scenes of their own.
    fn prepare(&mut self, frame: usize, view: &View, counts: &mut Counts) -> Result<(), Failure> {
        if !self.job.moves_selections() || self.prepared == Some(frame) {
            return Ok(());
        }
        self.prepared = None;
        let variant = self.job.seen_from(view.clone())?;
        let is_changed = match &mut self.renderer {
            Some(renderer) => renderer.change_to(self.job, &variant)?,
            None => !self.draws_volume,
        };
        if !is_changed {
            // Memory has room for one renderer.
            self.renderer = None;
            self.renderer = Some(frames(self.job, Some(&variant), None, counts)?);
        }
        if let Some(sight) = &mut self.sight {
            *sight = self.job.renderer_of(&variant)?;
        }
        if let Some(annotations) = &mut self.annotations {
            annotations.objects = variant.scene.objects;
        }
        self.prepared = Some(frame);
        Ok(())
    }
}

impl Frame {
    /// Makes a frame of marks alone.
    pub(crate) fn of_marks(marks: Marks) -> Self {
        Self { number: 0, picture: None, marks: Some(marks), inside: 0, notes: Vec::new() }
    }

    /// Returns the numbers of dots and lines.
    pub fn marks(&self) -> [usize; 2] {
        let [dots, lines] = self.marks.as_ref().map(|marks| mark_counts(&marks.layers)).unwrap_or_default();
        [dots, lines + self.inside]
    }

    /// Returns the frame in pixels, with points and lines painted over the layer `beauty`. If only points and lines are
    /// drawn, it is the page with its margin. Otherwise it is a picture of the scene's size.
    ///
    /// # Errors
    /// The picture has no pixels or too many.
    pub fn painted(self, job: &Job) -> Result<Picture, Failure> {
        FrameWriter::of(job, self.number).painted(self.picture, self.marks.as_ref())
    }

    /// Writes the frame in the format of the suffix. The file appears whole or not at all. A list has the dots, or for
    /// [`RenderTarget::Strokes`] the lines, unchanged by pens or plotters.
    ///
    /// # Errors
    /// Errors of the operating system, or a picture of no or too many pixels.
    pub fn write(self, job: &Job, path: &Path) -> Result<WriteReport, Failure> {
        FrameWriter::of(job, self.number).write(self, path)
    }
}

/// Writes marks on the page of a scene, as [`Frame::write`] does. A list has strokes for [`RenderTarget::Strokes`],
/// else dots.
///
/// # Errors
/// Same errors as [`Frame::write`].
pub fn write_page(marks: Marks, scene: &Scene, target: RenderTarget, path: &Path) -> Result<WriteReport, Failure> {
    let provenance = provenance(scene, &Plan::of_marks(scene));
    let frame = Frame::of_marks(marks);
    FrameWriter { scene, target, provenance }.write(frame, path)
}

/// Writes a picture with marks over it on the page of a scene, as [`Frame::write`] does.
///
/// # Errors
/// Same errors as [`Frame::write`].
pub(crate) fn write_picture(
    picture: Option<Picture>,
    marks: Marks,
    scene: &Scene,
    provenance: Provenance,
    path: &Path,
) -> Result<WriteReport, Failure> {
    let frame = Frame { picture, ..Frame::of_marks(marks) };
    FrameWriter { scene, target: RenderTarget::Picture, provenance }.write(frame, path)
}

/// Paints marks over a picture on the page of a scene, as [`Frame::painted`] does.
///
/// # Errors
/// Same errors as [`Frame::painted`].
pub(crate) fn paint_picture(picture: Option<Picture>, marks: &Marks, scene: &Scene) -> Result<Picture, Failure> {
    let provenance = Provenance::default();
    FrameWriter { scene, target: RenderTarget::Picture, provenance }.painted(picture, Some(marks))
}

/// Checks that the memory budget allows the pixels of a file, before anything is drawn. A vector file has no pixels.
///
/// # Errors
/// A page of no or too many pixels.
pub fn room_for_page(job: &Job, path: &Path) -> Result<(), Failure> {
    // If rays draw, preparing them asks for their picture.
    if job.draws_volume() { Ok(()) } else { FrameWriter::of(job, 0).room(path) }
}

/// Writes frames as one GIF, APNG or SVG that shows them in turn, repeatedly. `draw` makes a frame when it is due, so
/// that only one is in memory.
///
/// # Errors
/// A suffix of another format, errors of `draw`, and of the operating system.
pub fn write_animation(
    job: &Job,
    frames: usize,
    path: &Path,
    draw: impl FnMut(usize) -> Result<Frame, Failure>,
) -> Result<(), Failure> {
    FrameWriter::of(job, 0).write_animation(frames, path, draw)
}

/// Returns premultiplied pixels as a picture.
fn of_pixels(pixels: &[Rgba], [width, height]: [usize; 2]) -> Picture {
    let channels = (0..4).map(|c| pixels.iter().map(|pixel| pixel[c]).collect()).collect();
    Picture { width, height, layers: vec![Layer { kind: LayerKind::Beauty, channels }] }
}
