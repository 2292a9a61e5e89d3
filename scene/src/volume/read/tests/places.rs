//! Positions of the voxels: each format's axes and origin, on numbers worked by hand.

use super::super::Fault;
use super::*;
use crate::volume::Anatomy;
use glam::{DMat3, DVec3};

const U8: VoxelType = VoxelType::U8;

fn nrrd(more: &str) -> Vec<u8> {
    joined(nrrd_lines(U8, "2 3 2", "raw", false) + more + "\n", &[0; 12])
}

fn meta(more: &str) -> Vec<u8> {
    joined(meta_lines(U8, "2 3 2", &(more.to_string() + "ElementDataFile = LOCAL\n")), &[0; 12])
}

#[test]
fn nrrd_directions_and_origin() {
    let folder = Folder::new();
    let volume = folder
        .read("a.nrrd", nrrd("space: left-posterior-superior\nspace directions: (0,2,0) ( -1 , 0.5, 0 ) (0,0,1e1)\nspace origin: (1,-2,3.5)\n"))
        .unwrap();
    let axes = DMat3::from_cols(DVec3::new(0.0, 2.0, 0.0), DVec3::new(-1.0, 0.5, 0.0), DVec3::new(0.0, 0.0, 10.0));
    assert_eq!((volume.grid().axes(), volume.grid().origin()), (axes, DVec3::new(1.0, -2.0, 3.5)));
    assert_eq!(volume.anatomy(), Some(Anatomy::LeftPosteriorSuperior));
}

#[test]
fn nrrd_spacings_stand_on_the_diagonal_with_origin_zero() {
    let folder = Folder::new();
    let grid = folder.read("a.nrrd", nrrd("spacings: 0.5 NaN -4\nspace origin: (1,2,3)\n")).unwrap().grid().clone();
    assert_eq!((grid.axes(), grid.origin()), (DMat3::from_diagonal(DVec3::new(0.5, 1.0, -4.0)), DVec3::ZERO));
    let grid = folder.read("a.nrrd", nrrd("")).unwrap().grid().clone();
    assert_eq!((grid.axes(), grid.origin()), (DMat3::IDENTITY, DVec3::ZERO));
}

#[test]
fn nrrd_spaces() {
    let folder = Folder::new();
    for (space, want) in [
        ("RAS", Some(Anatomy::RightAnteriorSuperior)),
        ("Right-Anterior-Superior", Some(Anatomy::RightAnteriorSuperior)),
        ("LAS", Some(Anatomy::LeftAnteriorSuperior)),
        ("lps", Some(Anatomy::LeftPosteriorSuperior)),
        ("scanner-xyz", None),
        ("3D-right-handed", None),
    ] {
        let file = nrrd(&format!("space: {space}\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"));
        assert_eq!(folder.read("a.nrrd", file).unwrap().anatomy(), want, "{space}");
    }
    let file = nrrd("space: RAST\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n");
    assert!(matches!(*folder.read("a.nrrd", file).unwrap_err().fault, Fault::Unsupported { .. }));
}

#[test]
fn metaimage_matrix_has_a_direction_for_each_axis() {
    let folder = Folder::new();
    // The first three numbers are the direction of the first axis: x runs along world y, 2 apart.
    let file = meta(
        "TransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 5 6 7\nElementSpacing = 2 3 4\nAnatomicalOrientation = RAI\n",
    );
    let volume = folder.read("a.mha", file).unwrap();
    let axes = DMat3::from_cols(DVec3::Y * 2.0, DVec3::X * -3.0, DVec3::Z * 4.0);
    assert_eq!((volume.grid().axes(), volume.grid().origin()), (axes, DVec3::new(5.0, 6.0, 7.0)));
    assert_eq!(volume.anatomy(), Some(Anatomy::LeftPosteriorSuperior));
    let volume = folder.read("a.mha", meta("ElementSize = 2 3 4\nPosition = 1 1 1\n")).unwrap();
    assert_eq!(volume.grid().axes(), DMat3::from_diagonal(DVec3::new(2.0, 3.0, 4.0)));
    assert_eq!(volume.grid().origin(), DVec3::ONE);
}

