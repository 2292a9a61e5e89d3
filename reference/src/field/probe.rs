//! The field's value, derivatives, normal and curvatures at one point, in world units ([CUR-1], [CUR-2], [NORM-1]).

use super::{Field, Outside, Sampler, curvature, normal};
use crate::number::{Sym3, Vec3};
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::math;

/// The field at one point. Derivatives are in value per world unit, or per world unit squared; curvatures per world
/// unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe {
    /// The value, after slope and intercept.
    pub value: f64,
    /// The gradient, by the estimator of the gradient.
    pub gradient: DVec3,
    /// The Hessian, by its estimator; symmetric.
    pub hessian: DMat3,
    /// N, the outward unit normal; none where the gradient is negligible ([PREC-3]).
    pub normal: Option<DVec3>,
    /// The larger principal curvature. All curvatures are 0 if the gradient, or that of the Hessian's field, is
    /// negligible.
    pub k1: f64,
    /// The smaller principal curvature.
    pub k2: f64,
    /// Unit direction of `k1`; none where there is no curvature.
    pub e1: Option<DVec3>,
    /// Unit direction of `k2`.
    pub e2: Option<DVec3>,
    /// Mean curvature.
    pub mean: f64,
    /// Gaussian curvature, per world unit squared.
    pub gaussian: f64,
    /// Curvature along a view direction, if one was given.
    pub kv: Option<f64>,
}

/// Probes a field at a position in index space. Returns none outside the box of [SPACE-1]. `view` points towards the
/// eye and may have any length.
///
/// # Panics
/// If the field was prepared for a lower rung than `Hessian`.
pub fn at_index(field: &Field<'_, f64>, index: DVec3, view: Option<DVec3>) -> Option<Probe> {
    let [lo, hi] = field.volume().grid().index_box();
    if !(index.cmpge(lo).all() && index.cmple(hi).all()) {
        return None;
    }
    let p = Vec3::from_glam(index);
    let (value, gradient, (own, hessian)) = (field.value(p), field.gradient(p), field.hessian(p));
    let outside: Outside = field.reconstruction().outside;
    let normal = normal::outward(gradient, outside, field.no_normal_below());
    let has_surface = normal.is_some() && normal::outward(own, outside, field.no_normal_below()).is_some();
    let curvature = has_surface.then(|| curvature::principal(own, hessian, outside));
    let along_view = |v: DVec3| {
        if has_surface {
            curvature::along_view(own, hessian, Vec3::from_glam(v.normalize_or_zero()), outside)
        } else {
            0.0
        }
    };
    let unscaled = |x: f64| math::scale_by_power_of_two(x, field.scale_exponent());
    let Sym3 { xx, xy, xz, yy, yz, zz } = hessian;
    Some(Probe {
        value,
        gradient: gradient.to_glam().to_array().map(unscaled).into(),
        hessian: DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz].map(unscaled)),
        normal: normal.map(Vec3::to_glam),
        k1: curvature.map_or(0.0, |c| c.k1),
        k2: curvature.map_or(0.0, |c| c.k2),
        e1: curvature.map(|c| c.e1.to_glam()),
        e2: curvature.map(|c| c.e2.to_glam()),
        mean: curvature.map_or(0.0, |c| c.mean()),
        gaussian: curvature.map_or(0.0, |c| c.gaussian()),
        kv: view.map(along_view),
    })
}

/// Probes a field at a position in world space. See [`at_index`]. A position that lies outside by rounding alone is
/// moved to the border. For example, 21.7 at a spacing of 0.7 is voxel 31, not 31.000000000000004.
///
/// # Panics
/// If the field was prepared for a lower rung than `Hessian`.
pub fn at_world(field: &Field<'_, f64>, world: DVec3, view: Option<DVec3>) -> Option<Probe> {
    let grid = field.volume().grid();
    let index = grid.to_index(world);
    let [lo, hi] = grid.index_box();
    let border = index.clamp(lo, hi);
    let back = grid.to_world(border);
    let rounding = 16.0 * f64::EPSILON * world.abs().max(back.abs()).max(grid.origin().abs()).max_element();
    let near = (back - world).abs().max_element() <= rounding;
    at_index(field, if near { border } else { index }, view)
}
