//! Dots and lines of a scene with `[stipples]` (Lu et al. 2002), made once and drawn for any number of cameras.

mod pens;

use crate::Failure;
use crate::job::{Job, shot_failure};
use drypoint_reference::field::{Field, Reconstruction, Rung};
use drypoint_reference::surface::IsoSurface;
use drypoint_reference::volume_stippling::{
    CurveVoxels, FrameDots, FrameInputs, Frames, PenTone, Preprocess, StippleError, choose_on_page, joined, seen,
};
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Layer, Marks, Page, Pen, mark_counts};
use drypoint_scene::memory;
use drypoint_scene::plan::PointsPlan;
use drypoint_scene::points::{Points, SurfacePoint};
use drypoint_scene::shot::StippleParams;
use drypoint_scene::shot::stipples::{Even, PointsPerPixel};
use drypoint_scene::source::Source;
use drypoint_scene::space::Grid;
use drypoint_scene::tables::Scene;
use drypoint_scene::tone::Tone;
use drypoint_scene::view::View;
use pens::Pens;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// Points of a scene, made once from its first camera.
pub struct Stippling<'a> {
    setting: StippleSetup<'a>,
    layers: Vec<PenDots>,
    /// Pen of lines: one of the layers' pens, or one of its own.
    line_pen: Pen,
    edges: Option<CurveVoxels>,
    /// Grid of the voxels of points and edges.
    grid: Grid,
    /// λa of dots of S_max in a face seen from the front, and the number of voxels behind each other in it ([STIP-17]).
    ink: [f64; 2],
    /// Field and iso-value of the surface that hides points ([STIP-15]).
    hiding: Option<(Field<'a, f64>, f64)>,
}

/// Progress in making the points of a scene.
#[derive(Clone, Copy, Debug)]
pub struct PointsProgress {
    /// Finished share, in [0, 1].
    pub share: f64,
    /// Number of all points.
    pub points: u64,
}

/// The points of one pen.
struct PenDots {
    pen: Pen,
    /// Nib of a pen of `[[pen]]`, which has one size ([STIP-6]).
    nib: Option<f64>,
    points: Points,
}

/// A test of which points a surface hides, from a camera and so far in front of the surface.
pub type PointTest = Box<dyn FnMut(&View, f64, &[SurfacePoint]) -> Result<Vec<bool>, Failure>>;

/// Frames of points.
pub struct DotFrames<'a> {
    stippling: &'a Stippling<'a>,
    layers: Vec<Frames<'a>>,
    surface: Option<Arc<IsoSurface<'a, 'a>>>,
    /// The test of hidden points in place of the reference's.
    test: Option<PointTest>,
    /// Drawn dots of each layer.
    drawn: Vec<FrameDots>,
}

/// Everything that is known before points are made.
struct StippleSetup<'a> {
    job: &'a Job,
    scene: &'a Scene,
    stipples: StippleParams,
    page: Page,
    /// Measured tone of the pen, or that of ideal discs if `k_max = "auto"` asks for one ([STIP-17]).
    tone: Option<Tone>,
}

impl<'a> Stippling<'a> {
    /// Makes the points of a job whose scene has `[stipples]`. `progress` gets their state, from any thread.
    ///
    /// # Errors
    /// No stipples, an unknown pen, a camera without direction, a length of the wrong space, or more points than memory
    /// allows.
    pub fn new(job: &'a Job, counts: &mut Counts, progress: &(dyn Fn(PointsProgress) + Sync)) -> Result<Self, Failure> {
        Self::of(job, &job.scene, counts, progress)
    }

