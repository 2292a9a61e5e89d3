//! The further forms that the formats allow: parts of files, several files, extra axes, notes.

use super::super::{Fault, is_volume};
use super::*;
use std::path::Path;

const U8: VoxelType = VoxelType::U8;

fn twelve() -> Vec<u8> {
    (1..=12).collect()
}

fn voxels(volume: &Volume) -> Vec<u8> {
    bytes_of(volume.voxels(), false)
}

#[test]
fn nrrd_skips_lines_and_bytes() {
    let folder = Folder::new();
    let data = joined("one\ntwo\n..", &twelve());
    folder.put("a.raw", &data);
    let header = |more: &str| nrrd_lines(U8, "2 3 2", "raw", false) + "data file: a.raw\n" + more;
    let volume = folder.read("a.nhdr", header("line skip: 2\nbyte skip: 2\n")).unwrap();
    assert_eq!(voxels(&volume), twelve());
    let volume = folder.read("a.nhdr", header("byteskip: 10\n")).unwrap();
    assert_eq!(voxels(&volume), twelve());
    let volume = folder.read("a.nhdr", header("byte skip: -1\n")).unwrap();
    assert_eq!(voxels(&volume), twelve());
    // Lines are skipped before decompression, bytes behind it.
    folder.put("a.gz", joined("a line\n", &gzip(&joined("..", &twelve()))));
    let header = nrrd_lines(U8, "2 3 2", "gzip", false) + "line skip: 1\nbyte skip: 2\ndatafile: a.gz\n";
    assert_eq!(voxels(&folder.read("a.nhdr", header).unwrap()), twelve());
    let text = nrrd_lines(U8, "2 3 2", "text", false) + "line skip: 1\nbyte skip: 3\ndata file: a.txt\n";
    folder.put("a.txt", "a line\n99 1 2 3 4 5 6 7 8 9 10 11 12");
    assert_eq!(voxels(&folder.read("a.nhdr", text).unwrap()), twelve());
}

#[test]
fn nrrd_in_several_files() {
    let folder = Folder::new();
    for (i, slice) in twelve().chunks(6).enumerate() {
        folder.put(&format!("s{:02}.raw", 3 * i), slice);
    }
    for (i, row) in twelve().chunks(2).enumerate() {
        folder.put(&format!("row {i}"), joined("x", row));
    }
    let lines = nrrd_lines(U8, "2 3 2", "raw", false);
    for data_file in [
        "data file: s%02d.raw 0 3 3\n",
        "data file: s%02d.raw 0 3 3 2\n",
        "data file: s%02d.raw 0 3 3 3\n",
        "data file: LIST\ns00.raw\ns03.raw\n",
        "data file: LIST 3\ns00.raw\n\ns03.raw",
        "byte skip: 1\ndata file: LIST 1\nrow 0\nrow 1\nrow 2\nrow 3\nrow 4\nrow 5\n",
    ] {
        let volume = folder.read("a.nhdr", lines.clone() + data_file).unwrap();
        assert_eq!(voxels(&volume), twelve(), "{data_file}");
    }
    for (data_file, what) in [
        ("data file: LIST\ns00.raw\n", "found 1 data files, expected one for each of the [2] slices"),
        (
            "data file: LIST 3\ns00.raw\ns03.raw\ns00.raw\ns03.raw\ns00.raw\n",
            "12 voxels cannot be shared out evenly over 5 data files",
        ),
        ("data file: LIST 0\ns00.raw\n", "found `LIST 0`, expected a number of axes at the end"),
        ("data file: s%02d.raw 0 x 3\n", "found `s%02d.raw 0 x 3`, expected a name, first, last and step"),
    ] {
        assert_eq!(folder.read("a.nhdr", lines.clone() + data_file).unwrap_err().what(), what);
    }
    let missing = folder.read("a.nhdr", lines + "data file: s%02d.raw 0 6 3\n").unwrap_err();
    assert!(missing.file.ends_with("s06.raw") && matches!(*missing.fault, Fault::Io(_)));
}

