//! Stencils at the border of the grid, where lines of voxels are continued ([REC-1]).

use super::{Corners, Cross, Stencils, VoxelBlock, number};
use crate::number::Real;
use drypoint_scene::volume::Access;
use drypoint_scene::with_access;

/// Continues a line by one sample from the nearest three, two or one: c₋₁ = 3c₀ − 3c₁ + c₂, 2c₀ − c₁, c₀ ([REC-1]).
#[inline(always)]
pub(in crate::field) fn beyond<R: Real>(samples: usize, c0: R, c1: R, c2: R) -> R {
    match samples {
        1 => c0,
        2 => c0 + (c0 - c1),
        _ => {
            let d = c0 - c1;
            c2 + (d + d + d)
        }
    }
}

impl Stencils<'_> {
    #[cold]
    pub(super) fn read_corners<R: Real>(&self, x: usize, y: usize, z: usize) -> Corners<R> {
        let [[a, b], [c, d]] = self.clamped::<R, 2>([x as isize, y as isize, z as isize]);
        [a, b, c, d]
    }

    #[cold]
    pub(super) fn read_cross<R: Real>(&self, cell: [usize; 3]) -> Cross<R> {
        let b = self.read_block(cell);
        let two = |z: usize, y: usize| [b[z][y][1], b[z][y][2]];
        Cross {
            x: [b[1][1], b[1][2], b[2][1], b[2][2]],
            y: [two(1, 0), two(1, 3), two(2, 0), two(2, 3)],
            z: [two(0, 1), two(0, 2), two(3, 1), two(3, 2)],
        }
    }

    /// Reads the voxels that are in the grid and continues them outwards along x, then y, then z.
    #[cold]
    pub(super) fn read_block<R: Real>(&self, cell: [usize; 3]) -> VoxelBlock<R> {
        let dims = self.dims();
        let mut b = if dims.iter().all(|&n| n >= 4) {
            self.pushed_inside(cell)
        } else {
            self.clamped::<R, 4>(cell.map(|i| i as isize - 1))
        };
        // Lines are continued along x, y, z in this order. Each axis reads the results of the previous axes.
        let [nx, ny, nz] = dims;
        for line in b.iter_mut().flatten() {
            *line = continued(*line, cell[0], nx);
        }
        if cell[1] == 0 || cell[1] + 2 >= ny {
            for plane in &mut b {
                for i in [0, 1, 2, 3] {
                    let line = continued([plane[0][i], plane[1][i], plane[2][i], plane[3][i]], cell[1], ny);
                    (0..4).for_each(|j| plane[j][i] = line[j]);
                }
            }
        }
        if cell[2] == 0 || cell[2] + 2 >= nz {
            for (j, i) in (0..16).map(|line| (line / 4, line % 4)) {
                let line = continued([b[0][j][i], b[1][j][i], b[2][j][i], b[3][j][i]], cell[2], nz);
                (0..4).for_each(|k| b[k][j][i] = line[k]);
            }
        }
        b
    }

    /// The voxels of a block that are in the grid, in their places. The other entries are arbitrary. Axes have at least
    /// four voxels.
    fn pushed_inside<R: Real>(&self, cell: [usize; 3]) -> VoxelBlock<R> {
        let dims = self.dims();
        let mut start = [0; 3];
        // For each tap, the index of its voxel, or of the nearest one, among the four that are read.
        let mut places = [[0; 4]; 3];
        for a in 0..3 {
            start[a] = cell[a].saturating_sub(1).min(dims[a] - 4);
            for (i, place) in places[a].iter_mut().enumerate() {
                *place = (cell[a] + i).saturating_sub(1 + start[a]).min(3);
            }
        }
        let mut block = [[[R::ZERO; 4]; 4]; 4];
        with_access!(self.volume, |a| {
            let a = a.window::<4>(start[0], start[1], start[2]);
            for (plane, &k) in block.iter_mut().zip(&places[2]) {
                for (line, &j) in plane.iter_mut().zip(&places[1]) {
                    let row = a.row::<4>(0, j, k);
                    for (number_at, &i) in line.iter_mut().zip(&places[0]) {
                        *number_at = number(row[i], self.scale);
                    }
                }
            }
        });
        block
    }
}

/// Four samples from cell − 1 on, with those beyond the border of a line of n samples replaced.
fn continued<R: Real>(c: [R; 4], cell: usize, n: usize) -> [R; 4] {
    if n == 1 {
        return [c[1]; 4];
    }
    let mut c = c;
    let before = if cell == 0 { beyond(n, c[1], c[2], c[3]) } else { c[0] };
    if cell + 2 == n {
        c[3] = beyond(n, c[2], c[1], c[0]);
    }
    c[0] = before;
    c
}