    /// Makes the points of a scene that differs from the job's in its knobs alone ([COST-1]).
    ///
    /// # Errors
    /// Same errors as [`Stippling::new`].
    pub fn of(
        job: &'a Job,
        scene: &'a Scene,
        counts: &mut Counts,
        progress: &(dyn Fn(PointsProgress) + Sync),
    ) -> Result<Self, Failure> {
        let start = Instant::now();
        let setting = StippleSetup::new(job, scene)?;
        let pens = Pens::new(scene, setting.stipples.size, &setting.page)?;
        let wrong = |error: StippleError| failure(job, &error);
        let preprocess = setting.preprocess().map_err(wrong)?;
        memory::room(preprocess.bytes()).map_err(|no_room| {
            let what = format!("{} points need {no_room}", preprocess.len());
            let place = job.scene.given.position("stipples.k_max");
            Failure::new(what, place, "make k_max smaller, or threshold larger")
        })?;
        let (ranks, points) = (preprocess.each.max(1) as f64, preprocess.len());
        let made = |made: usize| progress(PointsProgress { share: made as f64 / ranks, points });
        let points = preprocess.points(counts, &made).map_err(wrong)?;
        let edges = preprocess.edges(counts).map_err(wrong)?;
        let grid = points.grid.clone();
        // Points are dealt to the pens; a surface may hide them.
        let ink = [preprocess.ink, preprocess.layers];
        let (layers, line_pen) = pens.deal(job, points)?;
        let hiding = hiding(job, scene, &setting.stipples)?;
        counts.seconds.insert("points".into(), start.elapsed().as_secs_f64());
        Ok(Self { setting, layers, line_pen, edges, grid, ink, hiding })
    }

    /// Returns the number of points before they are made.
    ///
    /// # Errors
    /// Same errors as [`Stippling::new`].
    pub fn planned(job: &Job) -> Result<PointsPlan, Failure> {
        let setting = StippleSetup::new(job, &job.scene)?;
        let preprocess = setting.preprocess().map_err(|error| failure(job, &error))?;
        let each = preprocess.each as u64;
        Ok(PointsPlan { voxels: preprocess.len() / each.max(1), each, bytes: preprocess.bytes() })
    }

    /// Sets how evenly dots are chosen. The points stay the same.
    pub(crate) fn set_even(&mut self, even: Even) {
        self.setting.stipples.even = even;
    }

    /// Prepares everything that no camera changes.
    pub fn frames(&self) -> DotFrames<'_> {
        let StippleSetup { job, stipples, .. } = &self.setting;
        let grid = job.volume.grid();
        let surface =
            self.hiding.as_ref().map(|(field, iso)| Arc::new(IsoSurface::new(field, *iso).clipped(&stipples.clip)));
        let [ink, layers] = self.ink;
        let measured = self.setting.tone.as_ref().filter(|_| self.setting.pen_tone().is_some());
        let tone = measured.map(|tone| PenTone { tone, ink, layers });
        let layers = self.layers.iter().map(|&PenDots { nib, ref points, .. }| {
            let stipples = stipples.clone();
            Frames::new(FrameInputs { stipples, points, grid, nib, surface: surface.clone(), tone })
        });
        let layers: Vec<_> = layers.collect();
        let drawn = vec![FrameDots::default(); layers.len()];
        DotFrames { stippling: self, layers, surface, test: None, drawn }
    }
}

impl<'a> DotFrames<'a> {
    /// Returns the surface that hides points, and the near distance of a perspective camera.
    pub fn hiding(&self) -> Option<(&IsoSurface<'a, 'a>, f64)> {
        self.surface.as_deref().map(|surface| (surface, self.stippling.setting.stipples.near))
    }

    /// Sets the test of hidden points in place of the reference's.
    pub fn test_by(&mut self, test: PointTest) {
        self.test = Some(test);
    }

