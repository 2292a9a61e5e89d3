//! The range of ‖g‖ that is mapped to |g| from 0 to 1 ([VAL-2]).

use crate::field::{Field, GradientEstimator};
use crate::number::Real;
use drypoint_scene::parallel;
use drypoint_scene::volume::Mask;
use drypoint_scene::volume::quantile::quantile;
use std::ops::RangeInclusive;

/// The quantile q of ‖g‖, times the power of two of [SPACE-4], and the number of voxels that were evaluated. The
/// quantile is over the voxels where ‖g‖ exceeds the bound of [PREC-3]; it is 0 if no voxel has a normal. Voxels whose
/// stencil touches a masked voxel are left out.
pub(crate) fn quantile_of_norms<R: Real>(field: &Field<'_, R>, q: f64) -> (f64, u64) {
    let (volume, estimator, no_normal_below) = (field.volume, field.how.gradient, field.no_normal_below);
    let dims @ [nx, ny, nz] = volume.dims();
    let counts = |x: usize, y: usize, z: usize| !volume.mask().is_some_and(|m| touches(m, dims, [x, y, z], estimator));
    // Roots keep the order, so the quantile of the squares is selected and its root is taken once.
    let least = square_of(no_normal_below);
    let fill = |(rows, squares): &mut (Vec<R>, Vec<R>), row: usize, numbers: &mut Vec<f64>| {
        let (y, z) = (row % ny, row / ny);
        field.voxel_squares([y, z], rows, squares);
        // Each square is written after the last one that counts. A branch would be mispredicted at every edge of an
        // object.
        numbers.resize(nx, 0.0);
        let mut kept = 0;
        for (x, &square) in squares.iter().enumerate() {
            numbers[kept] = square.to_f64();
            kept += usize::from(square > least && counts(x, y, z));
        }
        numbers.truncate(kept);
    };
    let square = quantile(ny * nz, &|| (Vec::new(), vec![R::ZERO; nx]), &fill, q);
    let hi = square.map(|square| R::from_f64(square).sqrt().to_f64());
    let evaluated = match volume.mask() {
        None => (nx * ny * nz) as u64,
        Some(_) => {
            let of_row = |row: usize| (0..nx).filter(|&x| counts(x, row % ny, row / ny)).count() as u64;
            parallel::map(ny * nz, &of_row).into_iter().sum()
        }
    };
    (hi.unwrap_or(0.0), evaluated)
}

/// The largest number whose root is at most a bound ≥ 0. So a number's root exceeds the bound exactly if the number
/// exceeds the result.
fn square_of<R: Real>(bound: R) -> R {
    let mut square = bound * bound;
    while square.next_up().sqrt() <= bound {
        square = square.next_up();
    }
    while square.sqrt() > bound {
        square = square.next_down();
    }
    square
}

