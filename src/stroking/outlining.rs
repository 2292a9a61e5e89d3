//! Outlines on the page ([HATCH-18]).

use super::{StrokeCamera, on_page, pen, value};
use crate::Failure;
use drypoint_reference::interactive_volume_illustration::{PenState, outlines};
use drypoint_reference::surface::IsoSurface;
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Layer, Page, Pen, Polyline};
use drypoint_scene::tables::{Outlines, Scene};
use std::time::Instant;

/// Distance in front of the surface at which outlines are tested for visibility, in voxels. The surface curves away
/// slowly along the line to the eye, and that of a real scan is rough. With the 0.15 voxel of [HATCH-7] it hides parts
/// of its own outline; with half a voxel lines continue around their ends as small hooks.
const OFFSET: f64 = 0.3;

/// Settings of outlines.
pub(super) struct Outlining {
    /// Iso-value of the surface.
    pub(super) iso: f64,
    pen: Pen,
    /// Least length, in mm.
    min_length: f64,
}

impl Outlining {
    pub(super) fn new(scene: &Scene, table: &Outlines, page: &Page) -> Result<Self, Failure> {
        Ok(Self {
            iso: value(scene, table.iso, "outlines.iso")?,
            pen: pen(scene, "outlines", page, table.pen.as_deref(), (table.width, table.color))?,
            min_length: on_page(scene, page, table.min_length, "outlines.min_length")?,
        })
    }

    /// Returns the outlines that a camera sees.
    pub(super) fn draw(
        &self,
        frame: &StrokeCamera<'_>,
        surface: &IsoSurface<'_, '_>,
        voxel: f64,
        counts: &mut Counts,
    ) -> Layer {
        let start = Instant::now();
        let found = outlines(surface, frame.view);
        counts.preprocess.insert("outline places".into(), found.places);
        counts.preprocess.insert("outline places without a root".into(), found.lost);
        *counts.seconds.entry("outlines".into()).or_default() += start.elapsed().as_secs_f64();

        let start = Instant::now();
        let nib = PenState { radius: self.pen.width / 2.0, opacity: 1.0, color: None };
        let seen = frame.sight(OFFSET * voxel).seen(&found.strokes, |_, _| nib);
        let all = seen.lines.len();
        let lines: Vec<Polyline> = seen.lines.into_iter().filter(|line| line.length() >= self.min_length).collect();
        *counts.preprocess.entry("looks for what hides".into()).or_default() += seen.looks;
        counts.preprocess.insert("short strokes".into(), (all - lines.len()) as u64);
        *counts.seconds.entry("hidden strokes".into()).or_default() += start.elapsed().as_secs_f64();
        Layer { lines, ..Layer::new(self.pen.clone()) }
    }
}
