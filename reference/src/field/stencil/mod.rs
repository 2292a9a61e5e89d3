//! The voxels around a cell as numbers of the sample loop.
//!
//! A stencil decides the stored type once and reads all its voxels into an array. So the code of a sample exists once
//! for each number type and kernel, and not also for each of the ten stored types.

mod border;

pub(super) use border::beyond;

use super::tensor::{Rows, RowsFn, Sum};
use crate::number::lanes::wide;
use crate::number::{Real, RowOfFour};
use drypoint_scene::math;
use drypoint_scene::volume::{Access, Volume, Voxel, VoxelType};
use drypoint_scene::with_access;
use fearless_simd::Simd;
use std::marker::PhantomData;

/// Reads stencils from a volume, in stored units times [`Stencils::scale`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Stencils<'v> {
    volume: &'v Volume,
    /// Number of cells on each axis whose four voxels, from the one before the cell on, all lie in the grid. 0 if every
    /// stencil has to be read with care.
    inner: [usize; 3],
    /// Whether an axis has length 1 or numbers are scaled as they are read.
    careful: bool,
    /// Stored numbers are read times this power of two. It is 1 unless they come near the ends of the number type.
    scale: f64,
}

/// The 32 voxels of central differences at the eight corners of a cell.
pub(super) struct Cross<R> {
    /// Four voxels from the one before the cell on, in the rows (y, z) = (0, 0), (1, 0), (0, 1), (1, 1) from the cell.
    pub x: [[R; 4]; 4],
    /// The two voxels of the cell in the rows at y = −1, 2, then the same at z = 1.
    pub y: [[R; 2]; 4],
    /// The two voxels of the cell in the rows at z = −1: y = 0, 1, then at z = 2.
    pub z: [[R; 2]; 4],
}

/// Voxels of a row that are read at once.
const RUN: usize = 8;

/// The corners of a cell: pairs along x at (y, z) = (0, 0), (1, 0), (0, 1), (1, 1).
pub(super) type Corners<R> = [[R; 2]; 4];

/// The corners of a cell of a grid without axes of length 1.
#[inline(always)]
pub(super) fn corners<R: Real>(access: impl Access, [x, y, z]: [usize; 3]) -> Corners<R> {
    let a = access.window::<2>(x, y, z);
    [row(a, 0, 0, 0), row(a, 0, 1, 0), row(a, 0, 0, 1), row(a, 0, 1, 1)]
}

/// The voxels of central differences of a cell whose stencil lies in the grid.
#[inline(always)]
pub(super) fn cross<R: Real>(access: impl Access, [x, y, z]: [usize; 3]) -> Cross<R> {
    let a = access.window::<4>(x - 1, y - 1, z - 1);
    Cross {
        x: [row(a, 0, 1, 1), row(a, 0, 2, 1), row(a, 0, 1, 2), row(a, 0, 2, 2)],
        y: [row(a, 1, 0, 1), row(a, 1, 3, 1), row(a, 1, 0, 2), row(a, 1, 3, 2)],
        z: [row(a, 1, 1, 0), row(a, 1, 2, 0), row(a, 1, 1, 3), row(a, 1, 2, 3)],
    }
}

#[inline(always)]
fn row<R: Real, const N: usize>(access: impl Access, x: usize, y: usize, z: usize) -> [R; N] {
    let voxels = access.row::<N>(x, y, z);
    let mut row = [R::ZERO; N];
    for i in 0..N {
        row[i] = R::from_voxel(voxels[i]);
    }
    row
}

/// The 4³ voxels around a cell, [z][y][x].
pub(super) type VoxelBlock<R> = [[[R; 4]; 4]; 4];

/// The rows of a window of the volume.
struct VoxelRows<S, A, R> {
    simd: S,
    window: A,
    number: PhantomData<R>,
}

impl<S: Simd, A: Access, R: Real> Rows<R::Four<S>> for VoxelRows<S, A, R> {
    #[inline(always)]
    fn row(&self, j: usize, k: usize) -> R::Four<S> {
        R::Four::load(self.simd, R::from_voxels(self.window.row::<4>(0, j, k)))
    }

    #[inline(always)]
    fn zero(&self) -> R::Four<S> {
        R::Four::load(self.simd, [R::ZERO; 4])
    }
}

impl<'v> Stencils<'v> {
    /// Prepares a volume for reading as numbers of the type `R`.
    pub(super) fn new<R: Real>(volume: &'v Volume) -> Self {
        let dims = volume.dims();
        let scale = math::scale_by_power_of_two(1.0, -exponent::<R>(volume));
        let careful = scale != 1.0 || dims.contains(&1);
        Self { volume, inner: if careful { [0; 3] } else { dims.map(|n| n.max(3) - 3) }, careful, scale }
    }

