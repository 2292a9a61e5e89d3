//! The dots and lines of a scene with `[stipples]` (Lu et al. 2002): made once, then drawn for any number of cameras.

mod pens;

use crate::Failure;
use crate::job::Job;
use drypoint_reference::field::{Field, Reconstruction, Rung};
use drypoint_reference::suggest;
use drypoint_reference::surface::IsoSurface;
use drypoint_reference::volume_stippling::{
    CurveVoxels, FrameDots, FrameInputs, Frames, PenTone, Preprocess, StippleError, StippleInputs, choose_on_page,
    joined, seen,
};
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Layer, Marks, Page, Pen};
use drypoint_scene::memory;
use drypoint_scene::plan::PointsPlan;
use drypoint_scene::points::Points;
use drypoint_scene::space::Grid;
use drypoint_scene::tables::{Even, Ink, Iso, Length, PointsPerPixel, Scene, Stipples};
use drypoint_scene::tone::Tone;
use drypoint_scene::view::View;
use pens::Pens;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// Points of a scene, made once from its first camera.
pub struct Stippling<'a> {
    setting: Setting<'a>,
    layers: Vec<Dots>,
    /// What draws lines: one of the layers' pens, or one of its own.
    line_pen: Pen,
    edges: Option<CurveVoxels>,
    /// Where the voxels of points and edges lie.
    grid: Grid,
    /// λa of dots of S_max in a face seen from the front, and how many voxels lie over each other in it ([STIP-17]).
    ink: [f64; 2],
    /// What hides points, and the value of its surface ([STIP-15]).
    hiding: Option<(Field<'a, f64>, f64)>,
}

/// Progress in making the points of a scene.
#[derive(Clone, Copy, Debug)]
pub struct PointsMade {
    /// The share that is made, in [0, 1].
    pub share: f64,
    /// Points in all.
    pub points: u64,
}

/// The points of one pen.
struct Dots {
    pen: Pen,
    /// Of a pen of `[[pen]]`, which has one size ([STIP-6]).
    nib: Option<f64>,
    points: Points,
}

/// Frames of points.
pub struct DotFrames<'a> {
    stippling: &'a Stippling<'a>,
    layers: Vec<Frames<'a>>,
    surface: Option<Arc<IsoSurface<'a, 'a>>>,
    /// Of each layer.
    drawn: Vec<FrameDots>,
}

/// What is known before the points are.
struct Setting<'a> {
    job: &'a Job,
    scene: &'a Scene,
    /// As they are drawn: for a plotter in opaque ink.
    stipples: Stipples,
    page: Page,
    /// From where points are made: frame 0.
    first: View,
    near: f64,
    /// S_max in mm.
    size: f64,
    /// The side of the squares that A_vol is in, in pixels ([STIP-3]).
    square: f64,
    /// What the pen prints, where that was measured, or what discs do where `k_max = "auto"` asks ([STIP-17]).
    tone: Option<Tone>,
}

impl<'a> Stippling<'a> {
    /// Makes the points of a job whose scene has `[stipples]`. `progress` hears how far they are, from any thread.
    ///
    /// # Errors
    /// No stipples, a pen that there is not, a camera without direction, lengths of the wrong space, more points than there
    /// is memory for.
    pub fn new(job: &'a Job, counts: &mut Counts, progress: &(dyn Fn(PointsMade) + Sync)) -> Result<Self, Failure> {
        Self::of(job, &job.scene, counts, progress)
    }

    /// The same of a scene that differs from the job's in its knobs alone ([COST-1]).
    ///
    /// # Errors
    /// As [`Stippling::new`].
    pub fn of(
        job: &'a Job,
        scene: &'a Scene,
        counts: &mut Counts,
        progress: &(dyn Fn(PointsMade) + Sync),
    ) -> Result<Self, Failure> {
        let start = Instant::now();
        let setting = Setting::new(job, scene)?;
        let pens = Pens::new(scene, &setting.stipples, &setting.page)?;
        let wrong = |error: StippleError| failure(job, &error);
        let preprocess = Preprocess::new(setting.inputs()).map_err(wrong)?;
        memory::room(preprocess.bytes()).map_err(|no_room| {
            let what = format!("{} points need {no_room}", preprocess.len());
            let place = job.scene.given.position("stipples.k_max");
            Failure::new(what, place, "make k_max smaller, or threshold larger")
        })?;
        let (ranks, points) = (preprocess.each.max(1) as f64, preprocess.len());
        let made = |made: usize| progress(PointsMade { share: made as f64 / ranks, points });
        let points = preprocess.points(counts, &made).map_err(wrong)?;
        let edges = preprocess.edges(counts).map_err(wrong)?;
        let grid = points.grid.clone();
        let ink = [preprocess.ink, preprocess.layers];
        let (layers, line_pen) = pens.deal(job, points)?;
        let hiding = hiding(job, scene, counts)?;
        counts.seconds.insert("points".into(), start.elapsed().as_secs_f64());
        Ok(Self { setting, layers, line_pen, edges, grid, ink, hiding })
    }

