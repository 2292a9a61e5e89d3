//! Strokes of a scene on the page, without hidden parts ([HATCH-14]). Hatching ([HATCH-8]) is grown once; outlines
//! ([HATCH-18]) are found for each camera.

mod hatching;
mod outlining;
mod sample;
mod seeding;
mod visible_values;

use crate::Failure;
use crate::job::{Job, in_world, near, pen_named, render_failure};
use drypoint_reference::field::{Field, Reconstruction, Rung};
use drypoint_reference::interactive_volume_illustration::Sight;
use drypoint_reference::surface::IsoSurface;
use drypoint_scene::clip::{ClipPlanes, NO_PLANES};
use drypoint_scene::color::Rgba;
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Layer, Marks, Page, Pen, mark_counts};
use drypoint_scene::shot::Clipping;
use drypoint_scene::space::Grid;
use drypoint_scene::strokes::Stroke;
use drypoint_scene::tables::{Iso, Length, Scene};
use drypoint_scene::view::View;
use hatching::{GrownHatching, HatchingSetup};
use outlining::Outlining;
use std::time::Instant;

pub use seeding::SeedMap;

/// Everything about strokes that no camera changes.
pub struct Stroking<'a> {
    field: Field<'a, f64>,
    page: Page,
    near: f64,
    /// Iso-value of the surface that hides all strokes, if there is one.
    hides: Option<f64>,
    /// Planes on which strokes end.
    clip: ClipPlanes,
    hatching: Option<HatchingSetup<'a>>,
    outlining: Option<Outlining>,
}

/// Frames of strokes.
pub struct StrokeFrames<'a> {
    stroking: &'a Stroking<'a>,
    /// Surfaces that strokes lie on, and that hide them.
    surfaces: Vec<IsoSurface<'a, 'a>>,
    hatched: Option<GrownHatching<'a>>,
    /// Creases of the surface of outlines.
    creases: Vec<Stroke>,
}

/// View of a frame, and the surface that hides strokes.
struct StrokeCamera<'a> {
    view: &'a View,
    page: &'a Page,
    near: f64,
    clip: &'a ClipPlanes,
    /// Surface that hides strokes; none: nothing hides them.
    hides: Option<&'a IsoSurface<'a, 'a>>,
}

impl<'a> StrokeCamera<'a> {
    /// Returns the camera for visibility tests of points at `offset` in front of the surface.
    fn sight(&self, offset: f64) -> Sight<'a> {
        let &Self { view, page, near, hides: surface, clip } = self;
        Sight { view, page, near, surface, clip, offset }
    }
}

/// Returns the largest scale of a view in the volume, in mm of the page a world unit.
fn largest_scale(view: &View, page: &Page, near: f64, grid: &Grid) -> f64 {
    let pixel = (page.size.x - 2.0 * page.margin) / view.size[0] as f64;
    let depths = grid.world_corners().map(|corner| -view.to_eye(corner).z);
    let nearest = if view.perspective { depths.into_iter().fold(f64::INFINITY, f64::min).max(near) } else { 1.0 };
    pixel / (view.pixel * nearest)
}

impl<'a> Stroking<'a> {
    /// Prepares the field of a job whose scene has strokes, as the scene samples it.
    ///
    /// # Errors
    /// No strokes, an unknown pen, a length of the wrong space, or a reconstruction that does not exist.
    pub fn new(job: &'a Job, counts: &mut Counts) -> Result<Self, Failure> {
        Self::of(job, &job.scene, counts)
    }

    /// Prepares a scene that differs from the job's in its knobs alone ([COST-1]).
    ///
    /// # Errors
    /// Same errors as [`Stroking::new`].
    pub fn of(job: &'a Job, scene: &'a Scene, counts: &mut Counts) -> Result<Self, Failure> {
        let start = Instant::now();
        let volume = &job.volume;
        let at = |key: &str| scene.given.position(key);
        if !scene.has_strokes() {
            return Err(Failure::new(
                "the scene has no strokes",
                at("outlines"),
                "add a table [hatching] or [outlines]",
            ));
        }
        let page = Page::of(scene);
        let near = near(scene, volume.grid())?;
        let how = Reconstruction {
            kernel: scene.sampling.kernel,
            gradient: scene.sampling.gradient,
            hessian: scene.sampling.hessian,
            scale: in_world(scene, scene.sampling.scale, "sampling.scale", volume.grid())?,
            outside: scene.volume.outside,
        };
        let hatching = scene.hatching.as_ref().filter(|_| job.target().has_hatching());
        let reads_hessians = hatching.is_some_and(|hatching| hatching.reads_hessians());
        let rung = if reads_hessians { Rung::Hessian } else { Rung::Gradient };
        let field = Field::new(volume, how, rung).map_err(|error| render_failure(&error.into(), scene))?;
        let hides = scene.surface.as_ref().map(|surface| value(scene, surface.iso, "surface.iso")).transpose()?;
        for (name, bytes) in field.bytes() {
            *counts.bytes.entry(format!("strokes {name}")).or_default() += bytes;
        }
        let outlining = scene.outlines.as_ref().map(|table| Outlining::new(scene, table, &page)).transpose()?;
        let grid = volume.grid();
        let hatching = match hatching {
            Some(table) => {
                let scale = largest_scale(&job.view()?, &page, near, grid);
                Some(HatchingSetup::new((scene, job.function()), table, grid, (&page, scale), job.draws_volume())?)
            }
            None => None,
        };
        counts.seconds.insert("strokes".into(), start.elapsed().as_secs_f64());
        let clip = Clipping::new(scene, grid).planes;
        Ok(Self { field, page, near, hides, clip, hatching, outlining })
    }

