//! The rays of one tile, as they are passed to the functions that cast them.

use super::brick_occupancy::RayIntervals;
use super::composite::Cast;
use drypoint_scene::counts::Counts;

/// Rays of one tile that are to be cast.
pub(super) struct TileWork<'a> {
    /// Points of the picture that the rays go through, in pixels from the top left corner.
    pub(super) points: &'a [[f64; 2]],
    /// Boxes of visible bricks that the rays can meet; none if nothing is skipped.
    pub(super) boxes: Option<&'a mut RayIntervals>,
    pub(super) counts: &'a mut Counts,
    /// Results, appended in the order of the points.
    pub(super) casts: &'a mut Vec<Cast>,
}

/// Casts rays of a tile.
pub(super) trait CastAll: Fn(TileWork<'_>) + Sync {}

impl<F: Fn(TileWork<'_>) + Sync> CastAll for F {}

/// The rays of a tile: their points, in pixels from the top left corner, their column and row among all rays, and the
/// boxes of visible bricks that they can meet.
pub(crate) struct TileRays {
    pub(crate) points: Vec<[f64; 2]>,
    pub(crate) places: Vec<[usize; 2]>,
    pub(crate) boxes: Option<RayIntervals>,
}
