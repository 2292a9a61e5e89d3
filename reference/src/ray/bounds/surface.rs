//! The iso-surface on a ray, and the depths between which an f32 renderer meets it.

use super::positions::{Answer, is_in_box};
use super::stepped_root;
use crate::field::{Field, Kernel, Outside, Sampler};
use crate::number::{Bounded, Real, Vec3, ways};
use crate::ray::lattice::IndexRay;
use crate::ray::prepared::Prepared;
use crate::surface::{Clipped, RootFinder, SurfaceHit};

/// Half a unit in the last place of 1.
const ROUNDING: f64 = 0.5 * f32::EPSILON as f64;

/// Roundings of the cubic of a cell, relative to the largest number in it. There is one of each voxel and one of its
/// difference to iso, five of the interpolation along each axis, and those of the polar forms and of de Casteljau's
/// scheme.
const ROUNDINGS: f64 = 60.0;

/// The largest error of the depth, in voxels. Beyond it the intersection is open.
pub(super) const MOST: f64 = 1.0 / 16.0;

/// The search for the surface, with bounds of the errors that values of the field have in f32.
pub(super) struct SurfaceErrors {
    /// Those of a trilinear field. Values of other kernels are enclosed where a ray meets them.
    trilinear: Option<ValueErrors>,
}

/// Errors of the values of a trilinear field.
struct ValueErrors {
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
    /// Index of the clip plane that shows the cut; none for the surface itself.
    pub(super) cut: Option<usize>,
}

/// The intersection of a ray with the surface, for the reference and for an f32 renderer.
#[derive(Clone, Copy)]
pub(super) enum Met {
    /// Neither of them finds an intersection.
    Nowhere,
    /// Both find an intersection.
    At(BoundedHit),
    /// One of them may find none, or one far away. The field is the reference's intersection, if it finds one.
    Open(Option<SurfaceHit>),
}

impl ValueErrors {
    /// Measures the voxels of a trilinear field.
    fn new(field: &Field<'_, Bounded>, iso: f64) -> Self {
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

    /// The first root on a ray from a depth on. A value in f32 differs from the field's by at most e. So an f32 renderer
    /// finds iso no sooner than the field meets the first of iso − e and iso + e, and no later than it has met both.
    /// Roots beyond `end` count as none.
    #[inline]
    fn first(
        &self,
        field: &Field<'_, Bounded>,
        roots: &RootFinder,
        ray: &IndexRay<Bounded>,
        [start, end]: [f64; 2],
    ) -> Met {
        let (mask, errors) = (field.volume().mask(), ray.errors());
        let first =
            |roots: &RootFinder| roots.first(field, mask, ray.line(), [start, f64::INFINITY]).filter(|t| *t <= end);
        let off = self.roundings + (0..3).map(|axis| self.slopes[axis] * errors[axis]).sum::<f64>();
        let [below, above] = [-off, off].map(|off| first(&RootFinder::new(field, roots.iso() + off, None)));
        let here = first(roots);
        match (here, below, above) {
            (None, None, None) => Met::Nowhere,
            (Some(t), Some(below), Some(above)) => within_most(ray, t, (below - t).abs().max((above - t).abs())),
            _ => Met::Open(here.map(|t| SurfaceHit { t, cut: None })),
        }
    }
}

impl SurfaceErrors {
    /// Prepares the search for a value of a field.
    pub(super) fn new(field: &Field<'_, Bounded>, iso: f64) -> Self {
        let is_trilinear = field.reconstruction().kernel == Kernel::Trilinear;
        Self { trilinear: is_trilinear.then(|| ValueErrors::new(field, iso)) }
    }

