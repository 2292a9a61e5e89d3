//! Strokes of a scene on the page, without hidden parts ([HATCH-14]). Hatching ([HATCH-8]) is grown once; outlines
//! ([HATCH-18]) are found for each camera.

mod growth;
mod hatching;
mod lengths;
mod sample;
mod seeding;

use crate::Failure;
use crate::job::{Job, render_failure, shot_failure};
use drypoint_reference::field::{Field, Reconstruction, Rung};
use drypoint_reference::interactive_volume_illustration::{GrownHatching, Outlines, Sight, largest_scale};
use drypoint_reference::surface::IsoSurface;
use drypoint_scene::clip::{ClipPlanes, NO_PLANES};
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Layer, Marks, Page, mark_counts};
use drypoint_scene::shot::{Clipping, near};
use drypoint_scene::strokes::Stroke;
use drypoint_scene::tables::{Crease, Scene};
use drypoint_scene::view::View;
use hatching::HatchingSetup;
use lengths::{on_page, pen, value};
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
    outlines: Option<Outlines>,
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
        let resolved = |error| shot_failure(&error, scene);
        let near = near(scene, volume.grid()).map_err(resolved)?;
        let how = Reconstruction::of(scene, volume.grid()).map_err(resolved)?;
        let hatching = scene.hatching.as_ref().filter(|_| job.target().has_hatching());
        let reads_hessians = hatching.is_some_and(|hatching| hatching.reads_hessians());
        let rung = if reads_hessians { Rung::Hessian } else { Rung::Gradient };
        let field = Field::new(volume, how, rung).map_err(|error| render_failure(&error.into(), scene))?;
        let hides = scene.surface.as_ref().map(|surface| value(scene, surface.iso, "surface.iso")).transpose()?;
        for (name, bytes) in field.bytes() {
            *counts.bytes.entry(format!("strokes {name}")).or_default() += bytes;
        }
        let outlines = match &scene.outlines {
            Some(table) => Some(Outlines {
                iso: value(scene, table.iso, "outlines.iso")?,
                pen: pen(scene, "outlines", &page, table.pen.as_deref(), (table.width, table.color))?,
                min_length: on_page(scene, &page, table.min_length, "outlines.min_length")?,
                crease: match table.crease {
                    Crease::Off => None,
                    Crease::Degrees(angle) => Some(angle),
                },
            }),
            None => None,
        };
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
        Ok(Self { field, page, near, hides, clip, hatching, outlines })
    }

    /// Measures the ranges of the field, once for each iso-value, and grows the strokes of hatching.
    pub fn frames(&self, counts: &mut Counts) -> StrokeFrames<'_> {
        let surfaces = self.surfaces();
        let hatched = self.hatching.as_ref().map(|hatching| hatching.grow(&self.field, counts));
        let outlined = self.outlines.as_ref();
        let own = outlined.and_then(|own| Some((own, surfaces.iter().find(|surface| surface.iso() == own.iso)?)));
        let start = Instant::now();
        let creases = own.map_or_else(Vec::new, |(own, surface)| own.creases(surface, counts));
        if own.is_some_and(|(own, _)| own.crease.is_some()) {
            counts.seconds.insert("creases".into(), start.elapsed().as_secs_f64());
        }
        StrokeFrames { stroking: self, surfaces, hatched, creases }
    }

    /// Returns the surfaces that strokes lie on, and that hide them.
    fn surfaces(&self) -> Vec<IsoSurface<'_, '_>> {
        let cut = self.hatching.as_ref().map(|setup| &setup.hatching).filter(|hatching| hatching.cuts_hidden);
        let outlined = self.outlines.as_ref().map(|outlines| outlines.iso);
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
        let Stroking { field, page, near, hides, clip, hatching, outlines } = self.stroking;
        // Each iso-value has its surface.
        let surface = |iso: f64| self.surfaces.iter().find(|surface| surface.iso() == iso);
        let mut layers = Vec::new();
        let mut sight = Sight { view, page, near: *near, surface: None, clip, offset: 0.0 };
        if let Some((setup, hatched)) = hatching.as_ref().zip(self.hatched.as_ref()) {
            let (start, hatching) = (Instant::now(), &setup.hatching);
            sight.surface = hides.or(hatching.iso).and_then(surface).filter(|_| hatching.cuts_hidden);
            layers = hatched.draw(&sight, counts);
            *counts.seconds.entry("hatching".into()).or_default() += start.elapsed().as_secs_f64();
        }
        let hatched = layers.len();
        if let Some(outlines) = outlines
            && let Some((own, hides)) = surface(outlines.iso).zip(surface(hides.unwrap_or(outlines.iso)))
        {
            let start = Instant::now();
            let strokes = outlines.strokes(own, view, counts);
            *counts.seconds.entry("outlines".into()).or_default() += start.elapsed().as_secs_f64();
            let (start, grid) = (Instant::now(), field.volume().grid());
            let reach = grid.voxel() * largest_scale(view, page, *near, grid);
            // The planes have cut them already.
            let sight = Sight { surface: Some(hides), clip: &NO_PLANES, ..sight };
            layers.push(outlines.visible(&sight, [&strokes, &self.creases], [grid.voxel(), reach], counts));
            *counts.seconds.entry("hidden strokes".into()).or_default() += start.elapsed().as_secs_f64();
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
