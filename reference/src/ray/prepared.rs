//! A shot prepared for casting: everything that is decided once for each picture, and not at samples.

use super::brick_occupancy::BrickOccupancy;
use super::cell_mask::CellMask;
use super::lattice::IndexRay;
use super::prepared_combination::PreparedCombination;
use super::prepared_halos::PreparedHalos;
use super::prepared_meshes::PreparedMeshes;
use super::prepared_surface::PreparedSurface;
use super::sample::{EyeAxes, PreparedObject};
use crate::number::Real;
use drypoint_scene::fragments::{Fragment, Fragments};
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::Lattice;
use drypoint_scene::view::View;

/// A shot ready to be cast.
pub(super) struct Prepared<'v, R> {
    pub(super) object: PreparedObject<'v, R>,
    /// Objects that are drawn with the background `object`, if there are any.
    pub(super) combination: Option<PreparedCombination<'v, R>>,
    pub(super) view: View,
    pub(super) lattice: Lattice,
    pub(super) skip: Option<BrickOccupancy>,
    /// The mask of visible cells. None if values are cheap or nothing is skipped.
    pub(super) cells: Option<CellMask>,
    /// Lines on the rays, at their depths, if there are any.
    pub(super) lines: Option<Fragments>,
    /// The opaque iso-surface, if there is one.
    pub(super) surface: Option<PreparedSurface<R>>,
    /// Opaque meshes, if there are any.
    pub(super) meshes: Option<PreparedMeshes<'v, R>>,
    /// Halos, if there are any.
    pub(super) halos: Option<PreparedHalos<'v>>,
    /// A at which a ray ends ([RAY-2]).
    pub(super) stop_at: R,
    /// Whether colours are composited encoded ([VAL-3]).
    pub(super) encode: bool,
    /// Whether a layer beyond the beauty is asked for.
    pub(super) collects: bool,
    /// The number of objects whose coverage is summed, the background first. 0 if no layer shows coverage.
    pub(super) covering: usize,
    pub(super) layers: Vec<LayerKind>,
    pub(super) eye_axes: EyeAxes<R>,
    /// n of the n×n rays of a pixel.
    pub(super) rays_across: usize,
    /// Contrast to a neighbour above which a pixel gets five or nine rays; none if no pixel is refined.
    pub(super) refine_above: Option<f64>,
}

impl<R: Real> Prepared<'_, R> {
    /// The depth at which the samples of a ray begin. It is −∞ in an orthographic picture.
    pub(super) fn near_of(&self, ray: &IndexRay<R>) -> f64 {
        match self.view.perspective {
            // For spherical shells, `near` is the radius.
            true => self.lattice.near * (ray.depth_step.to_f64() / self.lattice.step),
            false => f64::NEG_INFINITY,
        }
    }

    /// The lines on the ray through a point of the picture, in pixels from the top left corner.
    #[inline]
    pub(super) fn lines_at(&self, point: [f64; 2]) -> &[Fragment] {
        self.lines.as_ref().map_or(&[], |lines| lines.at(point))
    }
}
