//! 4D linear regression on the voxels, then trilinear interpolation ([REC-2], [STIP-1]).
//!
//! L. Neumann, B. Csébfalvi, A. König, E. Gröller, *Gradient Estimation in Volume Data using 4D Linear Regression*,
//! Computer Graphics Forum 19(3), 2000. The hyperplane a·x + b·y + c·z + d is fitted to the 3×3×3 voxels around a
//! voxel. Each has the weight 1/distance in world units, the middle one 2/(smallest spacing). (a, b, c) is the
//! gradient, d the smoothed value in the middle.
//!
//! The fit is the same in any linear coordinates. It is made in index space, where an axis of length 1 can be left out.
//! There h, the gradient along the index axes, is a linear combination of the voxels. Its weights depend only on which
//! of the 27 voxels lie in the grid.

use crate::field::place::CellPosition;
use crate::field::stencil::{Stencils, VoxelBlock};
use crate::number::{Real, Vec3};
use drypoint_scene::glam::DVec3;
use drypoint_scene::space::Grid;
use drypoint_scene::volume::Access;

/// Weights of the 3³ voxels around one, x fastest: for the derivative along each index axis, and for d.
type Weights<R> = [[R; 27]; 4];

/// Indices of the voxels with a nonzero weight, x fastest, and the weights, for each index axis.
pub(super) type Taps<R> = [Vec<(usize, R)>; 3];

/// The fits for all cases of missing neighbours that occur on a grid.
#[derive(Clone, Debug)]
pub(in crate::field) struct Regression<R> {
    /// The fits. The index is [`sides`] of x + 4 · `sides` of y + 16 · `sides` of z.
    cases: Vec<Option<Box<Weights<R>>>>,
    /// Weights of the gradient at a voxel that has all neighbours.
    taps: Taps<R>,
}

/// 1 if a voxel of a line of n has one before it, plus 2 if it has one after it.
fn sides(i: usize, n: usize) -> usize {
    usize::from(i > 0) + 2 * usize::from(i + 1 < n)
}

impl<R: Real> Regression<R> {
    /// Solves the normal equations of every case that occurs on a grid.
    pub(in crate::field) fn new(grid: &Grid) -> Self {
        let occurs = |axis: usize, s: usize| {
            let n = grid.dims()[axis];
            [0, n / 2, n - 1].into_iter().any(|i| sides(i, n) == s)
        };
        let tap = |(t, weight): (usize, f64)| (weight != 0.0).then(|| (t, R::from_f64(weight)));
        let taps = fit(grid, [3; 3]).map(|row| row.into_iter().enumerate().filter_map(tap).collect());
        let [x, y, z, _] = taps;
        let cases = (0..64)
            .map(|case| {
                let s = [case % 4, case / 4 % 4, case / 16];
                (0..3).all(|a| occurs(a, s[a])).then(|| Box::new(fit(grid, s).map(|row| row.map(R::from_f64))))
            })
            .collect();
        Self { cases, taps: [x, y, z] }
    }

    /// Bytes in memory.
    pub(in crate::field) fn bytes(&self) -> u64 {
        (self.cases.iter().flatten().count() * size_of::<Weights<R>>()) as u64
    }

    /// The weights at a voxel that has neighbours on all sides, without zeros.
    pub(super) fn taps_inside(&self) -> &Taps<R> {
        &self.taps
    }

    /// The weights of the three derivatives in all cases. Cases that the grid does not have get zeros.
    pub(in crate::field) fn weights(&self) -> Vec<f64> {
        let of_case = |case: &Option<Box<Weights<R>>>| {
            case.as_ref().map_or([R::ZERO; 81], |w| std::array::from_fn(|i| w[i / 27][i % 27]))
        };
        self.cases.iter().flat_map(of_case).map(R::to_f64).collect()
    }

    fn case(&self, s: [usize; 3]) -> Option<&Weights<R>> {
        self.cases[s[0] + 4 * s[1] + 16 * s[2]].as_deref()
    }

