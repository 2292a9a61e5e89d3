//! Rays with lines inside a translucent volume ([HATCH-14] d), objects ([VS-2]) or cuts ([RAY-8]) are cast one by one,
//! the others side by side.

use super::lattice::IndexRay;
use super::prepared::Prepared;
use super::prepared_combination::PreparedCombination;
use super::tile_work::{CastAll, TileWork};
use crate::number::Real;

/// Casts rays with lines, objects or a cut one by one, and the others side by side. Appends the results in the order of
/// the points.
pub(super) fn cast_apart<R: Real>(
    prepared: &Prepared<'_, R>,
    [alone, together]: [&dyn CastAll; 2],
    work: TileWork<'_>,
) {
    let is_alone: Vec<bool> = work.points.iter().map(|&point| is_alone(prepared, point)).collect();
    if !is_alone.contains(&true) {
        return together(work);
    }
    let TileWork { points, mut boxes, counts, casts } = work;
    let of = |alone: bool| {
        let points = points.iter().zip(&is_alone).filter(move |(_, is_alone)| **is_alone == alone);
        points.map(|(point, _)| *point).collect()
    };
    let [with, without]: [Vec<[f64; 2]>; 2] = [of(true), of(false)];
    let mut found = [Vec::with_capacity(with.len()), Vec::with_capacity(without.len())];
    let [casts_with, casts_without] = &mut found;
    alone(TileWork { points: &with, boxes: boxes.as_deref_mut(), counts, casts: casts_with });
    together(TileWork { points: &without, boxes, counts, casts: casts_without });
    let [mut with, mut without] = found.map(Vec::into_iter);
    let next = |is_alone: &bool| if *is_alone { with.next() } else { without.next() };
    casts.extend(is_alone.iter().filter_map(next));
}

/// Whether the ray through a point has lines on it, objects, or a cut.
fn is_alone<R: Real>(prepared: &Prepared<'_, R>, point: [f64; 2]) -> bool {
    let (view, object) = (&prepared.view, &prepared.object);
    let meets = |objects: &PreparedCombination<'_, R>| objects.meets(&prepared.view, &prepared.lattice, point);
    !prepared.lines_at(point).is_empty() || prepared.combination.as_ref().is_some_and(meets) || {
        let ray = || IndexRay::<R>::new(&view.ray(point[0], point[1]), view, &prepared.lattice, object.volume.grid());
        !object.clip.planes.is_empty() && ray().cut_sample(&object.clip.planes, object.ends).is_some()
    }
}
