//! The strokes of a scene: outlines ([HATCH-18]), found anew for each camera, on the page without what is hidden
//! ([HATCH-14]).

use crate::Failure;
use crate::job::Job;
use drypoint_reference::field::{Field, Reconstruction, Rung};
use drypoint_reference::interactive_volume_illustration::{Pen as Nib, Sight, outlines};
use drypoint_reference::surface::IsoSurface;
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Layer, Marks, Page, Pen, Polyline};
use drypoint_scene::tables::{Iso, Outlines, Scene};
use drypoint_scene::view::View;
use std::time::Instant;

/// How far in front of the surface outlines are asked for, in voxels. The surface leaves the line towards the eye slowly there,
/// and that of a real scan is rough: with the 0.15 voxel of [HATCH-7] it breaks its own outline. With half a
/// voxel lines go on round their ends, as small hooks.
const OFFSET: f64 = 0.3;

/// What strokes are made of, whatever the camera.
pub struct Stroking<'a> {
    field: Field<'a, f64>,
    /// The value of the outlines' surface, and that of the one that hides.
    values: [f64; 2],
    pen: Pen,
    page: Page,
    near: f64,
    /// In mm.
    min_length: f64,
}

/// Frames of strokes.
pub struct StrokeFrames<'a> {
    stroking: &'a Stroking<'a>,
    surface: IsoSurface<'a, 'a>,
    /// What hides, where that is another one.
    hiding: Option<IsoSurface<'a, 'a>>,
}

impl<'a> Stroking<'a> {
    /// Prepares the field of a job whose scene has strokes, as the scene samples it.
    ///
    /// # Errors
    /// No strokes, a pen that there is not, lengths of the wrong space, a reconstruction that does not exist.
    pub fn new(job: &'a Job, counts: &mut Counts) -> Result<Self, Failure> {
        let start = Instant::now();
        let Job { scene, volume, .. } = job;
        let at = |key: &str| scene.given.position(key);
        let Some(table) = &scene.outlines else {
            return Err(Failure::new("the scene has no strokes", at("outlines"), "add a table [outlines]"));
        };
        let page = Page::of(scene);
        let pen = pen(scene, table, &page)?;
        let min_length = page.length(table.min_length).ok_or_else(|| {
            let what = "the length is in the volume, not on the page";
            Failure::new(what, at("outlines.min_length"), "give it in mm or px")
        })?;
        let near = scene.camera.near.unwrap_or(scene.sampling.step).world(volume.grid()).ok_or_else(|| {
            Failure::new("the length is on the page, not in the volume", at("camera.near"), "give it in voxels")
        })?;
        let how = Reconstruction {
            kernel: scene.sampling.kernel,
            gradient: scene.sampling.gradient,
            outside: scene.volume.outside,
            ..Reconstruction::default()
        };
        let field =
            Field::new(volume, how, Rung::Gradient).map_err(|error| Failure::new(error, at("volume"), "convert it"))?;
        // A job has found the values that its scene leaves to the volume.
        let value = |iso: Iso| match iso {
            Iso::Value(value) => Ok(value),
            Iso::Auto => Err(Failure::new("the iso-value was not found", at("outlines.iso"), "give a number")),
        };
        let own = value(table.iso)?;
        let hiding = scene.surface.as_ref().map_or(Ok(own), |surface| value(surface.iso))?;
        for (name, bytes) in field.bytes() {
            *counts.bytes.entry(format!("strokes {name}")).or_default() += bytes;
        }
        counts.seconds.insert("strokes".into(), start.elapsed().as_secs_f64());
        Ok(Self { field, values: [own, hiding], pen, page, near, min_length })
    }

    /// Looks at the ranges of the field, once.
    pub fn frames(&self) -> StrokeFrames<'_> {
        let [own, hiding] = self.values;
        let surface = IsoSurface::new(&self.field, own);
        let hiding = (hiding != own).then(|| IsoSurface::new(&self.field, hiding));
        StrokeFrames { stroking: self, surface, hiding }
    }
}

impl StrokeFrames<'_> {
    /// The strokes that a camera sees, a layer a pen.
    pub fn draw(&mut self, view: &View, counts: &mut Counts) -> Vec<Layer> {
        let Stroking { pen, page, near, min_length, field, .. } = self.stroking;
        let start = Instant::now();
        let found = outlines(&self.surface, view);
        counts.preprocess.insert("outline places".into(), found.places);
        counts.preprocess.insert("outline places without a root".into(), found.lost);
        *counts.seconds.entry("outlines".into()).or_default() += start.elapsed().as_secs_f64();

        let start = Instant::now();
        let hiding = self.hiding.as_ref().unwrap_or(&self.surface);
        let offset = OFFSET * field.volume().grid().voxel();
        let sight = Sight { view, page, near: *near, surface: Some(hiding), offset };
        let nib = Nib { radius: pen.width / 2.0, opacity: 1.0 };
        let seen = sight.seen(&found.strokes, |_, _| nib);
        let all = seen.lines.len();
        let lines: Vec<Polyline> = seen.lines.into_iter().filter(|line| line.length() >= *min_length).collect();
        counts.preprocess.insert("looks for what hides".into(), seen.looks);
        counts.preprocess.insert("short strokes".into(), (all - lines.len()) as u64);
        let bytes = self.surface.bytes() + self.hiding.as_ref().map_or(0, IsoSurface::bytes);
        counts.bytes.insert("surface".into(), bytes as u64);
        let mut marks = Marks { page: *page, layers: vec![Layer { lines, ..Layer::new(pen.clone()) }] };
        marks.settle();
        counts.strokes += marks.layers.iter().map(|layer| layer.lines.len() as u64).sum::<u64>();
        *counts.seconds.entry("hidden strokes".into()).or_default() += start.elapsed().as_secs_f64();
        marks.layers
    }
}

/// What draws outlines: a pen of `[[pen]]`, or one of their own.
fn pen(scene: &Scene, table: &Outlines, page: &Page) -> Result<Pen, Failure> {
    let at = |key: &str| scene.given.position(key);
    if let Some(name) = &table.pen {
        return Pen::of(&scene.pens, page).into_iter().find(|pen| pen.name == *name).ok_or_else(|| {
            let names: Vec<&str> = scene.pens.iter().map(|pen| pen.name.as_str()).collect();
            let remedy = match names.as_slice() {
                [] => "add a table [[pen]] with that name".into(),
                names => format!("write one of {}", names.join(", ")),
            };
            Failure::new(format!("there is no pen {name:?}"), at("outlines.pen"), remedy)
        });
    }
    let width = page.length(table.width).ok_or_else(|| {
        Failure::new("the length is in the volume, not on the page", at("outlines.width"), "give it in mm or px")
    })?;
    Ok(Pen { number: 1, name: "outlines".into(), width, color: table.color })
}
