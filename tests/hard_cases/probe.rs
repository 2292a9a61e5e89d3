//! The field at a point: signs of curvature inside and outside a torus ([CUR-1], [NORM-1]).

use drypoint::reference::field::probe::at_world;
use drypoint::reference::field::{Field, GradientEstimator, HessianEstimator, Kernel, Outside, Reconstruction, Rung};
use drypoint::scene::glam::DVec3;
use drypoint::scene::phantom;
use drypoint::scene::space::Grid;
use drypoint::scene::volume::VoxelType;

/// At the outer equator a torus curves both ways towards its inside, 1/r and 1/(R + r); at the inner one the second is
/// −1/(R − r): the surface bends around the hole. On top it is 1/r and 0. A dark torus in a bright surround, with
/// `outside = "high"`, is the same thing.
#[test]
fn a_torus_inside_and_outside() {
    let (big, small) = (14.0, 6.0);
    let grid = Grid::with_spacing([46, 46, 20], [1.0; 3]).unwrap();
    let params = [("R".to_owned(), big), ("r".to_owned(), small)];
    for (voxel_type, tolerance) in [(VoxelType::F64, 2e-3), (VoxelType::U8, 2e-2)] {
        let torus = phantom::for_type("torus", &grid, voxel_type, &params).unwrap();
        let bright = phantom::sample(torus.as_ref(), grid.clone(), voxel_type).unwrap();
        let dark = drypoint::scene::volume::Volume::new(grid.clone(), bright.voxels().clone(), -1.0, 0.0).unwrap();
        for (volume, outside) in [(&bright, Outside::Low), (&dark, Outside::High)] {
            let how = Reconstruction {
                kernel: Kernel::Bspline,
                gradient: GradientEstimator::Analytic,
                hessian: HessianEstimator::Auto,
                scale: 1.0,
                outside,
            };
            let field = Field::<f64>::new(volume, how, Rung::Hessian).unwrap();
            let at = |offset: DVec3, view: DVec3| at_world(&field, grid.centre() + offset, Some(view)).unwrap();
            let outer = at(DVec3::new(big + small, 0.0, 0.0), DVec3::new(1.0, 0.0, 5.0));
            assert!((outer.k1 - 1.0 / small).abs() < tolerance && (outer.k2 - 1.0 / (big + small)).abs() < tolerance);
            assert!((outer.normal.unwrap() - DVec3::X).length() < tolerance);
            // Along the view, t = z: the small circle.
            assert!((outer.kv.unwrap() - 1.0 / small).abs() < tolerance);
            let inner = at(DVec3::new(big - small, 0.0, 0.0), DVec3::new(-1.0, 5.0, 0.0));
            assert!((inner.k1 - 1.0 / small).abs() < tolerance && (inner.k2 + 1.0 / (big - small)).abs() < tolerance);
            assert!((inner.normal.unwrap() + DVec3::X).length() < tolerance);
            assert!((inner.kv.unwrap() + 1.0 / (big - small)).abs() < tolerance);
            let top = at(DVec3::new(0.0, big, small), DVec3::Z);
            assert!((top.k1 - 1.0 / small).abs() < tolerance && top.k2.abs() < tolerance);
        }
    }
}
