//! A selection on a ray: the samples in its box, and f_S at them (eq. 1; [VS-2]).

use crate::number::{Real, Vec3};
use crate::ray::lattice::IndexRay;
use crate::ray::prepared::Prepared;
use crate::ray::prepared_combination::{PreparedMembership, PreparedSelection};
use drypoint_scene::space::Grid;
use drypoint_scene::view::Ray;

/// No samples.
pub(in crate::ray) const EMPTY: [i64; 2] = [1, 0];

/// A selection on a ray, at its original place and where it is moved.
pub(in crate::ray) struct SelectionRay<R> {
    pub(in crate::ray) here: PlacedSelection<R>,
    pub(in crate::ray) there: PlacedSelection<R>,
}

/// A selection's grid on a ray.
pub(in crate::ray) struct PlacedSelection<R> {
    /// The ray in the index space of the memberships.
    pub(in crate::ray) ray: Option<IndexRay<R>>,
    /// The samples at which there can be members.
    pub(in crate::ray) range: [i64; 2],
}

impl<R: Real> SelectionRay<R> {
    pub(super) fn new(selection: &PreparedSelection<'_, R>, prepared: &Prepared<'_, R>, pixel: &Ray) -> Self {
        let placed = |grid: Option<&Grid>| {
            let ray = grid.map(|grid| IndexRay::<R>::new(pixel, &prepared.view, &prepared.lattice, grid));
            let range = ray.zip(selection.members).map(|(ray, ends)| ray.inside(ends.map(Vec3::from_glam)));
            PlacedSelection { ray, range: range.unwrap_or(EMPTY) }
        };
        Self { here: placed(Some(&selection.here)), there: placed(selection.there.as_ref()) }
    }
}

impl<R: Real> PlacedSelection<R> {
    /// f_S at sample k, which lies in the box; if the sample is on a cut, at the cut's depth. `value` returns the value of
    /// the data.
    pub(super) fn membership(
        &self,
        selection: &PreparedSelection<'_, R>,
        (k, cut_depth): (i64, Option<R>),
        value: impl FnOnce() -> Option<R>,
    ) -> R {
        match (&selection.membership, &self.ray) {
            (PreparedMembership::Everything, _) => R::ONE,
            (PreparedMembership::Value(function), _) => {
                let place = value().and_then(|s| function.locate(s));
                place.map_or(R::ZERO, |place| place.alpha_u)
            }
            (PreparedMembership::Voxels(memberships), Some(ray)) => {
                memberships.at(cut_depth.map_or_else(|| ray.position(k), |depth| ray.position_at(depth)))
            }
            (PreparedMembership::Voxels(_), None) => R::ZERO,
        }
    }
}

/// Whether a sample lies in a range.
#[inline]
pub(super) fn contains([first, last]: [i64; 2], k: i64) -> bool {
    first <= k && k <= last
}