#[test]
fn metaimage_in_several_files() {
    let folder = Folder::new();
    for (i, slice) in twelve().chunks(6).enumerate() {
        folder.put(&format!("s{}.raw", 1 + 2 * i), joined("head", slice));
    }
    for data_file in [
        "HeaderSize = 4\nElementDataFile = s%d.raw 1 3 2\n",
        "HeaderSize = 4\nElementDataFile = s%d.raw 1 3\n",
        "HeaderSize = -1\nElementDataFile = LIST\ns1.raw\ns3.raw\n",
        "HeaderSize = 4\nElementDataFile = LIST 2D\ns1.raw\ns3.raw\n",
    ] {
        let volume = folder.read("a.mhd", meta_lines(U8, "2 3 2", data_file)).unwrap();
        assert_eq!(voxels(&volume), twelve(), "{data_file}");
    }
    std::fs::rename(folder.path("s3.raw"), folder.path("s2.raw")).unwrap();
    for data_file in ["HeaderSize = 4\nElementDataFile = s%d.raw\n", "HeaderSize = 4\nElementDataFile = s%d.raw 1\n"] {
        let volume = folder.read("a.mhd", meta_lines(U8, "2 3 2", data_file)).unwrap();
        assert_eq!(voxels(&volume), twelve(), "{data_file}");
    }
}

#[test]
fn metaimage_notes_and_compressed_size() {
    let folder = Folder::new();
    let data = zlib(&twelve());
    let lines = |size: usize| {
        let more =
            format!("Comment = a = b\nModality = MET_MOD_CT\nCompressedData = True\nCompressedDataSize = {size}\n");
        joined(meta_lines(U8, "2 3 2 1", &(more + "ElementDataFile = LOCAL\n")), &data)
    };
    assert_eq!(voxels(&folder.read("a.mha", lines(data.len())).unwrap()), twelve());
    assert_eq!(voxels(&folder.read("a.mha", lines(0)).unwrap()), twelve());
    let error = folder.read("a.mha", lines(data.len() + 1)).unwrap_err();
    assert!(matches!(*error.fault, Fault::Short { .. }) && error.field.as_deref() == Some("CompressedDataSize"));
    let error = folder.read("a.mha", joined(lines(0), b"x")).unwrap_err();
    assert!(matches!(*error.fault, Fault::Damaged(_)), "{error}");
}

#[test]
fn extra_axes_of_length_one() {
    let folder = Folder::new();
    let nrrd = |sizes: &str, more: &str| nrrd_lines(U8, sizes, "raw", false) + more + "\n";
    for (sizes, more) in [
        ("1 2 3 2", "kinds: scalar domain domain domain\nspacings: NaN 1 2 3\n"),
        ("1 2 3 2", "space: LPS\nspace directions: none (1,0,0) (0,2,0) (0, 0, 3)\n"),
        ("2 3 2 1", "spacings: 1 2 3 4\n"),
        ("2 3 1 2", "kinds: space space list space\nspacings: 1 2 4 3\n"),
    ] {
        let volume = folder.read("a.nrrd", joined(nrrd(sizes, more), &twelve())).unwrap();
        assert_eq!((volume.dims(), volume.grid().spacing()), ([2, 3, 2], [1.0, 2.0, 3.0]), "{sizes} {more}");
        assert_eq!(voxels(&volume), twelve());
    }
    let series = Nifti::one(U8, &[2, 3, 2, 1, 1], false);
    assert_eq!(voxels(&folder.read("a.nii", series.with(&twelve())).unwrap()), twelve());
    let flat = Nifti::one(U8, &[4, 3], false);
    assert_eq!(folder.read("a.nii", flat.with(&twelve())).unwrap().dims(), [4, 3, 1]);
}

#[test]
fn what_is_not_one_number_a_voxel_says_what_it_is() {
    let folder = Folder::new();
    let nrrd = |sizes: &str, more: &str| joined(nrrd_lines(U8, sizes, "raw", false) + more + "\n", &[0; 24]);
    let meta = |sizes: &str, more: &str| {
        joined(meta_lines(U8, sizes, &(more.to_string() + "ElementDataFile = LOCAL\n")), &[0; 24])
    };
    let mut colour = Nifti::one(U8, &[2, 2, 2], false);
    colour.i16(70, 128).i16(72, 24);
    for (name, file, what) in [
        (
            "a.nrrd",
            nrrd("3 2 2 2", "kinds: RGB-color domain domain domain\n"),
            "axis 0 with 3 samples of kind RGB-color",
        ),
        (
            "a.nrrd",
            nrrd("3 2 2 2", "space dimension: 3\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n"),
            "axis 0 with 3 components a voxel",
        ),
        ("a.nrrd", nrrd("2 2 2 3", ""), "4 axes with more than one sample"),
        ("a.nrrd", nrrd("12 2", ""), "data with 2 axes"),
        ("a.nrrd", nrrd("2 2 2 3", "kinds: domain domain domain time\n"), "axis 3 with 3 samples of kind time"),
        ("a.mha", meta("2 2 2", "ElementNumberOfChannels = 3\n"), "3 channels a voxel"),
        ("a.mha", meta("2 2 2 3", ""), "axis 3 with 3 samples"),
        ("a.nii", Nifti::one(U8, &[2, 2, 2, 3], false).with(&[0; 24]), "a series of 3 volumes"),
        ("a.nii", Nifti::one(U8, &[2, 2, 2, 1, 3], false).with(&[0; 24]), "3 components a voxel"),
        ("a.nii", colour.with(&[0; 24]), "colours, RGB"),
    ] {
        let error = folder.read(name, file).unwrap_err();
        assert!(matches!(*error.fault, Fault::Unsupported { .. }), "{error}");
        assert!(error.what().starts_with(&format!("{what}; supported: ")), "{error}");
        assert!(error.field.is_some(), "{error}");
    }
}

