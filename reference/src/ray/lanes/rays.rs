//! Rays through eight points of the picture side by side. The operations are those of
//! [`View::ray`](drypoint_scene::view::View::ray), [`IndexRay::new`](crate::ray::lattice::IndexRay::new) and
//! [`SampleShader::view_dirs`](crate::ray::sample::SampleShader::view_dirs).

use crate::field::lanes::LANES;
use crate::number::Vec3;
use crate::ray::prepared::Prepared;
use crate::ray::sample::SampleShader;
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::shot::StepAlong;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8};

/// Eight rays. Lanes beyond the last point repeat it.
pub(super) struct Rays<S: Simd> {
    /// Origin in index space.
    pub(super) origin: Vec3<f64x8<S>>,
    /// Displacement in index space for one unit of depth.
    pub(super) along: Vec3<f64x8<S>>,
    /// Eye depth between samples.
    pub(super) depth_step: f64x8<S>,
    /// Δ_ray.
    pub(super) step: f64x8<S>,
    /// v in the world.
    pub(super) v: Vec3<f64x8<S>>,
    /// v in eye space.
    pub(super) v_eye: Vec3<f64x8<S>>,
    /// Ĥ, if there is Phong shading.
    pub(super) half: Vec3<f64x8<S>>,
}

impl<S: Simd> Rays<S> {
    #[inline(always)]
    pub(super) fn through(simd: S, prepared: &Prepared<'_, f64>, points: &[[f64; 2]]) -> Self {
        let (mut i, mut j) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            [i[lane], j[lane]] = points[lane.min(points.len() - 1)];
        }
        let (i, j): (f64x8<S>, f64x8<S>) = (i.simd_into(simd), j.simd_into(simd));
        let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
        let (view, lattice, grid) = (&prepared.view, &prepared.lattice, prepared.object.volume.grid());
        let [right, up, forward] = [view.right, view.up, view.forward].map(|v| all(simd, v));
        let x = (i - view.size[0] as f64 / 2.0) * view.pixel;
        let y = (f64x8::splat(simd, view.size[1] as f64 / 2.0) - j) * view.pixel;
        let (mut origin, mut along, mut cos_phi) = (all(simd, view.eye), forward, one);
        let mut v_eye = Vec3::new(zero, zero, one);
        if view.perspective {
            let length = (one + x * x + y * y).sqrt();
            along = forward + right * x + up * y;
            cos_phi = one / length;
            v_eye = Vec3::new(-x / length, -y / length, cos_phi);
        } else {
            origin = origin + right * x + up * y;
        }
        let by_ray = lattice.along == StepAlong::Ray;
        let step = f64x8::splat(simd, lattice.step);
        let v = right * v_eye.x + up * v_eye.y - forward * v_eye.z;
        let mut half = Vec3::new(zero, zero, zero);
        if let SampleShader::Regular { phong: Some(phong), .. } = &prepared.object.shader {
            half = phong.half_vector(v);
        }
        Self {
            origin: apply(simd, &grid.inverse_axes(), origin - all(simd, grid.origin())),
            along: apply(simd, &grid.inverse_axes(), along),
            depth_step: if by_ray { step * cos_phi } else { step },
            step: if by_ray { step } else { step / cos_phi },
            v,
            v_eye,
            half,
        }
    }
}

/// One vector in all lanes.
#[inline(always)]
fn all<S: Simd>(simd: S, v: DVec3) -> Vec3<f64x8<S>> {
    Vec3::new(f64x8::splat(simd, v.x), f64x8::splat(simd, v.y), f64x8::splat(simd, v.z))
}

/// M·v, column by column.
#[inline(always)]
fn apply<S: Simd>(simd: S, m: &DMat3, v: Vec3<f64x8<S>>) -> Vec3<f64x8<S>> {
    all(simd, m.x_axis) * v.x + all(simd, m.y_axis) * v.y + all(simd, m.z_axis) * v.z
}