    /// The interpolated gradient at a place, along the index axes.
    pub(in crate::field) fn gradient(&self, stencils: &Stencils<'_>, at: CellPosition<R>) -> Vec3<R> {
        let dims = stencils.dims();
        let mut block = stencils.block::<R>(at.cell);
        // Differences of integers are exact, and differences of a constant are 0.
        let first = block[1][1][1];
        block.iter_mut().flatten().flatten().for_each(|c| *c -= first);
        let [x, y, z]: [[usize; 2]; 3] =
            std::array::from_fn(|a| [0, 1].map(|corner| sides(at.cell[a] + corner, dims[a])));
        let inside = [x, y, z] == [[3, 3]; 3];
        let [wx, wy, wz] = at.w;
        if inside {
            // All corners have the same weights, so the voxels are interpolated before the fit: one fit instead of
            // eight.
            return self.fitted([3; 3], &interpolated(&block, at.w));
        }
        let corner = |i: usize, j: usize, k: usize| {
            let around = std::array::from_fn(|t| block[k + t / 9][j + t / 3 % 3][i + t % 3]);
            self.fitted([x[i], y[j], z[k]], &around)
        };
        let mix = |a: Vec3<R>, b: Vec3<R>, w: R| a + (b - a) * w;
        let row = |j, k| mix(corner(0, j, k), corner(1, j, k), wx);
        let plane = |k| mix(row(0, k), row(1, k), wy);
        mix(plane(0), plane(1), wz)
    }

    /// The gradient at a voxel that has neighbours on all sides.
    pub(super) fn at_voxel(&self, voxels: impl Access, [x, y, z]: [usize; 3]) -> Vec3<R> {
        let a = voxels.window::<3>(x - 1, y - 1, z - 1);
        let number = |t: usize| R::from_voxel(a.at(t % 3, t / 3 % 3, t / 9));
        let first = number(13);
        let mut around = [R::ZERO; 27];
        for (t, c) in around.iter_mut().enumerate() {
            *c = number(t) - first;
        }
        self.fitted([3; 3], &around)
    }

    /// d at a voxel, as stencils read it.
    pub(in crate::field) fn value_at_voxel(&self, stencils: &Stencils<'_>, voxel: [usize; 3]) -> R {
        let dims = stencils.dims();
        let cell: [usize; 3] = std::array::from_fn(|a| voxel[a].min(dims[a].max(2) - 2));
        let [i, j, k]: [usize; 3] = std::array::from_fn(|a| voxel[a] - cell[a]);
        let block = stencils.block::<R>(cell);
        let first = block[k + 1][j + 1][i + 1];
        let Some([.., d]) = self.case(std::array::from_fn(|a| sides(voxel[a], dims[a]))) else { return first };
        // The weights' sum is 1, so a constant is reproduced exactly.
        let mut sum = R::ZERO;
        for (t, &weight) in d.iter().enumerate() {
            sum += (block[k + t / 9][j + t / 3 % 3][i + t % 3] - first) * weight;
        }
        first + sum
    }

    /// The fitted gradient at a voxel from its 3³ neighbourhood, x fastest.
    fn fitted(&self, s: [usize; 3], around: &[R; 27]) -> Vec3<R> {
        // On an axis of length 1 the cell's second corner lies outside and has no weight.
        let Some([x, y, z, _]) = self.case(s) else { return Vec3::zero() };
        let mut sum = Vec3::zero();
        for (t, &c) in around.iter().enumerate() {
            sum = sum + Vec3::new(c * x[t], c * y[t], c * z[t]);
        }
        sum
    }
}

