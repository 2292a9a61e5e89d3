//! ‖g‖² by central differences at every voxel of a row of 8- or 16-bit integers.
//!
//! Differences of such integers are exact, beyond the border too. The bits are therefore those of [`super::central`] in
//! any order of the sums. Only the differences are converted to floating point, not each voxel.

use crate::field::{Field, GradientEstimator};
use crate::number::lanes::widely;
use crate::number::{Mat3, Real, Vec3};
use drypoint_scene::volume::{Voxel, Voxels};

/// Twice the derivative along an axis at a voxel: the sum of three voxels of its line times weights.
#[derive(Clone, Copy)]
struct Difference {
    voxels: [usize; 3],
    weights: [i32; 3],
}

impl Difference {
    /// The difference at voxel i of a line of n ≥ 2. Beyond the border the line is continued by 3c₀ − 3c₁ + c₂, or by
    /// 2c₀ − c₁ if it has two voxels ([REC-1]).
    fn at(i: usize, n: usize) -> Self {
        match i {
            _ if n == 2 => Self { voxels: [0, 1, 1], weights: [-2, 2, 0] },
            0 => Self { voxels: [0, 1, 2], weights: [-3, 4, -1] },
            _ if i + 1 == n => Self { voxels: [n - 3, n - 2, n - 1], weights: [1, -4, 3] },
            _ => Self { voxels: [i - 1, i, i + 1], weights: [-1, 0, 1] },
        }
    }

    /// Whether the voxel lies at neither end.
    fn is_inside(self) -> bool {
        self.weights[1] == 0
    }

    /// The sum of three numbers that stand for the voxels.
    #[inline(always)]
    fn of<V: Into<i32>>(self, [a, b, c]: [V; 3]) -> i32 {
        let [p, q, r] = self.weights;
        p * a.into() + q * b.into() + r * c.into()
    }
}

impl<R: Real> Field<'_, R> {
    /// ‖g‖² times 4^−e of all voxels of a row, including those at the border. The bits are those of the squared length
    /// of [`voxel_gradient`](crate::field::Sampler::voxel_gradient). `squares` is as long as the row.
    ///
    /// Returns whether the row was computed. It is computed for central differences of 8- and 16-bit integers, on axes
    /// of at least two voxels.
    pub(crate) fn integer_squares(&self, row: [usize; 2], squares: &mut [R]) -> bool {
        if self.how.gradient != GradientEstimator::Central || self.stencils.careful() {
            return false;
        }
        let dims = self.stencils.dims();
        match self.volume.voxels() {
            Voxels::U8(voxels) => of_row(voxels, dims, row, &self.to_world, squares),
            Voxels::I8(voxels) => of_row(voxels, dims, row, &self.to_world, squares),
            Voxels::U16(voxels) => of_row(voxels, dims, row, &self.to_world, squares),
            Voxels::I16(voxels) => of_row(voxels, dims, row, &self.to_world, squares),
            _ => return false,
        }
        true
    }
}

fn of_row<R: Real, V: Voxel + Into<i32>>(
    voxels: &[V],
    [nx, ny, nz]: [usize; 3],
    [y, z]: [usize; 2],
    to_world: &Mat3<R>,
    squares: &mut [R],
) {
    let row = |y: usize, z: usize| &voxels[(z * ny + y) * nx..][..nx];
    // The three rows of each difference across the row are the same for all its voxels.
    let (along_y, along_z) = (Difference::at(y, ny), Difference::at(z, nz));
    let (middle, ys, zs) = (row(y, z), along_y.voxels.map(|y| row(y, z)), along_z.voxels.map(|z| row(y, z)));
    let square = |doubled: [i32; 3]| {
        let [x, y, z] = doubled.map(|d| R::from_voxel(d) * R::HALF);
        let gradient = to_world.apply(Vec3::new(x, y, z));
        gradient.dot(gradient)
    };
    // The two ends of the row have one-sided differences along x.
    for x in [0, nx - 1] {
        let along_x = Difference::at(x, nx);
        let at = |rows: [&[V]; 3]| rows.map(|row| row[x]);
        squares[x] = square([along_x.of(along_x.voxels.map(|x| middle[x])), along_y.of(at(ys)), along_z.of(at(zs))]);
    }
    // All slices are cut to one length, so that the compiler sees that no index is beyond an end.
    let inside = nx - 2;
    let (left, right) = (&middle[..inside], &middle[2..][..inside]);
    let ([y0, y1, y2], [z0, z1, z2]) = (ys.map(|row| &row[1..][..inside]), zs.map(|row| &row[1..][..inside]));
    let squares = &mut squares[1..][..inside];
    if along_y.is_inside() && along_z.is_inside() {
        widely(
            #[inline(always)]
            || {
                for x in 0..inside {
                    let along = |down: &[V], up: &[V]| up[x].into() - down[x].into();
                    squares[x] = square([along(left, right), along(y0, y2), along(z0, z2)]);
                }
            },
        );
    } else {
        for x in 0..inside {
            let along_x = right[x].into() - left[x].into();
            squares[x] = square([along_x, along_y.of([y0[x], y1[x], y2[x]]), along_z.of([z0[x], z1[x], z2[x]])]);
        }
    }
}
