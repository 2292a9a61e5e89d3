//! The intersection of an iso-surface with the faces of the volume's box ([HATCH-18]).

use super::search::{CurvePoint, CurveSearch, position};
use super::tetrahedra::is_above;
use crate::field::{Field, Sampler};
use crate::number::Vec3;
use crate::surface::bracketed;
use drypoint_scene::glam::DVec3;
use drypoint_scene::parallel;

/// Returns the segments of f = iso in the faces of the box. Each cell face is split into the two triangles that its
/// tetrahedra have there. Ends are roots along the triangles' edges. An edge's key is its first voxel and the step to
/// the other one.
pub(super) fn rim(search: &CurveSearch<'_>, field: &Field<'_, f64>) -> Vec<[CurvePoint; 2]> {
    let dims = search.grid.dims();
    let side = |i: usize| {
        let (axis, far) = (i / 2, i % 2 == 1);
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        parallel::gather(dims[v] - 1, 1, &|rows, segments| {
            for (row, column) in rows.flat_map(|row| (0..dims[u] - 1).map(move |column| (row, column))) {
                let mut first = [0; 3];
                (first[u], first[v], first[axis]) = (column, row, if far { dims[axis] - 1 } else { 0 });
                let mut cell = first;
                cell[axis] = if far { dims[axis] - 2 } else { 0 };
                if search.mask.is_some_and(|mask| mask.touches_cell(cell)) {
                    continue;
                }
                for middle in [1 << u, 1 << v] {
                    segments.extend(in_triangle(search, field, first, [0, middle, 1 << u | 1 << v]));
                }
            }
        })
    };
    (0..6).flat_map(side).collect()
}

/// Adds the segment in a triangle. The triangle's corners are given as steps from a voxel.
fn in_triangle(
    search: &CurveSearch<'_>,
    field: &Field<'_, f64>,
    first: [usize; 3],
    corners: [usize; 3],
) -> Option<[CurvePoint; 2]> {
    let voxel = |steps: usize| -> [usize; 3] { std::array::from_fn(|a| first[a] + (steps >> a & 1)) };
    let over = |at: DVec3| search.level.over(field.value(Vec3::from_glam(at)));
    let values = corners.map(|steps| over(position(voxel(steps))));
    let on_edge = |[i, j]: [usize; 2]| {
        let [a, b] = [values[i], values[j]];
        (is_above(a) != is_above(b)).then(|| {
            let [from, to] = [i, j].map(|k| position(voxel(corners[k])));
            let t = if a == 0.0 {
                0.0
            } else if b == 0.0 {
                1.0
            } else {
                bracketed(|t| over(from.lerp(to, t)), [0.0, a], [1.0, b])
            };
            let key = (search.voxel(voxel(corners[i])) << 3) | (corners[j] - corners[i]) as u64;
            (key, from.lerp(to, t))
        })
    };
    let mut ends = [[0, 1], [0, 2], [1, 2]].into_iter().filter_map(on_edge);
    Some([ends.next()?, ends.next()?])
}