/// The 3³ voxels around a place: those around the corners of its cell, interpolated.
fn interpolated<R: Real>(block: &VoxelBlock<R>, [wx, wy, wz]: [R; 3]) -> [R; 27] {
    let mut rows = [[[R::ZERO; 3]; 4]; 4];
    for (rows, plane) in rows.iter_mut().zip(block) {
        for (row, line) in rows.iter_mut().zip(plane) {
            for i in 0..3 {
                row[i] = R::lerp(line[i], line[i + 1], wx);
            }
        }
    }
    let mut planes = [[[R::ZERO; 3]; 3]; 4];
    for (plane, rows) in planes.iter_mut().zip(&rows) {
        for (j, row) in plane.iter_mut().enumerate() {
            for i in 0..3 {
                row[i] = R::lerp(rows[j][i], rows[j + 1][i], wy);
            }
        }
    }
    let mut around = [R::ZERO; 27];
    for (t, c) in around.iter_mut().enumerate() {
        let (i, j, k) = (t % 3, t / 3 % 3, t / 9);
        *c = R::lerp(planes[k][j][i], planes[k + 1][j][i], wz);
    }
    around
}

/// The weights of one case, from the normal equations Σ w φφᵀ · (h, d) = Σ w φ f, φ = (k, 1), over the neighbours k
/// that exist.
fn fit(grid: &Grid, sides: [usize; 3]) -> Weights<f64> {
    let exists = |axis: usize, k: i32| k == 0 || sides[axis] & (if k < 0 { 1 } else { 2 }) != 0;
    // (t, φ, w) of each neighbour that exists.
    let neighbours: Vec<(usize, [f64; 4], f64)> = (0..27)
        .map(|t| (t, [t as i32 % 3 - 1, t as i32 / 3 % 3 - 1, t as i32 / 9 - 1]))
        .filter(|(_, k)| (0..3).all(|a| exists(a, k[a])))
        .map(|(t, k)| {
            let k = k.map(f64::from);
            let distance = (grid.axes() * DVec3::from_array(k)).length();
            let weight = if t == 13 { 2.0 / grid.voxel() } else { 1.0 / distance };
            (t, [k[0], k[1], k[2], 1.0], weight)
        })
        .collect();
    // The normal matrix Σ w φφᵀ.
    let mut normal = [[0.0; 4]; 4];
    for (_, phi, weight) in &neighbours {
        for i in 0..4 {
            for j in 0..4 {
                normal[i][j] += weight * phi[i] * phi[j];
            }
        }
    }
    // An axis without neighbours has no derivative: its row says h = 0.
    for (axis, _) in sides.iter().enumerate().filter(|(_, s)| **s == 0) {
        normal[axis][axis] = 1.0;
    }
    // Weights of f: (Σ w φφᵀ)⁻¹ w φ, one column for each neighbour.
    let inverse = inverted(normal);
    let mut weights = [[0.0; 27]; 4];
    for (t, phi, weight) in neighbours {
        for (axis, row) in weights.iter_mut().enumerate() {
            row[t] = weight * (0..4).map(|j| inverse[axis][j] * phi[j]).sum::<f64>();
        }
    }
    weights
}