    /// The first intersection of a ray with the surface, or with a plane that cuts its inside open ([RAY-8]). It is open
    /// if errors leave open whether the cut lies inside, or whether a plane comes before the intersection.
    #[inline]
    pub(super) fn first(&self, prepared: &Prepared<'_, Bounded>, ray: &IndexRay<Bounded>) -> Met {
        let Some(surface) = &prepared.surface else { return Met::Nowhere };
        let (object, roots) = (&prepared.object, &surface.roots);
        let (field, mask, planes) = (&object.field, object.volume.mask(), &object.clip.planes);
        let range = [prepared.near_of(ray), f64::INFINITY];
        let clipped = Clipped { clip: planes, outside: object.outside };
        let here = roots.first_left(field, mask, ray.line(), range, clipped);
        let Some([from, to]) = ray.kept_part(planes, range, object.ends) else { return Met::Nowhere };
        if from[0] > to[1] {
            return Met::Nowhere;
        }
        if from[1] > to[0] {
            return Met::Open(here);
        }
        let start = 0.5 * (from[0] + from[1]);
        if from[0] > range[0] {
            let error = 0.5 * (from[1] - from[0]);
            match (is_inside_surface(prepared, ray, roots.iso(), (start, error)), here) {
                (Answer::Yes, Some(hit)) if hit.cut.is_some() => {
                    return Met::At(BoundedHit { t: hit.t, error, cut: hit.cut });
                }
                (Answer::No, _) => {}
                _ => return Met::Open(here),
            }
        }
        let met = match &self.trilinear {
            Some(values) => values.first(field, roots, ray, [start, to[1]]),
            None => stepped_root::first(field, roots, ray, [start, to[1]]),
        };
        match met {
            Met::At(hit) if hit.t + hit.error < to[0] => Met::At(hit),
            Met::Nowhere => Met::Nowhere,
            Met::At(_) | Met::Open(_) => Met::Open(here),
        }
    }
}

/// An intersection whose depth has this error.
pub(super) fn within_most(ray: &IndexRay<Bounded>, t: f64, error: f64) -> Met {
    let [_, along] = ray.line();
    if along.abs().max_element() * error <= MOST {
        Met::At(BoundedHit { t, error, cut: None })
    } else {
        Met::Open(Some(SurfaceHit { t, cut: None }))
    }
}

/// Whether the place at a depth, which is known up to an error, is inside the surface or on it.
#[inline]
fn is_inside_surface(
    prepared: &Prepared<'_, Bounded>,
    ray: &IndexRay<Bounded>,
    iso: f64,
    (t, error): (f64, f64),
) -> Answer {
    let object = &prepared.object;
    let [origin, along] = ray.line();
    let p = at_depth(Vec3::from_glam(origin + along * t), ray, error);
    match is_in_box(p, object.ends) {
        Answer::Yes => {}
        other => return other,
    }
    // The value on all ways, since neighbouring cells have different slopes. None in a cell that touches a masked voxel.
    let value = ways::follow(|| {
        let at = object.field.place(p);
        let is_masked = object.volume.mask().is_some_and(|mask| mask.touches_cell(at.cell));
        (!is_masked).then(|| object.field.value_at(at))
    });
    let is_inside = |value: Option<Bounded>| {
        let Some(value) = value else { return Answer::No };
        let [lo, hi] = (value - Bounded::from_f64(iso)).ends();
        let [least, most] = if object.outside == Outside::Low { [lo, hi] } else { [-hi, -lo] };
        match (least > 0.0, most < 0.0) {
            (true, _) => Answer::Yes,
            (_, true) => Answer::No,
            _ => Answer::Open,
        }
    };
    let by_value = is_inside(value.by_value);
    let agree = !value.too_many && value.others.iter().all(|(other, _)| is_inside(*other) == by_value);
    if agree { by_value } else { Answer::Open }
}

/// The position on a ray at a depth that is known up to `error`.
pub(super) fn at_depth(position: Vec3<Bounded>, ray: &IndexRay<Bounded>, error: f64) -> Vec3<Bounded> {
    let ([_, along], errors) = (ray.line(), ray.errors());
    let moved = |p: Bounded, axis: usize| Bounded::new(p.value(), errors[axis] + along[axis].abs() * error);
    Vec3::new(moved(position.x, 0), moved(position.y, 1), moved(position.z, 2))
}
