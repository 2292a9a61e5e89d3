//! The formula of a phantom in place of its reconstruction from voxels. Reconstructions converge to it ([COST-2]).

use super::place::CellPosition;
use crate::number::{Sym3, Vec3};
use drypoint_scene::glam::DVec3;
use drypoint_scene::math::scale_by_power_of_two;
use drypoint_scene::phantom::Phantom;
use drypoint_scene::space::Grid;
use std::fmt;

/// A phantom's formula on the box of its grid, with its exact derivatives. Values are not rounded to stored integers.
#[derive(Clone, Copy)]
pub(super) struct Exact<'p> {
    phantom: &'p dyn Phantom,
    grid: &'p Grid,
    /// e of [SPACE-4].
    exponent: i32,
}

impl fmt::Debug for Exact<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Exact").field("exponent", &self.exponent).finish_non_exhaustive()
    }
}

impl<'p> Exact<'p> {
    /// A phantom on its grid. Derivatives are multiplied by 2^−`exponent`, like those of the field that the formula
    /// replaces.
    pub(super) fn new(phantom: &'p dyn Phantom, grid: &'p Grid, exponent: i32) -> Self {
        Self { phantom, grid, exponent }
    }

    fn world(&self, at: CellPosition<f64>) -> DVec3 {
        self.grid.to_world(DVec3::from_array(std::array::from_fn(|a| at.cell[a] as f64 + at.w[a])))
    }

    fn scaled(&self, g: DVec3) -> Vec3<f64> {
        Vec3::from_glam(DVec3::from_array(g.to_array().map(|x| scale_by_power_of_two(x, -self.exponent))))
    }

    pub(super) fn value_at(&self, at: CellPosition<f64>) -> f64 {
        self.phantom.value(self.world(at))
    }

    pub(super) fn gradient_at(&self, at: CellPosition<f64>) -> Vec3<f64> {
        self.scaled(self.phantom.gradient(self.world(at)))
    }

    pub(super) fn hessian_at(&self, at: CellPosition<f64>) -> (Vec3<f64>, Sym3<f64>) {
        let jet = self.phantom.jet(self.world(at));
        let h = |row: usize, column: usize| scale_by_power_of_two(jet.hessian.col(column)[row], -self.exponent);
        let hessian = Sym3 { xx: h(0, 0), xy: h(0, 1), xz: h(0, 2), yy: h(1, 1), yz: h(1, 2), zz: h(2, 2) };
        (self.scaled(jet.gradient), hessian)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Field, HessianEstimator, Reconstruction, Rung, Sampler};
    use super::*;
    use crate::with_sampler;
    use drypoint_scene::phantom::{by_name, sample};
    use drypoint_scene::volume::{Volume, VoxelType, Voxels};

    /// A field with a formula reads no voxel: neither between voxels nor at them, where estimators have shorter ways.
    #[test]
    fn a_formula_takes_the_place_of_all_voxels() {
        for voxel_type in [VoxelType::U8, VoxelType::F64] {
            let grid = Grid::with_spacing([24, 20, 22], [0.5, 1.0, 0.75]).unwrap();
            let phantom = by_name("torus", &grid, &[]).unwrap();
            let flat = Volume::new(grid.clone(), zeros(voxel_type, grid.len()), 1.0, 0.0).unwrap();
            let field = Field::<f64>::new(&flat, Reconstruction::default(), Rung::Hessian).unwrap();
            let field = field.with_formula(phantom.as_ref());
            let exact = Exact::new(phantom.as_ref(), &grid, field.scale_exponent());
            let p = Vec3::new(11.25, 9.5, 10.75);
            let at = field.place(p);
            assert_eq!((field.value(p), field.gradient(p)), (exact.value_at(at), exact.gradient_at(at)));
            assert_eq!(field.hessian(p), exact.hessian_at(at));
            let at = |x: usize| field.place(Vec3::new(x as f64, 9.0, 10.0));
            let mut squares = vec![0.0; 24];
            field.voxel_squares([9, 10], &mut Vec::new(), &mut squares);
            for (x, square) in squares.into_iter().enumerate() {
                let gradient = exact.gradient_at(at(x));
                assert_eq!(field.voxel_gradient([x, 9, 10]), gradient);
                assert_eq!(square, gradient.dot(gradient));
                assert_eq!(field.voxel_hessian([x, 9, 10]), exact.hessian_at(at(x)));
                assert_eq!(field.smoothed_value([x, 9, 10]), exact.value_at(at(x)));
            }
        }
    }

    fn zeros(voxel_type: VoxelType, n: usize) -> Voxels {
        if voxel_type == VoxelType::U8 { Voxels::U8(vec![0; n]) } else { Voxels::F64(vec![0.0; n]) }
    }

    /// Central differences, first and second, are exact at the voxels of a quadratic field. There the formula and the
    /// reconstruction agree up to rounding, in the same units.
    #[test]
    fn where_differences_are_exact_they_agree() {
        let grid = Grid::with_spacing([24, 20, 22], [0.5, 1.0, 0.75]).unwrap();
        let phantom = by_name("saddle", &grid, &[]).unwrap();
        let volume = sample(phantom.as_ref(), grid, VoxelType::F64).unwrap();
        let how = Reconstruction { hessian: HessianEstimator::Central, ..Reconstruction::default() };
        let field = Field::<f64>::new(&volume, how, Rung::Hessian).unwrap();
        let exact = Exact::new(phantom.as_ref(), volume.grid(), field.scale_exponent());
        assert_ne!(field.scale_exponent(), 0, "or units would not be told apart");
        with_sampler!(field, |sampler| {
            for p in [[11.0, 9.0, 10.0], [4.0, 15.0, 17.0]].map(|[x, y, z]| Vec3::new(x, y, z)) {
                let at = field.place(p);
                let ((g, h), (g2, h2)) = (exact.hessian_at(at), sampler.hessian(p));
                // Values are below 8 and e is 3; second differences divide their rounding by ¼.
                let apart = |a: Vec3<f64>, b: Vec3<f64>| (a - b).length();
                assert!((exact.value_at(at) - sampler.value(p)).abs() <= 1e-14);
                assert!(apart(exact.gradient_at(at), sampler.gradient(p)) <= 1e-14 && apart(g, g2) <= 1e-14);
                for axis in [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)] {
                    assert!(apart(h.apply(axis), h2.apply(axis)) <= 1e-13);
                }
            }
        });
    }
}
