//! What a scene draws, frame by frame: the volume, points and lines over it, or either alone; and the files of that.

mod frame_writer;

use crate::Failure;
use crate::job::{Job, RenderTarget, provenance, render_failure};
use crate::marking::{MarkFrames, Marking};
use drypoint_output::paint::fragments;
use drypoint_reference::ray::Renderer;
use drypoint_scene::color::Rgba;
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::Marks;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::plan::Plan;
use drypoint_scene::tables::{Orbit, Scene};
use drypoint_scene::view::View;
use frame_writer::FrameWriter;
use std::path::Path;

/// A job made ready for any number of frames.
pub struct Drawing<'a> {
    job: &'a Job,
    first: View,
    orbit: Option<Orbit>,
    renderer: Option<Renderer<'a>>,
    marks: Option<MarkFrames<'a>>,
}

/// What a file has, and how it will be drawn.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WriteReport {
    /// Dots, and lines: with a plotter those that it draws, a dot that is larger than the nib among the dots.
    pub marks: [usize; 2],
    /// What a plotter will do, a sentence a layer.
    pub notes: Vec<String>,
}

/// One frame.
pub struct Frame {
    /// Its number, from 0.
    pub number: usize,
    /// The volume with what lies behind it, or a picture that lies behind points alone.
    pub picture: Option<Picture>,
    /// What is drawn over it.
    pub marks: Option<Marks>,
    /// How many lines are inside the picture.
    pub inside: usize,
}

impl<'a> Drawing<'a> {
    /// Prepares the rays, and the frames of the points and lines that were made of the job. What preparing took goes to `counts`.
    ///
    /// # Errors
    /// As [`Job::renderer`].
    pub fn new(job: &'a Job, marking: &'a Marking<'a>, counts: &mut Counts) -> Result<Self, Failure> {
        let renderer = if job.draws_volume() { Some(job.renderer()?) } else { None };
        if let Some(renderer) = &renderer {
            counts.add(renderer.prepared());
        }
        let marks = marking.frames(counts);
        Ok(Self { job, first: job.view()?, orbit: job.scene.orbit, renderer, marks })
    }

    /// The same with the volume's rays plane by plane; it shows nowhere.
    pub fn plane_by_plane(self) -> Self {
        Self { renderer: self.renderer.map(Renderer::plane_by_plane), ..self }
    }

    /// Number of frames: those of `[orbit]`, or one.
    pub fn frames(&self) -> usize {
        self.orbit.map_or(1, |orbit| orbit.frames)
    }

    /// About how many samples the rays of all frames have, if none is skipped; none where the volume is not drawn.
    pub fn samples(&self) -> Option<f64> {
        self.renderer.as_ref().map(|renderer| renderer.samples() * self.frames() as f64)
    }

    /// Draws a frame; what that took alone goes to its counts. `progress` hears the share of the rays that is done, from
    /// any thread.
    ///
    /// # Errors
    /// A camera so far away that sample planes are not told apart, a picture for which there is no memory.
    pub fn frame(&mut self, frame: usize, progress: &(dyn Fn(f64) + Sync)) -> Result<(Frame, Counts), Failure> {
        let scene = &self.job.scene;
        let mut counts = Counts::default();
        let view = match self.orbit {
            Some(orbit) => orbit.view(&self.first, &scene.camera, self.job.volume.grid(), frame),
            None => self.first.clone(),
        };
        let (mut marks, mut inside) = (None, 0);
        match (&mut self.marks, &mut self.renderer) {
            (Some(frames), Some(renderer)) => {
                let [over, merged] = frames.draw_apart(&view, &mut counts)?;
                inside = frame_writer::sums(&merged)[1];
                if inside > 0 {
                    let lines = fragments(&merged, &view, scene.picture.samples);
                    counts.preprocess.insert("places of lines on rays".into(), lines.len() as u64);
                    counts.bytes.insert("lines on rays".into(), lines.bytes() as u64);
                    renderer.merge(Some(lines));
                } else {
                    renderer.merge(None);
                }
                marks = Some(over);
            }
            (Some(frames), None) => marks = Some(frames.draw(&view, &mut counts)?),
            (None, _) => {}
        }
        let picture = match &mut self.renderer {
            Some(renderer) => {
                if self.orbit.is_some() {
                    let shot = self.job.shot_from(view)?;
                    renderer.turn(&shot).map_err(|error| render_failure(&error, scene))?;
                }
                let (picture, own) = renderer.again(progress);
                counts.add(&own);
                Some(picture)
            }
            None => self.job.background().map(|pixels| of_pixels(pixels, scene.picture.size)),
        };
        Ok((Frame { number: frame, picture, marks, inside }, counts))
    }
}

impl Frame {
    /// Dots, and lines.
    pub fn marks(&self) -> [usize; 2] {
        let [dots, lines] = self.marks.as_ref().map(frame_writer::sums).unwrap_or_default();
        [dots, lines + self.inside]
    }

    /// The frame in pixels, with its points and lines painted over the layer `beauty`: the page with its margin where points
    /// and lines are all that is target, and else a picture of the scene's size.
    ///
    /// # Errors
    /// A picture of no or too many pixels.
    pub fn painted(self, job: &Job) -> Result<Picture, Failure> {
        FrameWriter::of(job, self.number).painted(self.picture, self.marks.as_ref())
    }

    /// Writes the frame by the suffix; the file appears whole or not at all. A list has the dots, or where strokes are target the lines, as they are, whatever draws them.
    ///
    /// # Errors
    /// What the operating system refuses, or a picture of no or too many pixels.
    pub fn write(self, job: &Job, path: &Path) -> Result<WriteReport, Failure> {
        FrameWriter::of(job, self.number).write(self, path)
    }
}

/// Writes marks on the page of a scene, as [`Frame::write`] does; a list has strokes where those are target, else dots.
///
/// # Errors
/// As [`Frame::write`].
pub fn write_page(marks: Marks, scene: &Scene, target: RenderTarget, path: &Path) -> Result<WriteReport, Failure> {
    let provenance = provenance(scene, &Plan::of_marks(scene));
    let frame = Frame { number: 0, picture: None, marks: Some(marks), inside: 0 };
    FrameWriter { scene, target, provenance }.write(frame, path)
}

/// Checks that the memory budget allows the pixels of a file, before anything is drawn for it. A vector file has none.
///
/// # Errors
/// A page of no or too many pixels.
pub fn room_for_page(job: &Job, path: &Path) -> Result<(), Failure> {
    // Where rays draw, preparing them asks for their picture.
    if job.draws_volume() { Ok(()) } else { FrameWriter::of(job, 0).room(path) }
}

/// Writes frames as one SVG that shows them in turn, over and over. Each frame is drawn by `draw` when its turn to be
/// written comes, so that one at a time is in memory.
///
/// # Errors
/// Errors of `draw`, and of the operating system.
pub fn write_animation(
    job: &Job,
    frames: usize,
    path: &Path,
    draw: impl FnMut(usize) -> Result<Frame, Failure>,
) -> Result<(), Failure> {
    FrameWriter::of(job, 0).write_animation(frames, path, draw)
}

/// Premultiplied pixels as a picture.
fn of_pixels(pixels: &[Rgba], [width, height]: [usize; 2]) -> Picture {
    let channels = (0..4).map(|c| pixels.iter().map(|pixel| pixel[c]).collect()).collect();
    Picture { width, height, layers: vec![Layer { kind: LayerKind::Beauty, channels }] }
}