    /// Measures the ranges of the field, once for each iso-value, and grows the strokes of hatching.
    pub fn frames(&self, counts: &mut Counts) -> StrokeFrames<'_> {
        let surfaces = self.surfaces();
        let hatched = self.hatching.as_ref().map(|hatching| hatching.grow(&self.field, counts));
        let outlined = self.outlining.as_ref();
        let own = outlined.and_then(|own| Some((own, surfaces.iter().find(|surface| surface.iso() == own.iso)?)));
        let creases = own.map_or_else(Vec::new, |(own, surface)| own.creases(surface, counts));
        StrokeFrames { stroking: self, surfaces, hatched, creases }
    }

    /// Returns the surfaces that strokes lie on, and that hide them.
    fn surfaces(&self) -> Vec<IsoSurface<'_, '_>> {
        let cut = self.hatching.as_ref().filter(|hatching| hatching.is_cut());
        let outlined = self.outlining.as_ref().map(|outlining| outlining.iso);
        let hides = self.hides.filter(|_| cut.is_some() || outlined.is_some());
        let mut surfaces: Vec<IsoSurface<'_, '_>> = Vec::new();
        for iso in [cut.and_then(|hatching| hatching.iso), outlined, hides].into_iter().flatten() {
            if !surfaces.iter().any(|surface| surface.iso() == iso) {
                surfaces.push(IsoSurface::new(&self.field, iso).clipped(&self.clip));
            }
        }
        surfaces
    }
}

impl StrokeFrames<'_> {
    /// Returns the strokes that a camera sees, a layer a pen: those over a picture, and those inside one.
    ///
    /// # Errors
    /// Dashes that the memory budget does not allow.
    pub fn draw(&mut self, view: &View, counts: &mut Counts) -> Result<[Vec<Layer>; 2], Failure> {
        let Stroking { field, page, near, hides, clip, hatching, outlining } = self.stroking;
        // Each iso-value has its surface.
        let surface = |iso: f64| self.surfaces.iter().find(|surface| surface.iso() == iso);
        let mut layers = Vec::new();
        if let Some((hatching, hatched)) = hatching.as_ref().zip(self.hatched.as_ref()) {
            let hides = hides.or(hatching.iso).and_then(surface).filter(|_| hatching.is_cut());
            layers = hatched.draw(&StrokeCamera { view, page, near: *near, clip, hides }, counts);
        }
        let hatched = layers.len();
        if let Some(outlining) = outlining
            && let Some((own, hides)) = surface(outlining.iso).zip(surface(hides.unwrap_or(outlining.iso)))
        {
            let grid = field.volume().grid();
            let (hides, reach) = (Some(hides), grid.voxel() * largest_scale(view, page, *near, grid));
            // The planes have cut them already.
            let camera = StrokeCamera { view, page, near: *near, clip: &NO_PLANES, hides };
            layers.push(outlining.draw(&camera, (own, &self.creases), reach, counts));
        }
        if let Some(hatching) = hatching {
            hatching.cut(&mut layers, hatched, view, counts)?;
        }
        let bytes: usize = self.surfaces.iter().map(IsoSurface::bytes).sum();
        counts.bytes.insert("surface".into(), bytes as u64);
        let mut marks = Marks { page: *page, layers };
        marks.settle();
        counts.strokes += mark_counts(&marks.layers)[1] as u64;
        // The first layers are those of hatching.
        let merged = if hatching.as_ref().is_some_and(|hatching| hatching.is_merged) { hatched } else { 0 };
        let over = marks.layers.split_off(merged);
        Ok([over, marks.layers])
    }
}

/// Returns an iso-value. A job has already set those that its scene leaves to the volume.
fn value(scene: &Scene, iso: Iso, key: &str) -> Result<f64, Failure> {
    match iso {
        Iso::Value(value) => Ok(value),
        Iso::Auto => Err(Failure::new("the iso-value was not found", scene.given.position(key), "give a number")),
    }
}

/// Returns a length on the page, in mm.
fn on_page(scene: &Scene, page: &Page, length: Length, key: &str) -> Result<f64, Failure> {
    page.length(length).ok_or_else(|| {
        let what = "the length is in the volume, not on the page";
        Failure::new(what, scene.given.position(key), "give it in mm or px")
    })
}

/// Returns the pen that draws a table's strokes: one of `[[pen]]`, or the table's own.
fn pen(
    scene: &Scene,
    table: &str,
    page: &Page,
    named: Option<&str>,
    (width, color): (Length, Rgba),
) -> Result<Pen, Failure> {
    if let Some(name) = named {
        // The failure names the table's `pen`, or a key that names another pen.
        let key = if table.contains('.') { table.into() } else { format!("{table}.pen") };
        return pen_named(scene, page, name, &key);
    }
    let width = on_page(scene, page, width, &format!("{table}.width"))?;
    Ok(Pen { number: 1, name: table.into(), width, color })
}
