//! The iso-surface on a ray, and the depths between which an f32 renderer meets it.

use crate::field::Field;
use crate::number::{Bounded, Vec3};
use crate::ray::lattice::IndexRay;
use crate::ray::prepared::Prepared;
use crate::surface::RootFinder;

/// Half a unit in the last place of 1.
const ROUNDING: f64 = 0.5 * f32::EPSILON as f64;

/// Roundings of the cubic of a cell, relative to the largest number in it. There is one of each voxel and one of its
/// difference to iso, five of the interpolation along each axis, and those of the polar forms and of de Casteljau's
/// scheme.
const ROUNDINGS: f64 = 60.0;

/// The largest error of the depth, in voxels. Beyond it the intersection is open.
const MOST: f64 = 1.0 / 16.0;

/// Bounds of the errors that values of the field have in f32.
pub(super) struct SurfaceErrors {
    /// The largest difference of neighbouring voxels along each axis.
    slopes: [f64; 3],
    /// The roundings of a value and of iso.
    roundings: f64,
}

/// The intersection of a ray with the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundedHit {
    pub(super) t: f64,
    /// The largest difference in depth to the intersection of an f32 renderer.
    pub(super) error: f64,
}

/// The intersection of a ray with the surface, for the reference and for an f32 renderer.
pub(super) enum Met {
    /// Neither of them finds an intersection.
    Nowhere,
    /// Both find an intersection.
    At(BoundedHit),
    /// One of them may find none, or one far away. The field is the reference's depth, if it finds one.
    Open(Option<f64>),
}

impl SurfaceErrors {
    /// Measures the voxels of a trilinear field.
    pub(super) fn new(field: &Field<'_, Bounded>, iso: f64) -> Self {
        let volume = field.volume();
        let dims = volume.dims();
        let mut slopes: [f64; 3] = [0.0; 3];
        for z in 0..dims[2] {
            for y in 0..dims[1] {
                for x in 0..dims[0] {
                    let here = [x, y, z];
                    for (axis, slope) in slopes.iter_mut().enumerate() {
                        let mut next = here;
                        next[axis] += 1;
                        if next[axis] < dims[axis] {
                            *slope = slope.max((volume.value(next) - volume.value(here)).abs());
                        }
                    }
                }
            }
        }
        let largest = volume.largest_magnitude() + volume.intercept().abs();
        Self { slopes, roundings: ROUNDING * (ROUNDINGS * largest + iso.abs()) }
    }

    /// The first intersection of a ray with the surface. A value in f32 differs from the field's by at most e. So an
    /// f32 renderer finds iso no sooner than the field meets the first of iso − e and iso + e, and no later than it has
    /// met both.
    #[inline]
    pub(super) fn first(&self, prepared: &Prepared<'_, Bounded>, ray: &IndexRay<Bounded>, errors: [f64; 3]) -> Met {
        let Some(surface) = &prepared.surface else { return Met::Nowhere };
        let near = match prepared.view.perspective {
            true => prepared.lattice.near * (ray.depth_step.value() / prepared.lattice.step),
            false => f64::NEG_INFINITY,
        };
        let (field, mask) = (&prepared.object.field, prepared.object.volume.mask());
        let first = |roots: &RootFinder| roots.first(field, mask, ray.line(), [near, f64::INFINITY]);
        let off = self.roundings + (0..3).map(|axis| self.slopes[axis] * errors[axis]).sum::<f64>();
        let iso = surface.roots.iso();
        let [below, above] = [-off, off].map(|off| first(&RootFinder::new(field, iso + off, None)));
        let here = first(&surface.roots);
        match (here, below, above) {
            (None, None, None) => Met::Nowhere,
            (Some(t), Some(below), Some(above)) => {
                let error = (below - t).abs().max((above - t).abs());
                let [_, along] = ray.line();
                let is_met = along.abs().max_element() * error <= MOST;
                if is_met { Met::At(BoundedHit { t, error }) } else { Met::Open(here) }
            }
            _ => Met::Open(here),
        }
    }
}

/// The position on a ray at a depth that is known up to `error`.
pub(super) fn at_depth(
    position: Vec3<Bounded>,
    ray: &IndexRay<Bounded>,
    errors: [f64; 3],
    error: f64,
) -> Vec3<Bounded> {
    let [_, along] = ray.line();
    let moved = |p: Bounded, axis: usize| Bounded::new(p.value(), errors[axis] + along[axis].abs() * error);
    Vec3::new(moved(position.x, 0), moved(position.y, 1), moved(position.z, 2))
}