/// The inverse of a symmetric positive definite matrix, by Gauss–Jordan elimination, which needs no pivots there.
fn inverted(mut m: [[f64; 4]; 4]) -> [[f64; 4]; 4] {
    let mut inverse: [[f64; 4]; 4] = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    for i in 0..4 {
        let pivot = m[i][i];
        m[i] = m[i].map(|x| x / pivot);
        inverse[i] = inverse[i].map(|x| x / pivot);
        for r in (0..4).filter(|&r| r != i) {
            let factor = m[r][i];
            for c in 0..4 {
                m[r][c] -= factor * m[i][c];
                inverse[r][c] -= factor * inverse[i][c];
            }
        }
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The normal equations of a cubic grid are diagonal: h = Σ w k f / Σ w k², w = 1/√(k·k). Per axis Σ w k² over the
    /// 18 neighbours with k ≠ 0 is 2·(1 + 4/√2 + 4/√3).
    #[test]
    fn inside_a_cubic_grid_the_published_weights() {
        let grid = Grid::with_spacing([5; 3], [1.0; 3]).unwrap();
        let weights = fit(&grid, [3; 3]);
        let total = 2.0 * (1.0 + 4.0 / 2f64.sqrt() + 4.0 / 3f64.sqrt());
        for (t, w) in weights[0].iter().enumerate() {
            let k = [t as i32 % 3 - 1, t as i32 / 3 % 3 - 1, t as i32 / 9 - 1].map(f64::from);
            let distance = k.iter().map(|x| x * x).sum::<f64>().sqrt();
            let want = if k[0] == 0.0 { 0.0 } else { k[0] / distance / total };
            assert!((w - want).abs() < 1e-16, "{t}: {w} {want}");
        }
    }

    /// The border of a plane, x ≥ 0: the six voxels lie on two lines, and h_x joins their weighted means. The line k_x
    /// = 0 weighs 1, 2, 1, the other 1/√2, 1, 1/√2.
    #[test]
    fn at_a_border_the_voxels_that_exist() {
        let grid = Grid::with_spacing([3, 3, 1], [1.0; 3]).unwrap();
        let [x, y, z, _] = fit(&grid, [2, 3, 0]);
        let diagonal = 1.0 / 2f64.sqrt();
        let total = 1.0 + 2.0 * diagonal;
        let want =
            [(10, -0.25), (13, -0.5), (16, -0.25), (11, diagonal / total), (14, 1.0 / total), (17, diagonal / total)];
        for (t, w) in want {
            assert!((x[t] - w).abs() < 1e-15, "{t}: {} {w}", x[t]);
        }
        assert_eq!(x.iter().filter(|&&w| w != 0.0).count(), 6);
        // Along y the sum of w k² is 2 + 2/√2 over four voxels.
        assert!((y[16] - 1.0 / (2.0 + 2.0 * diagonal)).abs() < 1e-15 && z == [0.0; 27]);
    }

    /// Around a voxel inside, d is the weighted mean: 2 in the middle, 1, 1/√2 and 1/√3 for 6, 12 and 8 neighbours.
    #[test]
    fn inside_a_cubic_grid_d_is_the_weighted_mean() {
        let grid = Grid::with_spacing([5; 3], [1.0; 3]).unwrap();
        let [.., d] = fit(&grid, [3; 3]);
        let total = 2.0 + 6.0 + 12.0 / 2f64.sqrt() + 8.0 / 3f64.sqrt();
        let around = [(13, 2.0), (14, 1.0), (17, 1.0 / 2f64.sqrt()), (26, 1.0 / 3f64.sqrt())];
        for (t, w) in around {
            assert!((d[t] - w / total).abs() < 1e-16, "{t}: {}", d[t]);
        }
        // At a corner the fit of a linear field passes through the corner, so the weights' first moments are 0.
        let [.., d] = fit(&grid, [2; 3]);
        for axis in [1, 3, 9] {
            let moment: f64 = (0..27).map(|t| d[t] * (t as f64 / axis as f64 % 3.0).floor()).sum::<f64>();
            assert!((moment - 1.0).abs() < 1e-14, "{axis}: {moment}");
        }
        assert!((d.iter().sum::<f64>() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn a_line_of_voxels_is_fitted_along_itself_alone() {
        let grid = Grid::with_spacing([3, 1, 1], [2.0, 1.0, 1.0]).unwrap();
        let [x, y, z, _] = fit(&grid, [3, 0, 0]);
        assert_eq!([x[12], x[14]], [-0.5, 0.5]);
        assert!(y.iter().chain(&z).all(|&w| w == 0.0));
        let [x, ..] = fit(&grid, [2, 0, 0]);
        // Two voxels: the line through both.
        assert!((x[13] + 1.0).abs() < 1e-15 && (x[14] - 1.0).abs() < 1e-15);
    }
}
