//! N·v, the second function of outlines ([HATCH-18]): an iso-surface turns away from the eye where it is 0.
//!
//! N·v is computed as g·v, with v towards the eye at each place. So it contains no norm, and its zeros are those of the
//! gradient that the scene samples.
//!
//! With a trilinear kernel and its analytic gradient, N·v jumps at the faces of cells, and most places have no root
//! nearby. Of a sphere's circle only 38 % is found, in eleven pieces. Every other pair of kernel and gradient gives a
//! closed circle.

use super::search::position;
use super::second_function::SecondFunction;
use super::tetrahedra::any_sign_change;
use crate::field::{Field, Sampler};
use crate::number::Vec3;
use drypoint_scene::glam::DVec3;
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;

/// g·v for a camera.
pub(super) struct Facing<'a> {
    pub(super) view: &'a View,
    pub(super) grid: &'a Grid,
    pub(super) field: &'a Field<'a, f64>,
}

impl Facing<'_> {
    /// g·v at a place in index space, v of length 1 towards the eye.
    pub(super) fn product(&self, at: DVec3, g: Vec3<f64>) -> f64 {
        let v = if self.view.perspective {
            (self.view.eye - self.grid.to_world(at)).normalize_or_zero()
        } else {
            -self.view.forward
        };
        g.to_glam().dot(v)
    }
}

impl SecondFunction for Facing<'_> {
    type Corner = f64;

    fn at_voxel(&self, voxel: [usize; 3]) -> f64 {
        self.product(position(voxel), self.field.voxel_gradient(voxel))
    }

    fn may_vanish(&self, corners: &[f64; 8]) -> bool {
        any_sign_change(corners)
    }

    fn values(&self, corners: [f64; 4]) -> Option<[f64; 4]> {
        Some(corners)
    }

    fn near(&self, _start: DVec3) -> Option<impl Fn(DVec3) -> f64> {
        Some(|at: DVec3| self.product(at, self.field.gradient(Vec3::from_glam(at))))
    }

    fn holds(&self, _at: DVec3) -> bool {
        true
    }
}
