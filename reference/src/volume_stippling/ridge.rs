//! Where ‖∇V‖ is largest along the normal: one layer of voxels a face, and points onto the edge ([STIP-4], `thin` and
//! `snap`).
//!
//! Between voxels ‖∇V‖ is the product of three parabolas through the 3×3×3 voxels around one, which is right for
//! quadratics. (Linear interpolation lies below a ridge between voxels, which would make oblique faces thicker.)

use drypoint_scene::glam::DVec3;
use drypoint_scene::math;
use drypoint_scene::space::Grid;

/// How far a voxel reaches along a normal, in world units: at least the smallest voxel, and as far as the largest step of the
/// grid leads along n. Voxels whose centres lie within half of it of a plane are a layer without holes, also where slices
/// are far apart.
pub(super) fn across(grid: &Grid, normal: DVec3) -> f64 {
    let axes = grid.axes();
    let steps = [axes.x_axis, axes.y_axis, axes.z_axis].map(|step| step.dot(normal).abs());
    let dims = grid.dims();
    (0..3).filter(|&a| dims[a] > 1).fold(grid.voxel(), |reach, a| reach.max(steps[a]))
}

/// The axis of the grid nearest to a normal, whose steps lead farthest along it; the first of equals. `steps` is Dᵀn.
///
/// Pieces of a face are those of columns along it, and points go to the edge along it: both of them have to take the same.
pub(super) fn nearest_axis(steps: DVec3) -> usize {
    let lengths = steps.abs();
    (1..3).fold(0, |nearest, a| if lengths[a] > lengths[nearest] { a } else { nearest })
}

/// From a voxel of a layer to the edge `top` steps along n, in index space: the way that its points go.
///
/// Along n itself they would leave gaps. The layer is [`across`] thick; a voxel that leaves it on one side is followed on the
/// other one by its neighbour along the axis nearest to n, and where the layer's thickness along the way is that one step,
/// the piece of the one begins where that of the other ends: rows of pieces close up. So the way is the mean of n and that
/// axis, both as far as one unit along n, which leads 1/thickness along the axis.
pub(super) fn way_to_edge(grid: &Grid, normal: DVec3, top: f64) -> DVec3 {
    let (reach, own) = (across(grid, normal), grid.inverse_axes() * normal);
    // Along an axis of one voxel there is no neighbour.
    let steps = grid.axes().transpose() * normal * DVec3::from_array(grid.dims().map(|n| f64::from(u8::from(n > 1))));
    let axis = nearest_axis(steps);
    if steps[axis] == 0.0 {
        return own * (top * reach);
    }
    let mut along = DVec3::ZERO;
    along[axis] = 1.0 / steps[axis];
    let (least, most) = (own[axis] * steps[axis].signum(), along[axis].abs());
    let share = if most > least { ((1.0 / reach - least) / (most - least)).clamp(0.0, 1.0) } else { 0.0 };
    own.lerp(along, share) * (top * reach)
}

/// Where ‖∇V‖ is compared with a voxel's own, in index space: as far along n as [`across`] says, to where the voxel's points
/// may go.
///
/// On a grid of cubes that is n. Where slices are far apart n leads several voxels along them before it has come one slice
/// on, and a thin layer is left alone by what those voxels have: it is followed along [`way_to_edge`].
pub(super) fn step(grid: &Grid, normal: DVec3, thin: bool) -> DVec3 {
    let (axes, dims) = (grid.axes(), grid.dims());
    let lengths = [axes.x_axis, axes.y_axis, axes.z_axis].map(DVec3::length);
    let longest = (0..3).filter(|&a| dims[a] > 1).fold(0.0, |longest, a| lengths[a].max(longest));
    if thin && longest > grid.voxel() {
        way_to_edge(grid, normal, 1.0)
    } else {
        grid.inverse_axes() * (normal * across(grid, normal))
    }
}

/// Norms that differ by so much of themselves or less are equal: they are sums of 27 products, and between two slices of a
/// segmentation the same numbers in another order.
const EQUAL: f64 = 1e-13;

/// Norms of the voxels of a grid, x fastest.
#[derive(Clone, Copy)]
pub(super) struct Norms<'a> {
    pub(super) dims: [usize; 3],
    pub(super) all: &'a [f64],
}

