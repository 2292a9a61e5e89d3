//! The factors of eq. 3 ([STIP-5] … [STIP-12]), one file each. A factor without a table in the scene is 1 and costs
//! nothing.

mod boundary;
mod distance;
mod interior;
mod lighting;
mod resolution;
mod silhouette;

pub use resolution::viewing_distance;

use super::ridge::across;
use drypoint_scene::glam::DVec3;
use drypoint_scene::points::PointVoxel;
use drypoint_scene::shot::StippleParams;
use drypoint_scene::shot::stipples::{DotDensity, FactorRange};
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;

/// Brings a factor into [0, 1] ([STIP-5]): clamped, or divided by its largest value if that exceeds 1. The largest
/// value is `sum`, at V = 1.
fn unit(range: FactorRange, sum: f64, factor: f64) -> f64 {
    match range {
        FactorRange::Normalize if sum > 1.0 => factor / sum,
        FactorRange::Clamp | FactorRange::Normalize => factor.min(1.0),
    }
}

/// The camera-independent factors of a voxel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FixedFactors {
    /// T_b.
    boundary: f64,
    /// T_t.
    interior: f64,
    /// The voxel's piece of a face, relative to the largest piece: 1 except for thin layers on grids whose voxels are
    /// not cubes ([STIP-4]).
    pub(super) piece: f64,
}

impl FixedFactors {
    pub(super) fn new(stipples: &StippleParams, voxel: &PointVoxel, grid: &Grid) -> Self {
        let PointVoxel { value, magnitude, .. } = *voxel;
        Self {
            boundary: stipples.boundary.map_or(1.0, |t| boundary::boundary(&t, stipples.factors, value, magnitude)),
            interior: stipples.interior.filter(|t| t.te != 0.0).map_or(1.0, |t| interior::interior(&t, magnitude)),
            piece: if stipples.is_thin() { (grid.voxel() / across(grid, voxel.normal)).min(1.0) } else { 1.0 },
        }
    }
}

/// The factors of one camera.
pub(super) struct CameraFactors<'a> {
    stipples: &'a StippleParams,
    view: &'a View,
    /// L, in world space.
    light: DVec3,
    /// T_r.
    resolution: f64,
    /// The eye depth of the volume's centre.
    depth: f64,
    /// a.
    radius: f64,
    /// Whether a factor uses n·E.
    facing: bool,
}

/// Properties of the whole volume that a frame uses.
pub(super) struct VolumeExtent {
    pub(super) centre: DVec3,
    pub(super) radius: f64,
    /// D₀, the distance of the reference camera.
    pub(super) reference: f64,
    pub(super) near: f64,
}

/// T of eq. 3, and its factors that enter eq. 4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Factors {
    /// T, the share of the points; with density = "page" times |n·E| ([STIP-21]).
    pub(super) count: f64,
    /// T_r·T_d·T_t, the share of the size apart from ‖∇V‖.
    pub(super) size: f64,
}

impl<'a> CameraFactors<'a> {
    pub(super) fn new(stipples: &'a StippleParams, view: &'a View, whole: &VolumeExtent) -> Self {
        let lighting = stipples.lighting.filter(|t| t.le != 0.0);
        let distance = || viewing_distance(view, whole.centre, whole.near);
        Self {
            stipples,
            view,
            light: lighting.map_or(DVec3::ZERO, |_| view.towards(stipples.light)),
            resolution: stipples.resolution.map_or(1.0, |t| resolution::resolution(&t, whole.reference, distance())),
            depth: -view.to_eye(whole.centre).z,
            radius: whole.radius,
            facing: lighting.is_some() || stipples.silhouette.is_some() || stipples.density == DotDensity::Page,
        }
    }

    /// The factors of a voxel at eye-space position `at`.
    pub(super) fn of(&self, still: &FixedFactors, voxel: &PointVoxel, at: DVec3) -> Factors {
        let s = self.stipples;
        let facing = if self.facing { self.facing(voxel, at) } else { 1.0 };
        let silhouette = |t| silhouette::silhouette(&t, s.factors, voxel.value, voxel.magnitude, facing);
        let silhouette = s.silhouette.map_or(1.0, silhouette);
        let distance = s.distance.map_or(1.0, |t| distance::distance(&t, (self.depth + at.z) / self.radius));
        let lighting = s.lighting.map_or(1.0, |t| lighting::lighting(&t, self.light.dot(voxel.normal), facing));
        let size = self.resolution * distance * still.interior;
        // A piece of a face has |n·E| of its area on the page.
        let area = if s.density == DotDensity::Page { facing.abs().min(1.0) } else { 1.0 };
        Factors { count: still.boundary * silhouette * size * lighting * area, size }
    }

    /// n·E, E the unit vector from the voxel to the eye.
    fn facing(&self, voxel: &PointVoxel, at: DVec3) -> f64 {
        let n = self.view.direction_to_eye(voxel.normal);
        if self.view.perspective { n.dot(-at) / at.length().max(f64::MIN_POSITIVE) } else { n.z }
    }
}
