//! The foot of a point on an iso-surface ([HATCH-7], [STIP-15]).

use super::IsoSurface;
use crate::field::Sampler;
use crate::field::normal::outward;
use crate::number::Vec3;
use drypoint_scene::glam::DVec3;

impl IsoSurface<'_, '_> {
    /// Finds the first place where the straight line through a point meets the surface. `along` is a unit vector of
    /// the world, such as the point's normal. The search reaches `reach` world units to either side; the nearer place
    /// is preferred.
    ///
    /// A place whose own normal points along the line comes before one whose normal does not. The latter belongs to
    /// the other side of a thin wall. Returns none if there is no place. The point and its foot are in index space.
    pub fn foot(&self, point: DVec3, along: DVec3, reach: f64) -> Option<DVec3> {
        let grid = self.field.volume().grid();
        let to_index = grid.inverse_axes() * along;
        let [lo, hi] = grid.index_box();
        // On a face of the box, rounding may lead outside.
        let at = |t: f64| (point + to_index * t).clamp(lo, hi);
        let to = |way: f64| self.first_root_in_index(point, to_index * way, [0.0, reach]).map(|t| way * t);
        let (ahead, behind) = (to(1.0), to(-1.0));
        let (Some(a), Some(b)) = (ahead, behind) else { return ahead.or(behind).map(at) };
        let (near, far) = if a <= -b { (at(a), at(b)) } else { (at(b), at(a)) };
        let goes_along = |foot| self.normal(foot).is_some_and(|n| n.dot(along) > 0.0);
        Some(if !goes_along(near) && goes_along(far) { far } else { near })
    }

    /// N in world space, by the field's gradient. Returns none where the gradient is rounding error ([PREC-3]), and
    /// outside the volume.
    pub fn normal(&self, index: DVec3) -> Option<DVec3> {
        let field = self.field;
        let g = self.holds(index).then(|| field.gradient(Vec3::from_glam(index)))?;
        outward(g, field.reconstruction().outside, field.no_normal_below()).map(Vec3::to_glam)
    }
}
