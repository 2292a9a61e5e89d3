//! Volumes written are read back bit by bit.

use super::*;
use crate::space::Grid;
use crate::volume::Anatomy;
use crate::volume::write::{Encoding, write_nrrd, write_nrrd_as};
use glam::{DMat3, DVec3};
use proptest::prelude::*;

fn sheared() -> Grid {
    let axes =
        DMat3::from_cols(DVec3::new(0.1, 0.2, -0.3), DVec3::new(1e-3, 1.0 / 3.0, 7.0), DVec3::new(1e10, 0.0, 2.5));
    Grid::new([2, 3, 2], axes, DVec3::new(-0.0, 1e-300, std::f64::consts::PI)).unwrap()
}

#[test]
fn every_type_on_sheared_axes() {
    let folder = Folder::new();
    for &t in VoxelType::ALL {
        for (encoding, anatomy) in [
            (Encoding::Raw, None),
            (Encoding::Gzip, Some(Anatomy::LeftPosteriorSuperior)),
            (Encoding::Gzip, Some(Anatomy::LeftAnteriorSuperior)),
            (Encoding::Raw, Some(Anatomy::RightAnteriorSuperior)),
        ] {
            let volume = Volume::new(sheared(), sample(t), 1.0, 0.0).unwrap().with_anatomy(anatomy);
            let path = folder.path("a.nrrd");
            write_nrrd_as(&volume, &path, encoding).unwrap();
            let back = read(&path, None).unwrap();
            assert_eq!(back.grid(), volume.grid());
            assert_eq!(bytes_of(back.voxels(), false), bytes_of(volume.voxels(), false));
            assert_eq!((back.voxels().voxel_type(), back.anatomy()), (t, anatomy));
        }
    }
}

#[test]
fn masks_come_back_and_values_replace_slope_and_intercept() {
    let folder = Folder::new();
    let path = folder.path("a.nrrd");
    let holes = Voxels::F32(vec![1.0, f32::NAN, 3.0, 4.0, 5.0, f32::INFINITY, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0]);
    for (slope, intercept) in [(1.0, 0.0), (0.1, -1024.0)] {
        let volume = Volume::new(sheared(), holes.clone(), slope, intercept).unwrap();
        write_nrrd(&volume, &path).unwrap();
        let back = read(&path, None).unwrap();
        assert_eq!(back.mask(), volume.mask());
        for (x, y, z) in [(0, 0, 0), (1, 1, 0), (1, 2, 1)] {
            assert_eq!(back.value([x, y, z]).to_bits(), volume.value([x, y, z]).to_bits());
        }
    }
}

#[test]
fn the_same_volume_gives_the_same_bytes_and_nothing_else_stays() {
    let folder = Folder::new();
    let volume = Volume::new(sheared(), sample(VoxelType::I16), 1.0, 0.0).unwrap();
    write_nrrd(&volume, &folder.path("a.nrrd")).unwrap();
    write_nrrd(&volume, &folder.path("b.nrrd")).unwrap();
    let [a, b] = ["a.nrrd", "b.nrrd"].map(|name| std::fs::read(folder.path(name)).unwrap());
    assert_eq!(a, b);
    assert_eq!(std::fs::read_dir(folder.path("")).unwrap().count(), 2);
    // A folder stands where the file should: the error names it, and no part is left.
    std::fs::create_dir(folder.path("c.nrrd")).unwrap();
    let error = write_nrrd(&volume, &folder.path("c.nrrd")).unwrap_err();
    assert!(error.place().ends_with("c.nrrd") && error.to_string().lines().count() == 3);
    assert_eq!(std::fs::read_dir(folder.path("")).unwrap().count(), 3);
    assert!(write_nrrd(&volume, &folder.path("no/folder.nrrd")).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_axes_and_any_finite_voxels(
        d in proptest::array::uniform9(-1e6f64..1e6),
        origin in proptest::array::uniform3(proptest::num::f64::NORMAL),
        voxels in proptest::collection::vec(proptest::num::f32::ANY, 12),
    ) {
        let grid = Grid::new([2, 3, 2], DMat3::from_cols_array(&d), DVec3::from_array(origin));
        prop_assume!(grid.is_ok() && voxels.iter().any(|v| v.is_finite()));
        let volume = Volume::new(grid.unwrap(), Voxels::F32(voxels), 1.0, 0.0).unwrap();
        let folder = Folder::new();
        write_nrrd_as(&volume, &folder.path("a.nrrd"), Encoding::Raw).unwrap();
        let back = read(&folder.path("a.nrrd"), None).unwrap();
        prop_assert_eq!(back.grid(), volume.grid());
        prop_assert_eq!(bytes_of(back.voxels(), false), bytes_of(volume.voxels(), false));
        prop_assert_eq!(back.mask(), volume.mask());
    }
}