#[test]
fn nifti_sform_wins_over_qform() {
    let folder = Folder::new();
    for (sform, qform, axes, origin, anatomy) in [
        (1, 1, DMat3::from_cols(DVec3::NEG_X, DVec3::Y, DVec3::Z * 2.0), DVec3::new(9.0, 8.0, 7.0), true),
        (0, 1, DMat3::from_cols(DVec3::Y, DVec3::Z * 2.0, DVec3::X * 3.0), DVec3::new(1.0, 2.0, 3.0), true),
        (0, 0, DMat3::from_diagonal(DVec3::new(1.0, 2.0, 3.0)), DVec3::ZERO, false),
    ] {
        for big in [false, true] {
            let mut one = Nifti::one(U8, &[2, 3, 2], big);
            one.i16(252, qform).i16(254, sform);
            let mut two = Nifti::two(U8, &[2, 3, 2], big);
            two.i32(344, qform.into()).i32(348, sform.into());
            let rows = [[-1.0f64, 0.0, 0.0, 9.0], [0.0, 1.0, 0.0, 8.0], [0.0, 0.0, 2.0, 7.0]];
            for (i, row) in rows.iter().enumerate() {
                one.f32(256 + 4 * i, 0.5).f32(268 + 4 * i, 1.0 + i as f32);
                two.f64(352 + 8 * i, 0.5).f64(376 + 8 * i, 1.0 + i as f64);
                for (j, &number) in row.iter().enumerate() {
                    one.f32(280 + 16 * i + 4 * j, number as f32);
                    two.f64(400 + 32 * i + 8 * j, number);
                }
            }
            for header in [one, two] {
                let volume = folder.read("a.nii", header.with(&[0; 12])).unwrap();
                assert_eq!((volume.grid().axes(), volume.grid().origin()), (axes, origin));
                assert_eq!(volume.anatomy(), anatomy.then_some(Anatomy::RightAnteriorSuperior));
            }
        }
    }
}

#[test]
fn axes_that_do_not_span_space_name_their_field() {
    let folder = Folder::new();
    let mut sform = Nifti::one(U8, &[2, 3, 2], false);
    sform.i16(254, 1);
    let mut qform = Nifti::one(U8, &[2, 3, 2], false);
    qform.i16(252, 1).f32(256, f32::NAN);
    let mut spacing = Nifti::one(U8, &[2, 3, 2], false);
    spacing.f32(84, 0.0);
    for (name, file, field) in [
        ("a.nrrd", nrrd("spacings: 1 0 1\n"), "spacings"),
        ("a.nrrd", nrrd("spacings: 1 inf 1\n"), "spacings"),
        ("a.nrrd", nrrd("space dimension: 3\nspace directions: (1,0,0) (0,1,0) (1,1,0)\n"), "space directions"),
        (
            "a.nrrd",
            nrrd("space dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (nan,0,0)\n"),
            "space origin",
        ),
        ("a.mha", meta("TransformMatrix = 1 0 0 1 0 0 0 0 1\n"), "TransformMatrix"),
        ("a.mha", meta("ElementSpacing = 1 0 1\n"), "ElementSpacing"),
        ("a.mha", meta("TransformMatrix = 1 0 0 0 1 0 0 0 1\nElementSpacing = 1 0 1\n"), "ElementSpacing"),
        ("a.mha", meta("Offset = 1 inf 1\n"), "Offset"),
        ("a.nii", sform.with(&[0; 12]), "srow_x, srow_y, srow_z"),
        ("a.nii", qform.with(&[0; 12]), "quatern_b, quatern_c, quatern_d, pixdim"),
        ("a.nii", spacing.with(&[0; 12]), "pixdim"),
    ] {
        let error = folder.read(name, file).unwrap_err();
        let origin = ["space origin", "Offset"].contains(&field);
        assert!(
            matches!(*error.fault, Fault::Value { .. } if origin) || matches!(*error.fault, Fault::Space(_)),
            "{error}"
        );
        assert_eq!(error.field.as_deref(), Some(field), "{error}");
    }
}