impl Norms<'_> {
    /// At a place `s` from a voxel, in index space, |s| ≤ 1 on each axis. Beyond the border the last voxels go on; a norm
    /// that is not valid counts as 0.
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

    fn own(&self, cell: [usize; 3]) -> f64 {
        self.all[(cell[2] * self.dims[1] + cell[1]) * self.dims[0] + cell[0]]
    }

    /// Whether a voxel's norm is the largest along ±n within one voxel, which is a [`step`]. Of equals the side of the lower
    /// linear index is kept, and rounding does not tell them apart: a face between two slices would have a layer in both.
    pub(super) fn is_largest(&self, cell: [usize; 3], step: DVec3) -> bool {
        // Which of the two comes first in linear order; a component that rounding left does not say.
        let first = [step.z, step.y, step.x].into_iter().find(|x| x.abs() > EQUAL).map_or(1.0, f64::signum);
        let own = self.own(cell);
        let equal = 1.0 + EQUAL;
        self.at(cell, -step * first) * equal < own && self.at(cell, step * first) <= own * equal
    }

    /// Where along n the norm is largest, in steps from the voxel's centre, at most one: the top of the Gaussian through the
    /// centre and one step to either side. The fit of [STIP-1] blurs every edge, and ‖∇V‖ across a blurred edge is nearly a
    /// Gaussian; the top of a parabola leans towards the voxel's centre or away from it, which moves whole rows of points
    /// where slices are far apart.
    ///
    /// Where the voxel is on a flank, and the top at a step or beyond, it is that of the parabola, or the higher end: the
    /// logarithm of the flank's foot may be anything.
    pub(super) fn top(&self, cell: [usize; 3], step: DVec3) -> f64 {
        let [before, own, after] =
            [self.at(cell, -step), self.own(cell), self.at(cell, step)].map(|x| x.max(f64::MIN_POSITIVE));
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
    use drypoint_scene::philox;

    /// A ridge of ‖∇V‖ along an oblique plane, a parabola across: the voxels that stay have their centres within half a
    /// voxel of it, as many as the plane has area. Of a Gaussian the top is where it is.
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
                // Between voxels it is a parabola: off by the third derivative, at most 12·20·10⁻¹², over 6, and by rounding,
                // each over a bend of 4·10⁻⁶.
                assert!((bells.top(cell, n) - (-t(cell)).clamp(-1.0, 1.0)).abs() < 1e-4, "{n} {cell:?}");
            }
        }
    }

    /// However narrow a Gaussian and wherever between two voxels, on a line of voxels its top is exact.
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

    /// Slices 4 apart: wherever between them a face across them lies, each column has one voxel, and of oblique faces no
    /// column is without.
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

    /// Two voxels beside a face midway between them, and one layer, whatever rounding makes of their norms and of the step.
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

    /// A voxel on a flank is led up, whatever lies at its foot, and nothing jumps where it becomes the top.
    #[test]
    fn a_flank_leads_to_its_top() {
        let top = |all: [f64; 3]| Norms { dims: [3, 1, 1], all: &all }.top([1, 0, 0], DVec3::X);
        for foot in [0.0, 1e-300, 1e-9, 1e-3] {
            assert_eq!([top([0.5, 0.05, foot]), top([foot, 0.05, 0.5])], [-1.0, 1.0], "{foot}");
            assert_eq!(top([foot, 0.3, 0.5]), 1.0, "{foot}");
        }
        assert!((top([0.1, 1.0, 1.0 - 1e-9]) - 0.5).abs() < 1e-8 && (top([0.1, 1.0, 1.0 + 1e-9]) - 0.5).abs() < 1e-8);
    }

    /// Of thin layers a step never leads farther than to the next voxels, from which alone ‖∇V‖ is known, and as far along n
    /// as a layer is thick.
    #[test]
    fn steps_stay_with_the_next_voxels() {
        for spacing in [[1.0; 3], [1.0, 1.0, 4.0], [2.0, 1.0, 1.3], [1.0, 5.0, 5.0]] {
            let grid = Grid::with_spacing([12; 3], spacing).unwrap();
            for i in 0..1000 {
                let n = DVec3::from_array([0, 1, 2].map(|k| philox::uniform(5, [i, k, 0], 0) - 0.5)).normalize();
                let step = step(&grid, n, true);
                assert!(step.abs().max_element() <= 1.0 + 1e-12, "{spacing:?} {n}: {step}");
                let along = (grid.axes() * step).dot(n);
                assert!((along - across(&grid, n)).abs() < 1e-12, "{spacing:?} {n}: {along}");
            }
        }
    }
}