#[test]
fn nrrd_keys_comments_and_line_ends() {
    let folder = Folder::new();
    let header = "NRRD0005\r\n# c\r\nTYPE: UCHAR\r\nkey:=value: x\r\nDimension: 3\r\nsizes: 2 3 2\r\ncentering s: cell cell cell\r\nencoding: RAW\r\n\r\n";
    assert_eq!(voxels(&folder.read("a.nrrd", joined(header, &twelve())).unwrap()), twelve());
}

#[test]
fn slope_and_intercept() {
    let folder = Folder::new();
    for (slope, intercept, want) in
        [(2.5, -10.0, [-7.5, 20.0]), (-1.0, 0.0, [-12.0, -1.0]), (0.0, 5.0, [1.0, 12.0]), (f32::NAN, 5.0, [1.0, 12.0])]
    {
        let mut header = Nifti::one(U8, &[2, 3, 2], true);
        header.f32(112, slope).f32(116, intercept);
        assert_eq!(folder.read("a.nii", header.with(&twelve())).unwrap().range(), want, "{slope}");
    }
    let mut header = Nifti::two(U8, &[2, 3, 2], true);
    header.f64(176, 0.1).f64(184, 1.0);
    assert_eq!(folder.read("a.nii", header.with(&twelve())).unwrap().range()[0], 0.1 + 1.0);
    header.f64(184, f64::INFINITY);
    let error = folder.read("a.nii", header.with(&twelve())).unwrap_err();
    assert_eq!(error.field.as_deref(), Some("slope and intercept"));
    let meta = "ElementToIntensityFunctionSlope = 2\nElementToIntensityFunctionOffset = -1\nElementDataFile = LOCAL\n";
    let volume = folder.read("a.mha", joined(meta_lines(U8, "2 3 2", meta), &twelve())).unwrap();
    assert_eq!(volume.range(), [1.0, 23.0]);
}

#[test]
fn voxels_that_are_not_finite_are_counted_and_filled() {
    let folder = Folder::new();
    let mut stored = [1.5f32; 12];
    stored[3] = f32::NAN;
    stored[7] = f32::NEG_INFINITY;
    let data: Vec<u8> = stored.iter().flat_map(|x| x.to_be_bytes()).collect();
    let volume = folder.read("a.nii", Nifti::one(VoxelType::F32, &[2, 3, 2], true).with(&data)).unwrap();
    assert_eq!(volume.mask().unwrap().count(), 2);
    assert_eq!(volume.range(), [1.5, 1.5]);
    assert!(volume.mask().unwrap().voxel([1, 1, 0]) && volume.mask().unwrap().voxel([1, 0, 1]));
}

#[test]
fn suffixes() {
    for (path, yes) in [
        ("head.nrrd", true),
        ("head.NII.GZ", true),
        ("a/b.c.mha", true),
        ("x.raw.gz", true),
        ("scene.toml", false),
        ("nrrd", false),
        (".nii", true),
        ("x.gz", false),
        ("", false),
    ] {
        assert_eq!(is_volume(Path::new(path)), yes, "{path}");
    }
    let folder = Folder::new();
    let file = folder.put("x.vol", [0; 8]);
    assert!(!is_volume(&file));
    folder.put("x.vol.toml", "size = [2, 2, 2]\ntype = \"u8\"\n");
    assert!(is_volume(&file));
    assert_eq!(read(&file, None).unwrap().dims(), [2, 2, 2]);
}