    /// The power of two by which stored numbers are multiplied as they are read.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// The volume that is read.
    pub(super) fn volume(&self) -> &'v Volume {
        self.volume
    }

    /// Voxels along x, y, z.
    pub(super) fn dims(&self) -> [usize; 3] {
        self.volume.dims()
    }

    /// The lowest voxel, as stencils read it.
    pub(super) fn lowest<R: Real>(&self) -> R {
        R::from_f64(self.volume.voxels().range()[0] * self.scale)
    }

    /// The whole row of voxels at y and z.
    pub(super) fn read_row<R: Real>(&self, y: usize, z: usize, out: &mut [R]) {
        self.read_run([0, y, z], out);
    }

    /// A run of voxels of a row, from `start` on, as long as `out`.
    pub(super) fn read_run<R: Real>(&self, [start, y, z]: [usize; 3], out: &mut [R]) {
        let scale = self.scale;
        with_access!(self.volume, |a| {
            // Reads runs of a row at once: the address of a single voxel takes longer than the voxel.
            let (chunks, rest) = out.as_chunks_mut::<RUN>();
            let read = chunks.len() * RUN;
            for (i, chunk) in chunks.iter_mut().enumerate() {
                let voxels = a.row::<RUN>(start + i * RUN, y, z);
                for k in 0..RUN {
                    chunk[k] = number(voxels[k], scale);
                }
            }
            for (x, out) in rest.iter_mut().enumerate() {
                *out = number(a.at(start + read + x, y, z), scale);
            }
        });
    }

    /// The last cell on each axis around which four voxels are in the grid. The first such cell is 1.
    pub(super) fn inner(&self) -> [usize; 3] {
        self.inner
    }

    /// Whether the four voxels on each axis around a cell are in the grid.
    #[inline(always)]
    fn inside(&self, cell: [usize; 3]) -> bool {
        let inside = |a: usize| cell[a].wrapping_sub(1) < self.inner[a];
        inside(0) && inside(1) && inside(2)
    }

    /// Whether a voxel's 26 neighbours are in the grid and can be read directly.
    #[inline(always)]
    pub(super) fn surrounds(&self, voxel: [usize; 3]) -> bool {
        let dims = self.dims();
        !self.careful && (0..3).all(|a| voxel[a].wrapping_sub(1) < dims[a].saturating_sub(2))
    }

    /// Whether the two voxels to each side of a voxel are in the grid and can be read directly.
    #[inline(always)]
    pub(super) fn surrounds_twice(&self, voxel: [usize; 3]) -> bool {
        let dims = self.dims();
        !self.careful && (0..3).all(|a| voxel[a] >= 2 && voxel[a] + 2 < dims[a])
    }

    /// Whether no stencil can be read directly, because an axis has length 1 or numbers are scaled.
    #[inline(always)]
    pub(super) fn careful(&self) -> bool {
        self.careful
    }

    /// The corners of a cell if they cannot be read directly: an axis has length 1, or numbers are scaled.
    #[inline(always)]
    pub(super) fn careful_corners<R: Real>(&self, cell: [usize; 3]) -> Option<Corners<R>> {
        if self.careful { Some(self.read_corners(cell[0], cell[1], cell[2])) } else { None }
    }

    /// The voxels of central differences if some lie beyond the border or cannot be read directly.
    #[inline(always)]
    pub(super) fn careful_cross<R: Real>(&self, cell: [usize; 3]) -> Option<Cross<R>> {
        if self.inside(cell) { None } else { Some(self.read_cross(cell)) }
    }

    /// The voxels from the one before the cell on, continued beyond the border.
    #[inline(never)]
    pub(super) fn block<R: Real>(&self, cell: [usize; 3]) -> VoxelBlock<R> {
        if !self.inside(cell) {
            return self.read_block(cell);
        }
        let mut block = [[[R::ZERO; 4]; 4]; 4];
        with_access!(self.volume, |a| {
            let a = a.window::<4>(cell[0] - 1, cell[1] - 1, cell[2] - 1);
            for (k, plane) in block.iter_mut().enumerate() {
                for (j, line) in plane.iter_mut().enumerate() {
                    *line = row(a, 0, j, k);
                }
            }
        });
        block
    }

    /// A sum over the voxels from the one before the cell on, continued beyond the border.
    #[inline(always)]
    pub(super) fn sum<R: Real, T: Sum<R>>(&self, cell: [usize; 3], sum: &T) -> T::Of {
        match wide() {
            Some(simd) if self.inside(cell) => simd.vectorize(
                #[inline(always)]
                || self.sum_inside(simd, cell, sum),
            ),
            _ => {
                let block = self.block::<R>(cell);
                sum.over(&RowsFn(|j: usize, k: usize| block[k][j]))
            }
        }
    }

    #[inline(always)]
    fn sum_inside<S: Simd, R: Real, T: Sum<R>>(&self, simd: S, [x, y, z]: [usize; 3], sum: &T) -> T::Of {
        with_access!(self.volume, |a| {
            let window = a.window::<4>(x - 1, y - 1, z - 1);
            sum.over(&VoxelRows { simd, window, number: PhantomData::<R> })
        })
    }

    /// The 6³ voxels from the second one before the cell on, [z][y][x]; beyond the border the nearest voxel.
    #[inline(never)]
    pub(super) fn large_block<R: Real>(&self, cell: [usize; 3]) -> [[[R; 6]; 6]; 6] {
        let dims = self.dims();
        if self.careful || (0..3).any(|a| cell[a] < 2 || cell[a] + 4 > dims[a]) {
            return self.clamped(cell.map(|i| i as isize - 2));
        }
        let mut block = [[[R::ZERO; 6]; 6]; 6];
        with_access!(self.volume, |a| {
            let a = a.window::<6>(cell[0] - 2, cell[1] - 2, cell[2] - 2);
            for (k, plane) in block.iter_mut().enumerate() {
                for (j, line) in plane.iter_mut().enumerate() {
                    *line = row(a, 0, j, k);
                }
            }
        });
        block
    }

    /// `N`³ voxels from `start` on, [z][y][x]; an index beyond the grid reads the nearest voxel of its line.
    #[inline(never)]
    pub(super) fn clamped<R: Real, const N: usize>(&self, start: [isize; 3]) -> [[[R; N]; N]; N] {
        let dims = self.dims();
        let index = |axis: usize, i: usize| (start[axis] + i as isize).clamp(0, dims[axis] as isize - 1) as usize;
        let scale = self.scale;
        let mut block = [[[R::ZERO; N]; N]; N];
        with_access!(self.volume, |a| {
            for (k, plane) in block.iter_mut().enumerate() {
                for (j, line) in plane.iter_mut().enumerate() {
                    for (i, number_at) in line.iter_mut().enumerate() {
                        *number_at = number(a.at(index(0, i), index(1, j), index(2, k)), scale);
                    }
                }
            }
        });
        block
    }

    /// Calls `take` with the index and the number of `side` numbers along each axis, from `before` voxels before the
    /// cell `first` on. Numbers beyond the border are continued. Beyond the reach of the last cell the nearest number
    /// is repeated.
    pub(super) fn around<R: Real>(
        &self,
        first: [usize; 3],
        before: usize,
        side: usize,
        take: &mut dyn FnMut([usize; 3], f64),
    ) {
        let dims = self.dims();
        let start = first.map(|i| i as isize - before as isize);
        // A number beyond the border is taken from the block of the nearest cell.
        let cell = |a: usize, i: isize| i.clamp(0, dims[a].max(2) as isize - 2) as usize;
        let beyond = |a: usize, i: isize| i < 0 || i >= dims[a] as isize;
        let scale = self.scale;
        with_access!(self.volume, |voxels| {
            for i in 0..side * side * side {
                let at @ [x, y, z] = [i % side, i / side % side, i / side / side];
                let place = [start[0] + x as isize, start[1] + y as isize, start[2] + z as isize];
                let taken = if beyond(0, place[0]) || beyond(1, place[1]) || beyond(2, place[2]) {
                    let cell = [cell(0, place[0]), cell(1, place[1]), cell(2, place[2])];
                    let tap = |a: usize| (place[a] - cell[a] as isize + 1).clamp(0, 3) as usize;
                    self.block::<R>(cell)[tap(2)][tap(1)][tap(0)]
                } else {
                    number::<R, _>(voxels.at(place[0] as usize, place[1] as usize, place[2] as usize), scale)
                };
                take(at, taken.to_f64());
            }
        });
    }
}

