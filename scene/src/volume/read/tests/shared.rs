//! The shared test volumes: each loads, with the numbers that its table gives. Skipped where they are not there.

use super::*;
use crate::volume::Anatomy;
use VoxelType::{F32, I16, I32, U8, U16};
use glam::{DMat3, DVec3};
use std::path::Path;

/// Name, dims, type, spacing, range of the stored numbers.
type Row = (&'static str, [usize; 3], VoxelType, [f64; 3], [f64; 2]);

const ONE: [f64; 3] = [1.0; 3];

const TABLE: [Row; 26] = [
    ("engine.nhdr", [256, 256, 128], U8, ONE, [0.0, 255.0]),
    ("bonsai.nhdr", [256, 256, 256], U8, ONE, [0.0, 255.0]),
    ("aneurism.nhdr", [256, 256, 256], U8, ONE, [0.0, 255.0]),
    ("lobster.nhdr", [301, 324, 56], U8, [1.0, 1.0, 1.4], [0.0, 255.0]),
    ("statue_leg.nhdr", [341, 341, 93], U8, [1.0, 1.0, 4.0], [0.0, 250.0]),
    ("cthead.nhdr", [256, 256, 113], I16, [1.0, 1.0, 2.0], [0.0, 3272.0]),
    ("tooth.nhdr", [103, 94, 161], U16, ONE, [0.0, 1300.0]),
    ("hydrogen_atom.nhdr", [128, 128, 128], U8, ONE, [0.0, 250.0]),
    ("neghip.nhdr", [64, 64, 64], U8, ONE, [0.0, 255.0]),
    ("iron_protein.nhdr", [68, 68, 68], U8, ONE, [0.0, 255.0]),
    ("fuel.nhdr", [64, 64, 64], U8, ONE, [0.0, 255.0]),
    ("nucleon.nhdr", [41, 41, 41], U8, ONE, [0.0, 249.0]),
    ("silicium.nhdr", [98, 34, 34], U8, ONE, [0.0, 255.0]),
    ("marschner_lobb.nhdr", [41, 41, 41], U8, ONE, [0.0, 255.0]),
    ("heptane.nii.gz", [302, 302, 302], U8, ONE, [0.0, 255.0]),
    ("mri_head.nii.gz", [160, 232, 160], U8, [1.0, 0.8984, 0.8984], [0.0, 255.0]),
    ("mni152_2009_t1_brain.nii.gz", [193, 229, 193], I16, ONE, [0.0, 1570.0]),
    ("avg152T1_RL_bigendian.nii.gz", [91, 109, 91], U8, [2.0; 3], [0.0, 255.0]),
    ("flair_brain.nrrd", [124, 160, 140], U8, ONE, [0.0, 255.0]),
    ("dti_fa.nii.gz", [84, 92, 56], F32, [2.2; 3], [0.0, 1.2247]),
    ("abdomen_ct.nii.gz", [122, 101, 112], I32, [3.0; 3], [-1207.0, 3382.0]),
    ("abdomen_ct_labels.nii.gz", [122, 101, 112], U8, [3.0; 3], [0.0, 117.0]),
    ("aorta_cta.nii.gz", [120, 126, 164], I16, [1.5; 3], [-1078.0, 3343.0]),
    ("aorta_cta_label.nii.gz", [120, 126, 164], U8, [1.5; 3], [0.0, 1.0]),
    ("inia19_t1_brain.nii.gz", [168, 206, 128], U8, [0.5; 3], [0.0, 255.0]),
    ("inia19_labels.nii.gz", [168, 206, 128], I16, [0.5; 3], [0.0, 1605.0]),
];

/// A shared file, or none with a word on the error stream.
fn file(name: &str) -> Option<PathBuf> {
    let default = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data");
    let folders = std::env::var_os("DRYPOINT_DATA").unwrap_or(default.into());
    if let Some(path) = std::env::split_paths(&folders).map(|folder| folder.join(name)).find(|path| path.is_file()) {
        return Some(path);
    }
    eprintln!("skipped: no data ({name})");
    None
}

fn load(name: &str) -> Option<Volume> {
    file(name).map(|path| read(&path, None).unwrap_or_else(|e| panic!("{e}")))
}

#[test]
fn all_of_the_table() {
    for (name, dims, voxel_type, spacing, [lo, hi]) in TABLE {
        let Some(volume) = load(name) else { continue };
        assert_eq!((volume.dims(), volume.voxels().voxel_type()), (dims, voxel_type), "{name}");
        for (got, want) in volume.grid().spacing().into_iter().zip(spacing) {
            // The table has four decimals, the headers are f32.
            assert!((got - want).abs() <= 5e-5 * want.max(1.0), "{name}: {got}, {want}");
        }
        let [a, b] = volume.range().map(|v| (v - volume.intercept()) / volume.slope());
        assert!((a - lo).abs() <= 5e-5 && (b - hi).abs() <= 5e-5, "{name}: {a} … {b}");
        assert!(volume.mask().is_none(), "{name}");
    }
}

#[test]
fn slopes() {
    if let Some(head) = load("mri_head.nii.gz") {
        assert!((head.slope() - 2.0078).abs() < 5e-5 && head.intercept() == 0.0, "{}", head.slope());
        assert!((head.range()[1] - 512.0).abs() < 0.01, "{:?}", head.range());
    }
    if let Some(brain) = load("mni152_2009_t1_brain.nii.gz") {
        assert_eq!((brain.slope(), brain.intercept()), (1.0, 0.0));
    }
}

#[test]
fn directions() {
    let ras = Some(Anatomy::RightAnteriorSuperior);
    // Signs of the diagonal: which way each axis runs in RAS.
    for (name, signs) in [
        ("aorta_cta.nii.gz", [-1.0, -1.0, 1.0]),
        ("dti_fa.nii.gz", [-1.0, 1.0, 1.0]),
        ("abdomen_ct.nii.gz", [1.0, 1.0, 1.0]),
    ] {
        let Some(volume) = load(name) else { continue };
        let axes = volume.grid().axes().to_cols_array_2d();
        for a in 0..3 {
            let off: f64 = (0..3).filter(|&b| b != a).map(|b| axes[a][b].abs()).sum();
            assert!(axes[a][a] * signs[a] > 10.0 * off, "{name}: {axes:?}");
        }
        assert_eq!(volume.anatomy(), ras, "{name}");
    }
    if let Some(brain) = load("flair_brain.nrrd") {
        assert_eq!(brain.anatomy(), Some(Anatomy::LeftPosteriorSuperior));
        assert_eq!(brain.grid().axes().y_axis.y, -0.950_936_651_390_412_3);
        assert_eq!(brain.grid().origin().x, 64.898_239_135_742_2);
    }
}

#[test]
fn left_and_right_of_a_big_endian_file() {
    let Some(head) = load("avg152T1_RL_bigendian.nii.gz") else { return };
    let grid = head.grid();
    assert_eq!(grid.axes(), DMat3::from_diagonal(DVec3::splat(2.0)));
    assert_eq!(grid.origin(), DVec3::new(-90.0, -126.0, -72.0));
    assert_eq!(head.anatomy(), Some(Anatomy::RightAnteriorSuperior));
    // The letters, burnt in as 255 in every slice: the one on the subject's left, at world x < 0, is an L, a stem of
    // six voxels over a foot; the one on the right is an R, wide at its top.
    let ink = |side: f64, y: usize| {
        let here = |&x: &usize| side * grid.to_world(DVec3::new(x as f64, y as f64, 0.0)).x > 0.0;
        (0..91).filter(here).filter(|&x| head.value([x, y, 0]) >= 250.0).count()
    };
    assert_eq!([ink(-1.0, 65), ink(-1.0, 38)], [6, 26]);
    assert_eq!([ink(1.0, 65), ink(1.0, 38)], [23, 13]);
}

#[test]
fn a_label_volume_lies_on_the_grid_of_its_volume() {
    for (volume, labels) in [
        ("abdomen_ct.nii.gz", "abdomen_ct_labels.nii.gz"),
        ("aorta_cta.nii.gz", "aorta_cta_label.nii.gz"),
        ("inia19_t1_brain.nii.gz", "inia19_labels.nii.gz"),
    ] {
        let (Some(a), Some(b)) = (load(volume), load(labels)) else { continue };
        let (a, b) = (a.grid(), b.grid());
        assert_eq!(a.dims(), b.dims());
        assert!((a.origin() - b.origin()).length() < 1e-3, "{volume}: {:?}, {:?}", a.origin(), b.origin());
        assert!(a.axes().abs_diff_eq(b.axes(), 1e-5), "{volume}: {:?}, {:?}", a.axes(), b.axes());
    }
}

#[test]
fn a_shared_volume_cut_short_is_an_error() {
    let Some(path) = file("fuel.nhdr") else { return };
    let folder = Folder::new();
    let data = std::fs::read(path.with_file_name("fuel.raw.gz")).unwrap();
    folder.put("fuel.raw.gz", &data[..data.len() / 2]);
    let header = std::fs::read(Path::new(&path)).unwrap();
    let error = folder.read("fuel.nhdr", header).unwrap_err();
    assert!(error.what().contains("bytes, expected 262144"), "{error}");
}
