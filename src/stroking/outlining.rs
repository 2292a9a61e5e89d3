//! Outlines and creases on the page ([HATCH-18], [HATCH-22]).

use super::{StrokeCamera, on_page, pen, value};
use crate::Failure;
use drypoint_reference::interactive_volume_illustration::{
    Joining, PenState, Pyramid, before_cusps, creases, deviation, joined, outlines, without_doubles,
};
use drypoint_reference::surface::IsoSurface;
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Layer, Page, Pen};
use drypoint_scene::strokes::Stroke;
use drypoint_scene::tables::{Crease, Outlines, Scene};
use std::time::Instant;

/// Distance in front of the surface at which outlines are tested for visibility, in voxels. The surface curves away
/// slowly along the line to the eye, and that of a real scan is rough. With the 0.15 voxel of [HATCH-7] it hides parts
/// of its own outline; with half a voxel lines continue around their ends as small hooks.
const OFFSET: f64 = 0.3;

/// Largest difference in depth of lines that are joined or coincide, in voxels. The outline of an edge rounded by four
/// voxels is that much behind its crease.
const DEPTH: f64 = 5.0;

/// Distance within which a crease runs along an outline, in voxels. The outline of an edge rounded by three voxels is up
/// to one voxel beside its crease.
const BESIDE: f64 = 1.25;

/// Distance of ends that are joined, as a multiple of that distance: a crease that goes on from an outline is cut off
/// at that distance from its end.
const JOINED: f64 = 1.5;

/// Settings of outlines.
pub(super) struct Outlining {
    /// Iso-value of the surface.
    pub(super) iso: f64,
    pen: Pen,
    /// Least length, in mm.
    min_length: f64,
    crease: Crease,
}

impl Outlining {
    pub(super) fn new(scene: &Scene, table: &Outlines, page: &Page) -> Result<Self, Failure> {
        Ok(Self {
            iso: value(scene, table.iso, "outlines.iso")?,
            pen: pen(scene, "outlines", page, table.pen.as_deref(), (table.width, table.color))?,
            min_length: on_page(scene, page, table.min_length, "outlines.min_length")?,
            crease: table.crease,
        })
    }

    /// Returns the creases of the surface, which no camera changes.
    pub(super) fn creases(&self, surface: &IsoSurface<'_, '_>, counts: &mut Counts) -> Vec<Stroke> {
        let Crease::Degrees(angle) = self.crease else { return Vec::new() };
        let start = Instant::now();
        let field = surface.field();
        let noise = deviation(field.volume(), &Pyramid::new(field.volume()), self.iso, field.reconstruction().outside);
        let creases = creases(surface, angle, noise);
        counts.bytes.insert("smoothed bricks of creases".into(), creases.bytes);
        counts.preprocess.insert("crease places".into(), creases.found.places);
        counts.preprocess.insert("crease places without a crest".into(), creases.found.lost);
        counts.seconds.insert("creases".into(), start.elapsed().as_secs_f64());
        creases.found.strokes
    }

    /// Returns the outlines and creases that a camera sees. `reach` is a voxel at its largest on the page, in mm.
    pub(super) fn draw(
        &self,
        frame: &StrokeCamera<'_>,
        (surface, creases): (&IsoSurface<'_, '_>, &[Stroke]),
        reach: f64,
        counts: &mut Counts,
    ) -> Layer {
        let start = Instant::now();
        let mut found = outlines(surface, frame.view);
        counts.preprocess.insert("outline places".into(), found.places);
        counts.preprocess.insert("outline places without a root".into(), found.lost);
        let on_box = found.strokes.split_off(found.inside);
        let mut strokes = before_cusps(surface, frame.view, &found.strokes);
        strokes.extend(on_box);
        *counts.seconds.entry("outlines".into()).or_default() += start.elapsed().as_secs_f64();

        let start = Instant::now();
        let voxel = surface.field().volume().grid().voxel();
        let nib = PenState { radius: self.pen.width / 2.0, opacity: 1.0, color: None };
        let sight = frame.sight(OFFSET * voxel);
        let [mut seen, edges] = [&strokes[..], creases].map(|strokes| sight.seen(strokes, |_, _| nib));
        *counts.preprocess.entry("looks for what hides".into()).or_default() += seen.looks + edges.looks;
        // A crease that runs beside an outline is the same edge.
        let (apart, depth) = (self.pen.width.max(BESIDE * reach), DEPTH * voxel);
        let gaps = [self.pen.width, apart];
        seen.lines.extend(without_doubles(&edges.lines, &seen.lines, frame.view, gaps, depth).lines);
        let all = seen.lines.len();
        let joining = Joining { reach: JOINED * apart, touch: self.pen.width, depth, min_length: self.min_length };
        let lines = joined(seen.lines, frame.view, &joining);
        counts.preprocess.insert("short strokes".into(), (all - lines.len()) as u64);
        *counts.seconds.entry("hidden strokes".into()).or_default() += start.elapsed().as_secs_f64();
        Layer { lines, ..Layer::new(self.pen.clone()) }
    }
}
