//! Ridges of ‖∇V‖ along the normal: one layer of voxels per face, and points moved onto the edge ([STIP-4], `thin`
//! and `snap`).
//!
//! Between voxels, ‖∇V‖ is the product of three parabolas through the 3×3×3 voxels around a voxel. This is exact for
//! quadratics. (Linear interpolation lies below a ridge between voxels and would thicken oblique faces.)

use drypoint_scene::glam::DVec3;
use drypoint_scene::math;
use drypoint_scene::space::Grid;

/// Dᵀn, the length of each grid step along a normal, in world units; 0 along an axis of one voxel, which has no
/// neighbour.
fn steps(grid: &Grid, normal: DVec3) -> DVec3 {
    grid.axes().transpose() * normal * DVec3::from_array(grid.dims().map(|n| f64::from(u8::from(n > 1))))
}

/// Thickness of a one-voxel layer along the normal n, in world units: the largest grid step projected on n, but at
/// least the smallest voxel. Voxels whose centres lie within half this thickness of a plane form a layer without
/// holes, even if slices are far apart.
///
/// On a sheared grid the projected steps may be shorter than the smallest voxel. Then the thickness follows the step
/// Dᵀn in index space, scaled to one voxel along its longest component. It is longer than any single step.
pub(super) fn across(grid: &Grid, normal: DVec3) -> f64 {
    let steps = steps(grid, normal);
    let longest = steps.abs().max_element();
    if longest > 0.0 { grid.voxel().min(steps.length_squared() / longest).max(longest) } else { grid.voxel() }
}

/// The grid axis nearest to a normal: the axis with the longest step along the normal, the first of equals. `steps`
/// is Dᵀn.
///
/// Pieces of a face belong to columns along this axis, and points move to the edge along this axis. Both must use the
/// same axis.
pub(super) fn nearest_axis(steps: DVec3) -> usize {
    let lengths = steps.abs();
    (1..3).fold(0, |nearest, a| if lengths[a] > lengths[nearest] { a } else { nearest })
}

/// The step along n of length [`across`], in index space, shortened if it would lead beyond the next voxels.
fn straight(grid: &Grid, normal: DVec3) -> DVec3 {
    let step = grid.inverse_axes() * normal * across(grid, normal);
    step / step.abs().max_element().max(1.0)
}

/// Displacement of a thin layer's points, in index space: it advances along n by [`across`] and stays within the next
/// voxels.
///
/// A displacement along n itself would leave gaps. The layer is [`across`] thick. Where a voxel leaves the layer on
/// one side, its neighbour along the nearest axis enters on the other side. Rows of pieces close up if the thickness
/// along the displacement is exactly that one step. Then the piece of the second voxel begins where that of the first
/// ends.
///
/// So the displacement is one voxel along the nearest axis; the other axes add the rest of the thickness in
/// proportion to their steps along n. On a grid of cubes it is (n + axis)/(1 + n·axis).
fn way(grid: &Grid, normal: DVec3) -> DVec3 {
    let steps = steps(grid, normal);
    let a = nearest_axis(steps);
    if steps[a] == 0.0 {
        return straight(grid, normal);
    }
    let mut others = steps;
    others[a] = 0.0;
    // At most the factor of Dᵀn: near an axis, both the rest and the other steps are rounding.
    let left = (across(grid, normal) - steps[a].abs()) / others.length_squared();
    let mut way = others * left.min(1.0 / steps[a].abs());
    way[a] = steps[a].signum();
    way
}

/// Relative difference at which lengths and products of grid steps count as equal: headers have numbers in f32. A
/// component of a step counts as 0 up to this size in voxels.
const CUBIC: f64 = 1e-6;

/// Whether voxels are cubes, in any orientation.
fn has_cubes(grid: &Grid) -> bool {
    let products = (grid.axes().transpose() * grid.axes()).to_cols_array_2d();
    let (square, dims) = (grid.voxel() * grid.voxel(), grid.dims());
    let is = |product: f64, of: f64| (product - of).abs() <= CUBIC * square;
    (0..3).filter(|&a| dims[a] > 1).all(|a| (0..3).all(|b| is(products[a][b], if a == b { square } else { 0.0 })))
}

/// Displacement of a voxel's points, in index space: it advances along n by [`across`] and stays within the next
/// voxels. It is along n if all layers of a face have points. For thin layers, pieces of one layer close up.
pub(super) fn to_edge(grid: &Grid, normal: DVec3, thin: bool) -> DVec3 {
    if thin { way(grid, normal) } else { straight(grid, normal) }
}