#[inline(always)]
fn number<R: Real, V: Voxel>(voxel: V, scale: f64) -> R {
    if scale == 1.0 { R::from_voxel(voxel) } else { R::from_f64(voxel.to_f64() * scale) }
}

/// The exponent that is removed from stored numbers so that their sums and differences neither overflow nor become
/// subnormal. It is 0 unless numbers come near the ends of the number type. Only floating-point voxels can.
fn exponent<R: Real>(volume: &Volume) -> i32 {
    let voxels = volume.voxels();
    let far = match voxels.voxel_type() {
        VoxelType::F32 | VoxelType::F64 => R::FAR_EXPONENT,
        _ => return 0,
    };
    let [lo, hi] = voxels.range();
    // The power itself has to be a normal number.
    let e = (math::exponent(lo.abs().max(hi.abs())) - 1).clamp(-1022, 1022);
    if e.abs() > far { e } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::space::Grid;
    use drypoint_scene::volume::Voxels;

    fn volume(dims: [usize; 3], f: impl Fn([i64; 3]) -> i64) -> Volume {
        let at = |i: usize| [i % dims[0], i / dims[0] % dims[1], i / (dims[0] * dims[1])].map(|i| i as i64);
        let voxels = (0..dims.iter().product()).map(|i| f(at(i)) as i32).collect();
        Volume::new(Grid::with_spacing(dims, [1.0; 3]).unwrap(), Voxels::I32(voxels), 1.0, 0.0).unwrap()
    }

    /// A quadratic is its own continuation, and whole numbers make it exact: at every cell, with or without border, the
    /// stencils are the function.
    #[test]
    fn stencils_are_the_function_inside_and_beyond_the_border() {
        let f = |[x, y, z]: [i64; 3]| 3 * x * x - 2 * x * y + y * z - 5 * z * z + 7 * y + 1;
        let dims = [6, 3, 5];
        let v = volume(dims, f);
        let s = Stencils::new::<f64>(&v);
        for cell in (0..5 * 2 * 4).map(|i| [i % 5, i / 5 % 2, i / 10]) {
            let at = |x: i64, y: i64, z: i64| f([cell[0] as i64 + x, cell[1] as i64 + y, cell[2] as i64 + z]) as f64;
            let span = |k: usize| k as i64 - 1;
            let block = s.block::<f64>(cell);
            for (k, j, i) in (0..64).map(|t| (t / 16, t / 4 % 4, t % 4)) {
                assert_eq!(block[k][j][i], at(span(i), span(j), span(k)), "{cell:?}: {i} {j} {k}");
            }
            let c: Cross<f64> = s.careful_cross(cell).unwrap_or_else(|| with_access!(v, |a| cross(a, cell)));
            for (n, (y, z)) in [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().enumerate() {
                assert_eq!(c.x[n], [-1, 0, 1, 2].map(|x| at(x, y, z)));
            }
            for (n, (y, z)) in [(-1, 0), (2, 0), (-1, 1), (2, 1)].into_iter().enumerate() {
                assert_eq!(c.y[n], [0, 1].map(|x| at(x, y, z)));
            }
            for (n, (y, z)) in [(0, -1), (1, -1), (0, 2), (1, 2)].into_iter().enumerate() {
                assert_eq!(c.z[n], [0, 1].map(|x| at(x, y, z)));
            }
            let want = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(y, z)| [at(0, y, z), at(1, y, z)]);
            assert_eq!(with_access!(v, |a| corners::<f64>(a, cell)), want);
            assert_eq!(s.read_corners::<f64>(cell[0], cell[1], cell[2]), want);
        }
    }

    #[test]
    fn voxels_with_all_their_neighbours() {
        let v = volume([4, 3, 5], |_| 0);
        let s = Stencils::new::<f64>(&v);
        let all: Vec<[usize; 3]> =
            (0..60).map(|i| [i % 4, i / 4 % 3, i / 12]).filter(|&voxel| s.surrounds(voxel)).collect();
        assert_eq!(all, [[1, 1, 1], [2, 1, 1], [1, 1, 2], [2, 1, 2], [1, 1, 3], [2, 1, 3]]);
        assert!(!Stencils::new::<f64>(&volume([4, 1, 5], |_| 0)).surrounds([1, 0, 1]));
    }

    #[test]
    fn two_samples_continue_as_a_line_and_one_as_a_constant() {
        let v = volume([2, 1, 4], |[x, _, z]| 10 * x + z * z);
        let s = Stencils::new::<f64>(&v);
        let block = s.block::<f64>([0, 0, 1]);
        for (k, j) in (0..16).map(|t| (t / 4, t % 4)) {
            let z = (k * k) as f64;
            assert_eq!(block[k][j], [z - 10.0, z, z + 10.0, z + 20.0]);
        }
    }

    #[test]
    fn only_numbers_near_the_ends_of_the_range_are_scaled() {
        let of = |largest: f64| {
            let voxels = Voxels::F64(vec![0.0, largest]);
            let grid = Grid::with_spacing([2, 1, 1], [1.0; 3]).unwrap();
            let v = Volume::new(grid, voxels, 1.0, 0.0).unwrap();
            (Stencils::new::<f64>(&v).scale(), Stencils::new::<f32>(&v).scale())
        };
        assert_eq!(of(1e9), (1.0, 1.0));
        // The last power of two that f64 leaves alone, and the next.
        assert_eq!(of(2f64.powi(500)).0, 1.0);
        assert_eq!(of(2f64.powi(501)).0, 2f64.powi(-501));
        assert_eq!(of(3.0 * 2f64.powi(100)), (1.0, 2f64.powi(-101)));
        assert_eq!(of(-1.5 * 2f64.powi(600)), (2f64.powi(-600), 2f64.powi(-600)));
        assert_eq!(of(f64::from_bits(1)), (2f64.powi(1022), 2f64.powi(1022)));
    }
}
