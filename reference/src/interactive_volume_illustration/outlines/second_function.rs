//! The second function of a curve on a surface, f = iso and q = 0 ([HATCH-18], [HATCH-22]).

use drypoint_scene::glam::DVec3;

/// A function q whose sign may be known only from place to place. Places are in index space.
pub(super) trait SecondFunction: Sync {
    /// The function at a voxel, with all that its sign depends on.
    type Corner: Copy;

    /// Returns the function at a voxel.
    fn at_voxel(&self, voxel: [usize; 3]) -> Self::Corner;

    /// Whether q may vanish in a cell with these corners.
    fn may_vanish(&self, corners: &[Self::Corner; 8]) -> bool;

    /// Returns q at the corners of a tetrahedron with one choice of its sign. Another choice negates all values. None
    /// if there is no such choice.
    fn values(&self, corners: [Self::Corner; 4]) -> Option<[f64; 4]>;

    /// Returns q near a place, with one choice of its sign.
    fn near(&self, start: DVec3) -> Option<impl Fn(DVec3) -> f64>;

    /// Whether a zero of both functions belongs to the curve.
    fn holds(&self, at: DVec3) -> bool;
}