/// Whether a voxel is masked, or its gradient reads a masked voxel.
///
/// The derivative along each axis reads a box about the voxel. Along that axis the box has the neighbours, or three
/// voxels inwards from a border where differences are one-sided. Across the axis, central differences read no
/// neighbours, and Sobel's operator reads them where it has both. The other estimators read all neighbours that exist.
/// For `analytic` these are the corners of the eight cells about the voxel.
pub(crate) fn touches(mask: &Mask, dims: [usize; 3], voxel: [usize; 3], estimator: GradientEstimator) -> bool {
    use GradientEstimator::{Analytic, Central, Regression, Sobel};
    let neighbours = |a: usize| voxel[a].saturating_sub(1)..=(voxel[a] + 1).min(dims[a] - 1);
    let at_border = |a: usize| voxel[a] == 0 || voxel[a] + 1 == dims[a];
    let along = |a: usize| match estimator {
        Central | Sobel if voxel[a] == 0 => 0..=(dims[a] - 1).min(2),
        Central | Sobel if at_border(a) => dims[a].saturating_sub(3)..=voxel[a],
        _ => neighbours(a),
    };
    let across = |a: usize| match estimator {
        Central => voxel[a]..=voxel[a],
        Sobel if at_border(a) => voxel[a]..=voxel[a],
        Sobel | Analytic | Regression => neighbours(a),
    };
    let is_masked = |[x, y, z]: [RangeInclusive<usize>; 3]| {
        z.into_iter().any(|z| y.clone().any(|y| x.clone().any(|x| mask.voxel([x, y, z]))))
    };
    (0..3).any(|axis| is_masked(std::array::from_fn(|a| if a == axis { along(a) } else { across(a) })))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{HessianEstimator, Kernel, Outside, Reconstruction, Rung, Sampler};
    use crate::number::Vec3;
    use crate::with_sampler;
    use drypoint_scene::space::Grid;
    use drypoint_scene::volume::{Volume, Voxels};

    /// Voxels of a grid, x fastest.
    fn voxels([nx, ny, nz]: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
        (0..nx * ny * nz).map(move |i| [i % nx, i / nx % ny, i / (nx * ny)])
    }

    /// A rough field without symmetries, with another value at one voxel.
    fn rough(dims: [usize; 3], hole: [usize; 3], there: f64) -> Vec<f64> {
        let value = |[x, y, z]: [usize; 3]| ((x * 37 + y * 101 + z * 53 + x * y * 7 + y * z * 11) % 29) as f64;
        voxels(dims).map(|v| if v == hole { there } else { value(v) }).collect()
    }

    /// ∇f at every voxel.
    fn gradients(dims: [usize; 3], values: Vec<f64>, gradient: GradientEstimator) -> Vec<Vec3<f64>> {
        let grid = Grid::with_spacing(dims, [1.0; 3]).unwrap();
        let volume = Volume::new(grid, Voxels::F64(values), 1.0, 0.0).unwrap();
        let how = Reconstruction {
            kernel: Kernel::Trilinear,
            gradient,
            hessian: HessianEstimator::Auto,
            scale: 1.0,
            outside: Outside::Low,
        };
        let field = Field::new(&volume, how, Rung::Gradient).unwrap();
        let at = |v: [usize; 3]| Vec3::from_glam(v.map(|i| i as f64).into());
        let exponent = field.scale_exponent();
        let unscaled =
            |g: Vec3<f64>| g.to_glam().to_array().map(|c| drypoint_scene::math::scale_by_power_of_two(c, exponent));
        voxels(dims).map(|v| Vec3::from_glam(unscaled(with_sampler!(field, |s| s.gradient(at(v)))).into())).collect()
    }

    #[test]
    fn a_root_is_above_a_bound_where_the_number_is_above_its_square() {
        fn check<R: Real>(bounds: &[f64]) {
            for bound in bounds.iter().map(|&bound| R::from_f64(bound)) {
                let square = square_of(bound);
                assert!(square.sqrt() <= bound && square.next_up().sqrt() > bound, "{bound:?}");
            }
        }
        check::<f64>(&[0.0, 1e-320, 1e-200, 0.1, 1.0, 3.0, 1.0 + f64::EPSILON, 1e150, 1e160]);
        check::<f32>(&[0.0, 1e-44, 1e-20, 0.1, 1.0, 3.0, 1e18]);
    }

    /// A voxel is left out if its gradient depends on a masked one, or it is one: whatever the mask is filled with, what
    /// counts does not change. And no other voxel is left out.
    #[test]
    fn what_is_left_out_is_what_depends_on_the_mask() {
        use GradientEstimator::{Central, Regression, Sobel};
        for dims in [[5, 4, 6], [4, 3, 2], [6, 1, 3], [2, 2, 5]] {
            for hole in voxels(dims) {
                let grid = Grid::with_spacing(dims, [1.0; 3]).unwrap();
                let masked = Volume::new(grid, Voxels::F64(rough(dims, hole, f64::NAN)), 1.0, 0.0).unwrap();
                for estimator in [Central, Sobel, Regression] {
                    let [low, high] = [10.0, 300.0].map(|there| gradients(dims, rough(dims, hole, there), estimator));
                    for ((v, low), high) in voxels(dims).zip(low).zip(high) {
                        let depends = (low - high).length() > 1e-6;
                        let left_out = touches(masked.mask().unwrap(), dims, v, estimator);
                        assert_eq!(
                            left_out,
                            depends || v == hole,
                            "{estimator:?} {dims:?}, hole {hole:?}, voxel {v:?}"
                        );
                    }
                }
            }
        }
    }
}