/// Step to the places at which ‖∇V‖ is compared with a voxel's own, in index space. It is as long along n as the
/// displacement of the voxel's points.
///
/// On a grid of cubes the step is along n. If slices are far apart, n passes several voxels of a slice before it
/// reaches the next slice, and these would suppress a thin layer. So the step is then the points' displacement.
pub(super) fn step(grid: &Grid, normal: DVec3, thin: bool) -> DVec3 {
    to_edge(grid, normal, thin && !has_cubes(grid))
}

/// Relative difference at which norms count as equal. Norms are sums of 27 products, and between two slices of a
/// segmentation the same numbers are added in another order.
const EQUAL: f64 = 1e-13;

/// Lower bound of a norm at the foot of a Gaussian, as a share of the voxel's own norm.
const FOOT: f64 = 1.0 / 1024.0;

/// Norms of the voxels of a grid, x fastest.
#[derive(Clone, Copy)]
pub(super) struct Norms<'a> {
    pub(super) dims: [usize; 3],
    pub(super) all: &'a [f64],
}

impl Norms<'_> {
    /// The norm at the displacement `s` from a voxel, in index space, |s| ≤ 1 on each axis. The last voxels extend
    /// beyond the border. Invalid norms count as 0.
    pub(super) fn at(&self, cell: [usize; 3], s: DVec3) -> f64 {
        let weights = s.to_array().map(|s| [0.5 * s * (s - 1.0), 1.0 - s * s, 0.5 * s * (s + 1.0)]);
        let index = |a: usize, k: usize| (cell[a] + k).saturating_sub(1).min(self.dims[a] - 1);
        let mut sum = 0.0;
        for (k, wz) in weights[2].into_iter().enumerate().filter(|(_, w)| *w != 0.0) {
            for (j, wy) in weights[1].into_iter().enumerate().filter(|(_, w)| *w != 0.0) {
                let row = (index(2, k) * self.dims[1] + index(1, j)) * self.dims[0];
                for (i, wx) in weights[0].into_iter().enumerate().filter(|(_, w)| *w != 0.0) {
                    sum += wz * wy * wx * self.all[row + index(0, i)].max(0.0);
                }
            }
        }
        sum
    }

    /// Whether the displacement `s` from a voxel leads beyond the border. An axis of one voxel has no border.
    fn is_beyond(&self, cell: [usize; 3], s: DVec3) -> bool {
        let is_out = |a: usize| (cell[a] == 0 && s[a] < -CUBIC) || (cell[a] + 1 == self.dims[a] && s[a] > CUBIC);
        (0..3).any(|a| self.dims[a] > 1 && is_out(a))
    }

    fn own(&self, cell: [usize; 3]) -> f64 {
        self.all[(cell[2] * self.dims[1] + cell[1]) * self.dims[0] + cell[0]]
    }

    /// Whether a voxel's norm is the largest along ±n within one voxel, which is a [`step`]. Of equal norms, the side
    /// of the lower linear index is kept. Differences within rounding count as equal, since a face between two slices
    /// would otherwise have a layer in both. Beyond the border there is no voxel to keep instead.
    pub(super) fn is_largest(&self, cell: [usize; 3], step: DVec3) -> bool {
        // The first significant component tells which of the two comes first in linear order. Components within
        // rounding and axes of one voxel are skipped.
        let says = |&a: &usize| self.dims[a] > 1 && step[a].abs() > CUBIC;
        let first = [2, 1, 0].into_iter().find(says).map_or(1.0, |a| step[a].signum());
        let own = self.own(cell);
        let equal = 1.0 + EQUAL;
        let [before, after] = [-step * first, step * first];
        let is_first = self.at(cell, before) * equal < own || self.is_beyond(cell, before);
        is_first && self.at(cell, before).max(self.at(cell, after)) <= own * equal
    }

    /// Position of the largest norm along n, in steps from the voxel's centre, at most one. It is the top of the
    /// Gaussian through the norms at −1, 0 and 1 steps. The fit of [STIP-1] blurs every edge, and ‖∇V‖ across a
    /// blurred edge is nearly a Gaussian. The top of a parabola is biased, which moves whole rows of points if slices
    /// are far apart.
    ///
    /// On a flank the top is at a step or beyond. Then the top of the parabola or the higher end is used, because the
    /// logarithm of the flank's foot is unbounded. For the same reason a foot below a thousandth of the voxel's own
    /// norm counts as this share.
    pub(super) fn top(&self, cell: [usize; 3], step: DVec3) -> f64 {
        let own = self.own(cell);
        let [before, after] = [-step, step].map(|step| self.at(cell, step).max(own * FOOT));
        let [falls, rises] = if own >= before.max(after) {
            [before, after].map(|x| math::ln(x / own))
        } else {
            [before - own, after - own]
        };
        let bend = falls + rises;
        if bend < 0.0 {
            ((falls - rises) / (2.0 * bend)).clamp(-1.0, 1.0)
        } else if before == after {
            0.0
        } else {
            (after - before).signum()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::{self, DMat3};
    use drypoint_scene::philox;

    /// A ridge of ‖∇V‖ along an oblique plane, a parabola across it. The remaining voxels have their centres within
    /// half a voxel of the plane, and their number equals the plane's area. The top of a Gaussian is found exactly.
    #[test]
    fn a_wide_ridge_keeps_one_layer_and_shows_its_top() {
        let dims = [24, 24, 24];
        for n in [DVec3::Z, DVec3::new(1.0, 2.0, 3.0).normalize(), DVec3::new(4.0, 2.0, 1.0).normalize()] {
            let t = |cell: [usize; 3]| (DVec3::from_array(cell.map(|i| i as f64)) - 11.6).dot(n);
            let cells: Vec<[usize; 3]> = (0..24 * 24 * 24).map(|i| [i % 24, i / 24 % 24, i / 576]).collect();
            let all: Vec<f64> = cells.iter().map(|&cell| 1000.0 - t(cell) * t(cell)).collect();
            let norms = Norms { dims, all: &all };
            let bells: Vec<f64> = cells.iter().map(|&cell| math::exp(-1e-6 * t(cell) * t(cell))).collect();
            let bells = Norms { dims, all: &bells };
            for &cell in cells.iter().filter(|cell| cell.iter().all(|i| (1..23).contains(i))) {
                // Rounding of the sum decides within 10⁻¹⁰ of a half.
                if (t(cell).abs() - 0.5).abs() > 1e-10 {
                    assert_eq!(norms.is_largest(cell, n), t(cell).abs() < 0.5, "{n} {cell:?}: {}", t(cell));
                }
                // Between voxels ‖∇V‖ is a parabola. It errs by the third derivative, at most 12·20·10⁻¹², over 6,
                // and by rounding, each divided by a bend of 4·10⁻⁶.
                assert!((bells.top(cell, n) - (-t(cell)).clamp(-1.0, 1.0)).abs() < 1e-4, "{n} {cell:?}");
            }
        }
    }

    /// The top of a Gaussian on a line of voxels is exact, however narrow it is and wherever it lies.
    #[test]
    fn the_top_of_a_gaussian_is_where_it_is() {
        for width in [0.4, 0.8, 2.0] {
            for offset in [-0.5, -0.3, 0.0, 0.1, 0.5] {
                let all: Vec<f64> =
                    (-1..2).map(|i| f64::from(i) - offset).map(|t| math::exp(-0.5 * (t / width).powi(2))).collect();
                let top = Norms { dims: [3, 1, 1], all: &all }.top([1, 0, 0], DVec3::X);
                assert!((top - offset).abs() < 1e-13, "{width} {offset}: {top}");
            }
        }
    }

    /// Slices 4 apart: a face across the columns has one voxel in each, wherever it lies between slices. Oblique
    /// faces leave no column empty.
    #[test]
    fn far_slices_leave_no_holes() {
        let grid = Grid::with_spacing([12, 12, 12], [1.0, 1.0, 4.0]).unwrap();
        for n in [DVec3::Z, DVec3::X, DVec3::new(1.0, 0.0, 1.0).normalize(), DVec3::new(1.0, 2.0, 3.0).normalize()] {
            let largest = (n * DVec3::new(1.0, 1.0, 4.0)).abs().max_element();
            assert_eq!(across(&grid, n), largest.max(1.0));
            for offset in [0.0, 0.3, 1.1, 1.9, 2.3, 3.7] {
                let t = |cell: [usize; 3]| {
                    let world = DVec3::new(cell[0] as f64, cell[1] as f64, 4.0 * cell[2] as f64);
                    (world - DVec3::new(5.5, 5.5, 20.0 + offset)).dot(n)
                };
                let all: Vec<f64> =
                    (0..1728).map(|i| [i % 12, i / 12 % 12, i / 144]).map(|c| 1e4 - t(c) * t(c)).collect();
                let norms = Norms { dims: [12; 3], all: &all };
                let step = step(&grid, n, true);
                // Along the axis in which a step leads farthest along n.
                let lead = if n.z > 0.0 { 2 } else { 0 };
                for i in 4..8 {
                    for j in 4..8 {
                        let cell = |k: usize| if lead == 2 { [i, j, k] } else { [k, i, j] };
                        let kept = (1..11).filter(|&k| norms.is_largest(cell(k), step)).count();
                        let within = (1..11).any(|k| t(cell(k)).abs() < 0.49 * largest);
                        assert!(kept <= 1 && (kept == 1 || !within), "{n} {offset} {i} {j}: {kept}");
                    }
                }
            }
        }
    }

    #[test]
    fn of_equals_the_lower_index_stays() {
        let all = [0.0, 1.0, 1.0, 0.0];
        let norms = Norms { dims: [4, 1, 1], all: &all };
        for step in [DVec3::X, DVec3::NEG_X] {
            assert_eq!([0, 1, 2, 3].map(|x| norms.is_largest([x, 0, 0], step)), [false, true, false, false]);
        }
        assert_eq!(norms.top([1, 0, 0], DVec3::X), 0.5);
        assert_eq!(norms.top([1, 0, 0], DVec3::Y), 0.0);
        assert_eq!(norms.top([0, 0, 0], DVec3::X), 1.0);
    }

    /// A face midway between two voxels has one layer, whatever rounding does to their norms and to the step.
    #[test]
    fn rounding_does_not_tell_equals_apart() {
        let noise = [0.0, 1e-16, -3e-16];
        for (a, b) in noise.into_iter().flat_map(|a| noise.map(|b| (a, b))) {
            let rows = [0.0, 0.125 + a, 0.125 + b, 0.0];
            for axis in 0..3 {
                let all: Vec<f64> = (0..64).map(|i| rows[[i % 4, i / 4 % 4, i / 16][axis]]).collect();
                let norms = Norms { dims: [4; 3], all: &all };
                let kept = (0..4).filter(|&i| {
                    let mut cell = [1; 3];
                    cell[axis] = i;
                    // Each voxel's normal has been rounded for itself.
                    let off = DVec3::splat([a, b, -a, -b][i]);
                    norms.is_largest(cell, DVec3::AXES[axis] + off)
                });
                assert_eq!(kept.collect::<Vec<_>>(), [1], "{a} {b}, axis {axis}");
            }
        }
    }

    /// Tiny components of a direction, left by a header's f32 numbers, do not matter: a step between two equals has one
    /// layer, even in a single slice.
    #[test]
    fn components_of_a_turned_header_are_no_directions() {
        let row = [0.0, 0.0, 0.0, 0.5, 0.5, 0.0, 0.0, 0.0];
        for dims in [[8, 8, 1], [8, 8, 3]] {
            let all: Vec<f64> = (0..dims.iter().product()).map(|i: usize| row[i % 8]).collect();
            let norms = Norms { dims, all: &all };
            for off in [DVec3::new(0.0, 1.3e-9, -4.8e-9), DVec3::new(0.0, -1e-8, 1e-8), DVec3::new(0.0, 3e-7, 0.0)] {
                for y in 0..8 {
                    for z in 0..dims[2] {
                        let is = |x, step| norms.own([x, y, z]) > 0.0 && norms.is_largest([x, y, z], step);
                        let kept = |sign: f64| (0..8).filter(|&x| is(x, (DVec3::X + off) * sign)).collect();
                        let [to, fro]: [Vec<usize>; 2] = [1.0, -1.0].map(kept);
                        assert_eq!([to, fro], [[3], [3]], "{dims:?} {off:?} {y} {z}");
                    }
                }
            }
        }
    }

    /// A voxel on a flank is moved uphill, whatever lies at the flank's foot, and nothing jumps where the voxel
    /// becomes the top.
    #[test]
    fn a_flank_leads_to_its_top() {
        let top = |all: [f64; 3]| Norms { dims: [3, 1, 1], all: &all }.top([1, 0, 0], DVec3::X);
        for foot in [0.0, 1e-300, 1e-9, 1e-3] {
            assert_eq!([top([0.5, 0.05, foot]), top([foot, 0.05, 0.5])], [-1.0, 1.0], "{foot}");
            assert_eq!(top([foot, 0.3, 0.5]), 1.0, "{foot}");
        }
        assert!((top([0.1, 1.0, 1.0 - 1e-9]) - 0.5).abs() < 1e-8 && (top([0.1, 1.0, 1.0 + 1e-9]) - 0.5).abs() < 1e-8);
    }

    /// Ever smaller feet cause no jump: the logarithm of 0 has no influence.
    #[test]
    fn a_foot_that_fades_moves_nothing_far() {
        let top =
            |before: f64, after: f64| Norms { dims: [3, 1, 1], all: &[before, 1.0, after] }.top([1, 0, 0], DVec3::X);
        for after in [0.0, 1e-9, 0.1, 0.5, 0.9] {
            let mut last = top(0.0, after);
            for k in 1..=1000 {
                let next = top(f64::from(k) / 1000.0, after);
                // The first is at the least foot that counts, where ln is steepest: a tenth of the whole change.
                assert!(next <= last + 1e-12 && last - next < 0.1, "{after} {k}: {last} {next}");
                last = next;
            }
        }
        assert_eq!([top(0.0, 0.0), top(1.0, 1.0), top(0.0, 1.0)], [0.0, 0.0, 0.5]);
    }

    /// A face at any border has a layer: the continuation beyond the border is not a voxel.
    #[test]
    fn faces_at_the_border_have_one_layer() {
        for row in [[1.0, 1.0, 0.0, 0.0], [2.0, 1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 1.0, 0.0]] {
            for (axis, mirrored, sign) in (0..12).map(|i| (i % 3, i / 3 % 2 == 1, [1.0, -1.0][i / 6])) {
                let at = |i: usize| row[if mirrored { 3 - i } else { i }];
                let all: Vec<f64> = (0..64).map(|i| at([i % 4, i / 4 % 4, i / 16][axis])).collect();
                let norms = Norms { dims: [4; 3], all: &all };
                for rest in 0..16 {
                    let kept = (0..4).filter(|&i| {
                        let mut cell = [rest % 4, rest / 4, 0];
                        cell.copy_within(axis..2, axis + 1);
                        cell[axis] = i;
                        norms.own(cell) > 0.0 && norms.is_largest(cell, DVec3::AXES[axis] * sign)
                    });
                    assert_eq!(kept.count(), 1, "{row:?} along {axis}, {mirrored} {sign}");
                }
            }
        }
    }

    /// Grids with and without right angles: cubes in any orientation, distant slices, a tilted gantry, and rhombs.
    fn grids() -> Vec<Grid> {
        let turn = DMat3::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7);
        let tilted = |degrees: f64, [x, y, z]: [f64; 3]| {
            DMat3::from_cols(DVec3::X * x, DVec3::Y * y, DVec3::new(0.0, degrees.to_radians().tan(), 1.0) * z)
        };
        let straight = [[1.0; 3], [1.0, 1.0, 4.0], [2.0, 1.0, 1.3], [1.0, 5.0, 5.0]].map(|s| tilted(0.0, s));
        let oblique = [
            turn,
            tilted(20.0, [0.5, 0.5, 2.0]),
            tilted(30.0, [1.0; 3]),
            DMat3::from_cols(DVec3::X, DVec3::new(0.5, 0.75f64.sqrt(), 0.0), DVec3::Z),
            turn * DMat3::from_cols(DVec3::X, DVec3::new(0.4, 1.0, 0.4), DVec3::new(0.4, 0.0, 1.0)),
        ];
        straight.into_iter().chain(oblique).map(|axes| Grid::new([12; 3], axes, DVec3::ZERO).unwrap()).collect()
    }

    fn normals() -> impl Iterator<Item = DVec3> {
        let random = |i| DVec3::from_array([0, 1, 2].map(|k| philox::uniform(5, [i, k, 0], 0) - 0.5)).normalize();
        (0..1000).map(random).chain(DVec3::AXES)
    }

    /// ‖∇V‖ is known only up to the next voxels, and no step leads beyond them. A step of a thin layer is as long
    /// along n as the layer is thick. Along the nearest axis it is long enough for pieces to close up. Other steps
    /// are along n.
    #[test]
    fn steps_stay_with_the_next_voxels() {
        for grid in grids() {
            for n in normals() {
                let reach = across(&grid, n);
                for way in [to_edge(&grid, n, true), step(&grid, n, true)] {
                    assert!(way.abs().max_element() <= 1.0 + 1e-12, "{grid:?} {n}: {way}");
                    assert!(((grid.axes() * way).dot(n) - reach).abs() < 1e-12, "{grid:?} {n}: {way}");
                }
                let steps = grid.axes().transpose() * n;
                let axis = nearest_axis(steps);
                assert!(
                    reach >= steps[axis].abs() && to_edge(&grid, n, true)[axis] == steps[axis].signum(),
                    "{grid:?} {n}"
                );
                let along = step(&grid, n, false);
                assert!(along == to_edge(&grid, n, false) && along.abs().max_element() <= 1.0 + 1e-12, "{grid:?} {n}");
                let world = grid.axes() * along;
                assert!((world.normalize() - n).length() < 1e-12 && world.dot(n) <= reach + 1e-12, "{grid:?} {n}");
            }
        }
    }

    /// Near the normals of the grid's planes a displacement turns as the normal does. Components of 0 or within
    /// rounding have no influence.
    #[test]
    fn the_way_does_not_jump_near_an_axis() {
        for grid in grids() {
            let planes = grid.inverse_axes().transpose();
            for (a, noise) in (0..3).flat_map(|a| [0.0, 1e-17, 1e-16, 3e-16, 1e-12, 1e-9, 1e-6].map(|noise| (a, noise)))
            {
                for (i, other) in normals().step_by(20).enumerate() {
                    let mask = [DVec3::ONE, DVec3::new(1.0, 1.0, 0.0), DVec3::X][i % 3];
                    let n = (planes.col(a).normalize() + other * mask * noise).normalize();
                    let way = to_edge(&grid, n, true);
                    let straight = DVec3::AXES[a] * way[a].signum();
                    assert!((way - straight).length() <= 20.0 * noise + 1e-14, "{grid:?} {n} {noise}: {way}");
                }
            }
        }
    }

    /// Cubes are compared along n itself, even if they are rotated and their header has seven digits.
    #[test]
    fn turned_cubes_are_cubes() {
        for (i, grid) in grids().into_iter().enumerate() {
            let axes = DMat3::from_cols_array(&grid.axes().to_cols_array().map(|x| f64::from(x as f32)));
            let rounded = Grid::new([12; 3], axes, DVec3::ZERO).unwrap();
            assert_eq!([has_cubes(&grid), has_cubes(&rounded)], [[0, 4].contains(&i); 2], "{grid:?}");
        }
    }

    /// Layers have no holes on any grid: a column along the nearest axis keeps a voxel wherever the face lies.
    #[test]
    fn no_grid_has_holes() {
        for grid in grids() {
            for n in normals().step_by(40) {
                let steps = grid.axes().transpose() * n;
                let (lead, reach) = (nearest_axis(steps), across(&grid, n));
                for offset in [0.0, 0.3, 0.5, 0.8] {
                    let centre = grid.to_world(DVec3::splat(5.5)) + n * (offset * reach);
                    let t =
                        |cell: [usize; 3]| (grid.to_world(DVec3::from_array(cell.map(|i| i as f64))) - centre).dot(n);
                    let all: Vec<f64> =
                        (0..1728).map(|i| [i % 12, i / 12 % 12, i / 144]).map(|c| 1e4 - t(c) * t(c)).collect();
                    let norms = Norms { dims: [12; 3], all: &all };
                    let step = step(&grid, n, true);
                    for column in 0..16 {
                        let cell = |k: usize| {
                            let mut cell = [4 + column % 4, 4 + column / 4, 0];
                            cell.copy_within(lead..2, lead + 1);
                            cell[lead] = k;
                            cell
                        };
                        let inside: Vec<usize> =
                            (1..11).filter(|&k| t(cell(k)).abs() < 0.499 * steps[lead].abs()).collect();
                        let kept = |k: usize| norms.is_largest(cell(k), step);
                        assert!(inside.iter().all(|&k| kept(k)), "{grid:?} {n} {offset}");
                        assert!((1..11).filter(|&k| kept(k)).all(|k| t(cell(k)).abs() < 0.501 * reach), "{grid:?} {n}");
                    }
                }
            }
        }
    }
}