    /// How many points there will be.
    ///
    /// # Errors
    /// As [`Stippling::new`].
    pub fn planned(job: &Job) -> Result<PointsPlan, Failure> {
        let setting = Setting::new(job, &job.scene)?;
        let preprocess = Preprocess::new(setting.inputs()).map_err(|error| failure(job, &error))?;
        let each = preprocess.each as u64;
        Ok(PointsPlan { voxels: preprocess.len() / each.max(1), each, bytes: preprocess.bytes() })
    }

    /// Other dots of the same points, which are the same whatever this says.
    pub(crate) fn set_even(&mut self, even: Even) {
        self.setting.stipples.even = even;
    }

    /// Makes ready what no camera changes.
    pub fn frames(&self) -> DotFrames<'_> {
        let Setting { job, scene, stipples, first, near, size, .. } = &self.setting;
        let (near, size, light, grid, reference) = (*near, *size, scene.light, job.volume.grid(), first);
        let surface = self.hiding.as_ref().map(|(field, iso)| Arc::new(IsoSurface::new(field, *iso)));
        let [ink, layers] = self.ink;
        let measured = self.setting.tone.as_ref().filter(|_| self.setting.pen_tone().is_some());
        let tone = measured.map(|tone| PenTone { tone, ink, layers });
        let layers = self.layers.iter().map(|&Dots { nib, ref points, .. }| {
            let surface = surface.clone();
            Frames::new(FrameInputs { stipples, points, light, grid, reference, near, size, nib, surface, tone })
        });
        let layers: Vec<_> = layers.collect();
        let drawn = vec![FrameDots::default(); layers.len()];
        DotFrames { stippling: self, layers, surface, drawn }
    }
}

impl DotFrames<'_> {
    /// The marks that a camera sees: a layer a pen, with its dots and, where the scene has them, silhouette curves.
    pub fn draw(&mut self, view: &View, counts: &mut Counts) -> Marks {
        let start = Instant::now();
        let Stippling { setting, line_pen, edges, grid, .. } = self.stippling;
        let Setting { page, near, stipples, .. } = setting;
        let mut layers = Vec::with_capacity(self.layers.len());
        for (frames, drawn) in self.layers.iter().zip(&mut self.drawn) {
            frames.draw(view, page, drawn);
        }
        if stipples.even == Even::Page {
            choose_on_page(&mut self.drawn);
        }
        for (drawn, dots) in self.drawn.iter().zip(&self.stippling.layers) {
            if self.surface.is_some() {
                *counts.preprocess.entry("hidden points".into()).or_default() += drawn.hidden();
            }
            if dots.nib.is_some() {
                *counts.preprocess.entry("dots larger than the nib".into()).or_default() += drawn.larger_than_nib();
            }
            layers.push(Layer { dots: drawn.to_vec(), ..Layer::new(dots.pen.clone()) });
        }
        if let Some(surface) = &self.surface {
            counts.bytes.insert("surface".into(), surface.bytes() as u64);
        }
        if let (Some(curves), Some(edges)) = (&stipples.curves, edges) {
            let mut segments = edges.segments(curves, view);
            if let Some(surface) = &self.surface {
                segments = seen(segments, surface, view, *near, grid);
            }
            let lines = joined(&segments, grid, view, page, *near, line_pen.width / 2.0);
            match layers.iter_mut().find(|layer| layer.pen == *line_pen) {
                Some(layer) => layer.lines = lines,
                None => layers.push(Layer { lines, ..Layer::new(line_pen.clone()) }),
            }
        }
        let mut marks = Marks { page: *page, layers };
        marks.settle();
        counts.points += marks.layers.iter().map(|layer| layer.dots.len() as u64).sum::<u64>();
        counts.strokes += marks.layers.iter().map(|layer| layer.lines.len() as u64).sum::<u64>();
        *counts.seconds.entry("dots".into()).or_default() += start.elapsed().as_secs_f64();
        marks
    }
}

