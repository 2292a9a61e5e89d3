//! Outlines and creases on the page ([HATCH-18], [HATCH-22]).

use super::{CreaseStrokes, OutlineStrokes, before_cusps, creases, outlines};
use crate::interactive_volume_illustration::{Joining, PenState, Pyramid, Sight, deviation, joined, without_doubles};
use crate::surface::IsoSurface;
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Layer, Pen, Polyline};
use drypoint_scene::strokes::Stroke;
use drypoint_scene::view::View;

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

/// Outlines with nothing left to decide.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlines {
    /// Value of the surface.
    pub iso: f64,
    /// The pen that draws them.
    pub pen: Pen,
    /// Least length of a line on the page, in mm.
    pub min_length: f64,
    /// Degrees by which the normal turns over two voxels at a crease, at least; none: no creases ([HATCH-22]).
    pub crease: Option<f64>,
}

impl Outlines {
    /// Returns the creases of the surface, which no camera changes.
    pub fn creases(&self, surface: &IsoSurface<'_, '_>, counts: &mut Counts) -> Vec<Stroke> {
        let Some(angle) = self.crease else { return Vec::new() };
        let field = surface.field();
        let noise = deviation(field.volume(), &Pyramid::new(field.volume()), self.iso, field.reconstruction().outside);
        let CreaseStrokes { found, bytes } = creases(surface, angle, noise);
        counts.bytes.insert("smoothed bricks of creases".into(), bytes);
        counts.preprocess.insert("crease places".into(), found.places);
        counts.preprocess.insert("crease places without a crest".into(), found.lost);
        found.strokes
    }

    /// Returns the outlines of the surface for a camera, up to their cusps, with parts that the surface hides.
    pub fn strokes(&self, surface: &IsoSurface<'_, '_>, view: &View, counts: &mut Counts) -> Vec<Stroke> {
        let OutlineStrokes { strokes: mut found, inside, places, lost, .. } = outlines(surface, view);
        counts.preprocess.insert("outline places".into(), places);
        counts.preprocess.insert("outline places without a root".into(), lost);
        let on_box = found.split_off(inside);
        let mut strokes = before_cusps(surface, view, &found);
        strokes.extend(on_box);
        strokes
    }

    /// Returns what a camera sees of outlines and creases, joined to long lines. `voxel` is the size of a voxel in world
    /// units, and `reach` its largest size on the page, in mm.
    pub fn visible(
        &self,
        sight: &Sight<'_>,
        [outlines, creases]: [&[Stroke]; 2],
        [voxel, reach]: [f64; 2],
        counts: &mut Counts,
    ) -> Layer {
        let nib = PenState { radius: self.pen.width / 2.0, opacity: 1.0, color: None };
        let sight = Sight { offset: OFFSET * voxel, ..*sight };
        let [mut seen, edges] = [outlines, creases].map(|strokes| sight.seen(strokes, |_, _| nib));
        *counts.preprocess.entry("looks for what hides".into()).or_default() += seen.looks + edges.looks;
        // A crease that runs beside an outline is the same edge.
        let (apart, depth) = (self.pen.width.max(BESIDE * reach), DEPTH * voxel);
        let gaps = [self.pen.width, apart];
        seen.lines.extend(without_doubles(&edges.lines, &seen.lines, sight.view, gaps, depth).lines);
        let all = seen.lines.len();
        let joining = Joining { reach: JOINED * apart, touch: self.pen.width, depth, min_length: self.min_length };
        let lines: Vec<Polyline> = joined(seen.lines, sight.view, &joining);
        counts.preprocess.insert("short strokes".into(), (all - lines.len()) as u64);
        Layer { lines, ..Layer::new(self.pen.clone()) }
    }
}