    /// Returns the marks that a camera sees: a layer a pen, with dots and, if the scene asks for them, silhouette
    /// curves.
    ///
    /// # Errors
    /// Errors of another test of hidden points.
    pub fn draw(&mut self, view: &View, counts: &mut Counts) -> Result<Marks, Failure> {
        let start = Instant::now();
        let Stippling { setting: StippleSetup { page, stipples, .. }, line_pen, edges, grid, .. } = self.stippling;
        let (clip, near) = (&stipples.clip, stipples.near);
        // Dots of each pen, thinned evenly over all pens if the scene asks for that.
        let mut layers = Vec::with_capacity(self.layers.len());
        for (frames, drawn) in self.layers.iter().zip(&mut self.drawn) {
            match (&mut self.test, frames.in_front(view)) {
                (Some(test), Some(in_front)) => {
                    frames.candidates(view, page, drawn);
                    drawn.leave_out(&test(view, in_front, &drawn.points())?);
                }
                _ => frames.draw(view, page, drawn),
            }
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
        // Silhouette curves, without what the surface hides.
        if let (Some(curves), Some(edges)) = (&stipples.curves, edges) {
            let mut segments = edges.segments(curves, view);
            if !clip.is_empty() {
                segments = segments.into_iter().filter_map(|segment| segment.clipped(clip)).collect();
            }
            if let Some(surface) = &self.surface {
                segments = seen(segments, surface, view, near, grid);
            }
            let lines = joined(&segments, grid, view, page, near, line_pen.width / 2.0);
            match layers.iter_mut().find(|layer| layer.pen == *line_pen) {
                Some(layer) => layer.lines = lines,
                None => layers.push(Layer { lines, ..Layer::new(line_pen.clone()) }),
            }
        }
        let mut marks = Marks { page: *page, layers };
        marks.settle();
        let [dots, lines] = mark_counts(&marks.layers).map(|n| n as u64);
        (counts.points, counts.strokes) = (counts.points + dots, counts.strokes + lines);
        *counts.seconds.entry("dots".into()).or_default() += start.elapsed().as_secs_f64();
        Ok(marks)
    }
}

impl<'a> StippleSetup<'a> {
    fn new(job: &'a Job, scene: &'a Scene) -> Result<Self, Failure> {
        let Some(table) = &scene.stipples else {
            let remedy = "add a table [stipples], or write preset = \"stipple\"";
            return Err(Failure::new("the scene has no stipples", scene.given.position("stipples"), remedy));
        };
        let stipples = StippleParams::new(scene, table, job.volume.grid(), job.view()?)
            .map_err(|error| shot_failure(&error, scene))?;
        let mut setting = Self { job, scene, stipples, page: Page::of(scene), tone: None };
        setting.tone = match setting.pen_tone() {
            Some(path) => Some(tone(&*job.source, path)?),
            None => (setting.stipples.k_max == PointsPerPixel::Auto).then(Tone::ideal),
        };
        Ok(setting)
    }

    /// Returns the path of the pen's measured tone, if there is one.
    fn pen_tone(&self) -> Option<&'a Path> {
        let named = self.scene.stipples.as_ref()?.pen.as_ref();
        self.scene.pens.iter().find(|pen| named == Some(&pen.name))?.tone.as_deref()
    }

    /// Finds the voxels that get points.
    fn preprocess(&self) -> Result<Preprocess<'a>, StippleError> {
        Preprocess::new(self.stipples.clone(), &self.job.volume, self.tone.as_ref())
    }
}

/// Returns the field as the scene samples it and the iso-value of the surface that hides points, if any.
fn hiding<'a>(job: &'a Job, scene: &Scene, stipples: &StippleParams) -> Result<Option<(Field<'a, f64>, f64)>, Failure> {
    let Some(iso) = stipples.hide_behind else { return Ok(None) };
    let volume = &job.volume;
    let how = Reconstruction::of(scene, volume.grid()).map_err(|error| shot_failure(&error, scene))?;
    let field = Field::new(volume, how, Rung::Gradient)
        .map_err(|error| Failure::new(error, scene.given.position("volume"), "convert the volume"))?;
    Ok(Some((field, iso)))
}

/// Reads a measured step wedge ([STIP-17]).
///
/// # Errors
/// A file that cannot be read, or a line that is no row of a step wedge.
pub fn tone(source: &dyn Source, path: &Path) -> Result<Tone, Failure> {
    let remedy = "the command wedge writes the table; fill in what was measured";
    Tone::read(source, path).map_err(|error| Failure::new(&error, error.place(), remedy))
}

fn failure(job: &Job, error: &StippleError) -> Failure {
    let (key, remedy) = match error {
        StippleError::Field(_) => ("volume", "convert the volume"),
        StippleError::Slab => ("stipples.slab", "give it in voxels or world units"),
        StippleError::TooMany { .. } => ("stipples.threshold", "make it larger"),
        StippleError::TooDense { .. } if job.scene.stipples.as_ref().is_some_and(|s| s.box_side.is_some()) => {
            ("stipples.box", "make it or `stipples.k_max` smaller")
        }
        StippleError::TooDense { .. } => ("stipples.k_max", "make it smaller"),
    };
    Failure::new(error, job.scene.given.position(key), remedy)
}