impl<'a> Setting<'a> {
    fn new(job: &'a Job, scene: &'a Scene) -> Result<Self, Failure> {
        let at = |key: &str| scene.given.position(key);
        let Some(mut stipples) = scene.stipples.clone() else {
            let remedy = "add a table [stipples], or write preset = \"stipple\"";
            return Err(Failure::new("the scene has no stipples", at("stipples"), remedy));
        };
        if scene.page.as_ref().is_some_and(|page| page.plotter) {
            // A nib has no opacity: a dot that fades would be drawn whole, and too much ink in all ([STIP-5]).
            stipples.ink = Ink::Opaque;
        }
        let grid = job.volume.grid();
        let first = job.view()?;
        let near = scene.camera.near.unwrap_or(scene.sampling.step).world(grid).ok_or_else(|| {
            Failure::new("the length is on the page, not in the volume", at("camera.near"), "give it in voxels")
        })?;
        let page = Page::of(scene);
        let size = page.length(stipples.size).ok_or_else(|| {
            let what = "the length is in the volume, not on the page";
            Failure::new(what, at("stipples.size"), "give it in mm, px or %")
        })?;
        // A_vol is in pixels, or in squares of side S_max where the picture is in mm ([STIP-3]).
        let in_mm = scene.picture.extent().is_some_and(|e| e.iter().any(|l| matches!(l, Length::Millimetres(_))));
        let square = if in_mm { size * page.pixels_per_mm() } else { 1.0 };
        let mut setting = Self { job, scene, stipples, page, first, near, size, square, tone: None };
        setting.tone = match setting.pen_tone() {
            Some(path) => Some(tone(path)?),
            None => (setting.stipples.k_max == PointsPerPixel::Auto).then(Tone::ideal),
        };
        Ok(setting)
    }

    /// The table of what the pen prints, where there is one.
    fn pen_tone(&self) -> Option<&'a Path> {
        let pen = self.scene.pens.iter().find(|pen| self.stipples.pen.as_ref() == Some(&pen.name))?;
        pen.tone.as_deref()
    }

    fn inputs(&self) -> StippleInputs<'_> {
        let Self { job, scene, stipples, first, near, square, .. } = self;
        let (table, volume) = (&scene.volume, &job.volume);
        // S_max's area, in pixels.
        let diameter = self.size * self.page.pixels_per_mm();
        let dot = 0.25 * std::f64::consts::PI * (diameter * diameter);
        let tone = self.tone.as_ref().map(|tone| (tone, dot));
        StippleInputs { stipples, table, volume, view: first, near: *near, square: *square, tone }
    }
}

/// What hides points, if something does: the field as the scene samples it, and the value of its surface.
fn hiding<'a>(job: &'a Job, scene: &Scene, counts: &mut Counts) -> Result<Option<(Field<'a, f64>, f64)>, Failure> {
    let volume = &job.volume;
    let Some(iso) = scene.stipples.as_ref().and_then(|stipples| stipples.hide_behind) else { return Ok(None) };
    let how = Reconstruction {
        kernel: scene.sampling.kernel,
        gradient: scene.sampling.gradient,
        outside: scene.volume.outside,
        ..Reconstruction::default()
    };
    let field = Field::new(volume, how, Rung::Gradient)
        .map_err(|error| Failure::new(error, scene.given.position("volume"), "convert the volume"))?;
    let iso = match iso {
        Iso::Auto => suggest::iso(volume, &scene.volume, counts),
        Iso::Value(value) => value,
    };
    Ok(Some((field, iso)))
}

/// A measured step wedge ([STIP-17]).
///
/// # Errors
/// A file that cannot be read, or a line of it that is none of a step wedge.
pub fn tone(path: &Path) -> Result<Tone, Failure> {
    let remedy = "the command wedge writes the table; fill in what was measured";
    Tone::read(path).map_err(|error| Failure::new(&error, error.place(), remedy))
}

fn failure(job: &Job, error: &StippleError) -> Failure {
    let (key, remedy) = match error {
        StippleError::Field(_) => ("volume", "convert the volume"),
        StippleError::Length { key } => (*key, "give it in voxels or world units"),
        StippleError::TooMany { .. } => ("stipples.threshold", "make it larger"),
        StippleError::TooDense { .. } if job.scene.stipples.as_ref().is_some_and(|s| s.box_side.is_some()) => {
            ("stipples.box", "make it or `stipples.k_max` smaller")
        }
        StippleError::TooDense { .. } => ("stipples.k_max", "make it smaller"),
    };
    Failure::new(error, job.scene.given.position(key), remedy)
}
