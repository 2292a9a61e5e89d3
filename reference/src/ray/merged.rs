//! Lines inside a translucent volume ([HATCH-14] d): rays with lines on them are cast alone, the others side by side.

use super::prepared::Prepared;
use super::tile_work::{CastAll, TileWork};
use crate::number::Real;

/// Casts rays with lines on them alone, and those without side by side; what comes out of each is appended in the order of the
/// points.
pub(super) fn cast_apart<R: Real>(
    prepared: &Prepared<'_, R>,
    [alone, together]: [&dyn CastAll; 2],
    work: TileWork<'_>,
) {
    let TileWork { points, mut boxes, counts, casts } = work;
    let (with, without): (Vec<_>, Vec<_>) = points.iter().partition(|&&point| !prepared.lines_at(point).is_empty());
    let mut found = [Vec::with_capacity(with.len()), Vec::with_capacity(without.len())];
    let [casts_with, casts_without] = &mut found;
    alone(TileWork { points: &with, boxes: boxes.as_deref_mut(), counts, casts: casts_with });
    together(TileWork { points: &without, boxes, counts, casts: casts_without });
    let [mut with, mut without] = found.map(Vec::into_iter);
    let next = |point: &[f64; 2]| if prepared.lines_at(*point).is_empty() { without.next() } else { with.next() };
    casts.extend(points.iter().filter_map(next));
}
