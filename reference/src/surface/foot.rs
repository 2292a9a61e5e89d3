//! The foot of a point on an iso-surface ([HATCH-7], [STIP-15]).

use super::IsoSurface;
use crate::field::Sampler;
use crate::field::normal::outward;
use crate::number::Vec3;
use crate::with_sampler;
use drypoint_scene::glam::DVec3;

impl IsoSurface<'_, '_> {
    /// Where the straight line through a point along a unit vector of the world, such as its gradient's, first meets the
    /// surface, at most `reach` world units from the point to either side, the nearer of both; none where there is no such
    /// place. The point and its foot are in index space.
    pub fn foot(&self, point: DVec3, along: DVec3, reach: f64) -> Option<DVec3> {
        let grid = self.field.volume().grid();
        let along = grid.inverse_axes() * along;
        let to = |way: f64| self.first_root_in_index(point, along * way, [0.0, reach]).map(|t| way * t);
        let foot = match (to(1.0), to(-1.0)) {
            (Some(a), Some(b)) => Some(if a <= -b { a } else { b }),
            (a, b) => a.or(b),
        };
        let [lo, hi] = grid.index_box();
        // On a face of the box rounding may leave it.
        foot.map(|t| (point + along * t).clamp(lo, hi))
    }

    /// A place in index space moved by a distance in world units along the normal there: outwards, or inwards if it is below
    /// 0. It stays where there is no normal.
    pub fn in_front(&self, foot: DVec3, distance: f64) -> DVec3 {
        let to_index = self.field.volume().grid().inverse_axes();
        self.normal(foot).map_or(foot, |n| foot + to_index * (n * distance))
    }

    /// N in world space, by the field's gradient; none where it is rounding ([PREC-3]), and outside the volume.
    pub fn normal(&self, index: DVec3) -> Option<DVec3> {
        let field = self.field;
        let g = self.holds(index).then(|| with_sampler!(field, |sampler| sampler.gradient(Vec3::from_glam(index))))?;
        outward(g, field.reconstruction().outside, field.no_normal_below()).map(Vec3::to_glam)
    }
}
