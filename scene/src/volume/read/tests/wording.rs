//! The words of the main errors, all three lines of them.

use super::*;
use crate::tables::RawLayout;

const U8: VoxelType = VoxelType::U8;

/// The three lines, with the test's folder left out.
fn lines(folder: &Folder, result: Result<Volume, ReadError>) -> [String; 3] {
    let error = result.unwrap_err();
    let text = error.to_string().replace(&format!("{}/", folder.0.path().display()), "");
    let lines: Vec<String> = text.lines().map(String::from).collect();
    assert_eq!(error.to_string(), [error.what(), error.place(), error.remedy()].join("\n"));
    lines.try_into().unwrap_or_else(|_| panic!("not three lines: {text}"))
}

const AGAIN: &str = "get the file again, or correct the sizes and the type in the header";

#[test]
fn truncated() {
    let folder = Folder::new();
    let header = |encoding| nrrd_lines(U8, "2 3 2", encoding, false) + "\n";
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", joined(header("raw"), &[0; 11]))),
        ["the data are too short: found 11 bytes, expected 12", "head.nrrd, field sizes", AGAIN]
    );
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", joined(header("gzip"), &gzip(&[0; 11])))),
        ["the data are too short: found 11 bytes, expected 12", "head.nrrd, field sizes", AGAIN]
    );
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", joined(header("bzip2"), &bzip2(&[0; 11])))),
        ["the data are too short: found 11 bytes, expected 12", "head.nrrd, field sizes", AGAIN]
    );
    for (encoding, whole) in [("gzip", gzip(&[0; 12])), ("bzip2", bzip2(&[0; 12]))] {
        assert_eq!(
            lines(&folder, folder.read("head.nrrd", joined(header(encoding), &whole[..whole.len() - 1]))),
            [
                "the compressed data are damaged: the stream ends too early, or something follows it",
                "head.nrrd",
                "get the file again"
            ]
        );
    }
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", joined(header("ascii"), b"1 2 3 4 5 6 7 8 9 10 11   "))),
        ["the data are too short: found 11 numbers, expected 12", "head.nrrd, field sizes", AGAIN]
    );
    folder.put("head.raw", [0; 5]);
    let detached = nrrd_lines(U8, "2 3 2", "raw", false) + "data file: head.raw\n";
    assert_eq!(
        lines(&folder, folder.read("head.nhdr", detached)),
        ["the data are too short: found 5 bytes, expected 12", "head.raw, field sizes of head.nhdr", AGAIN]
    );
    let header = Nifti::one(U8, &[2, 3, 2], true);
    assert_eq!(
        lines(&folder, folder.read("head.nii", header.with(&[0; 3]))),
        ["the data are too short: found 3 bytes, expected 12", "head.nii, field dim", AGAIN]
    );
    assert_eq!(
        lines(&folder, folder.read("head.nii", &header.bytes[..300])),
        ["the data are too short: found 300 bytes of the header, expected 348", "head.nii", AGAIN]
    );
}

#[test]
fn trailing_bytes() {
    let folder = Folder::new();
    let header = |encoding| nrrd_lines(U8, "2 3 2", encoding, false) + "\n";
    for (encoding, data) in [("raw", vec![0; 15]), ("gzip", gzip(&[0; 15])), ("bzip2", bzip2(&[0; 15]))] {
        assert_eq!(
            lines(&folder, folder.read("head.nrrd", joined(header(encoding), &data))),
            ["the data are too long: found 15 bytes, expected 12", "head.nrrd, field sizes", AGAIN]
        );
    }
    // Counting stops behind 2²⁴ bytes too many, at the end of a step of 2¹⁶.
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", joined(header("gzip"), &gzip(&vec![0; 20_000_000])))),
        ["the data are too long: found at least 16842764 bytes, expected 12", "head.nrrd, field sizes", AGAIN]
    );
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", joined(header("ascii"), b"1 2 3 4 5 6 7 8 9 10 11 12 13"))),
        ["the data are too long: found 13 numbers, expected 12", "head.nrrd, field sizes", AGAIN]
    );
    for (encoding, data) in [("gzip", gzip(&[0; 12])), ("bzip2", bzip2(&[0; 12]))] {
        let after = joined(header(encoding), &joined(data, b"junk"));
        let [what, place, _] = lines(&folder, folder.read("head.nrrd", after));
        assert!(what.starts_with("the compressed data are damaged: ") && place == "head.nrrd", "{what}");
    }
}

#[test]
fn oversized_dims() {
    let folder = Folder::new();
    let header = |sizes, encoding| nrrd_lines(U8, sizes, encoding, false) + "\n";
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", joined(header("10000 10000 10000", "raw"), &[0; 12]))),
        ["the data are too short: found 12 bytes, expected 1000000000000", "head.nrrd, field sizes", AGAIN]
    );
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", joined(header("10000 10000 10000", "gzip"), &[0; 100]))),
        [
            "the sizes claim 1000000000000 bytes, but a file of this length holds at most 103200",
            "head.nrrd, field sizes",
            AGAIN
        ]
    );
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", joined(header("10000 10000 10000", "bzip2"), &[0; 100]))),
        [
            "the sizes claim 1000000000000 bytes, but a file of this length holds at most 194250000",
            "head.nrrd, field sizes",
            AGAIN
        ]
    );
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", joined(header("4294967296 4294967296 2", "raw"), &[0; 12]))),
        [
            "dims [4294967296, 4294967296, 2] overflow",
            "head.nrrd, line 5, field sizes",
            "correct the sizes or the axis directions in the header"
        ]
    );
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", joined(header("4294967296 2 18446744073709551616", "raw"), &[0; 12]))),
        [
            "found `4294967296 2 18446744073709551616`, expected 3 whole numbers, one for each axis",
            "head.nrrd, line 5, field sizes",
            "correct the header"
        ]
    );
    assert_eq!(
        lines(&folder, folder.read("head.nii", Nifti::one(VoxelType::F64, &[32767; 3], true).with(&[0; 8]))),
        ["the data are too short: found 8 bytes, expected 281449207693304", "head.nii, field dim", AGAIN]
    );
    let layout =
        RawLayout { size: [1 << 40, 1 << 20, 1], voxel_type: U8, big_endian: false, spacing: [1.0; 3], skip: 0 };
    assert_eq!(
        lines(&folder, read(&folder.put("head.raw", [0; 8]), Some(&layout))),
        [
            "the data are too short: found 8 bytes, expected 1152921504606846976",
            "head.raw, field size of its layout",
            "get the file again, or correct the sizes and the type in the layout"
        ]
    );
}

#[test]
fn wrong_magic() {
    let folder = Folder::new();
    let suffix = "check that the suffix says what the file holds";
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", b"\x1f\x8b\x08picture")),
        ["this is not an NRRD file: it begins with `\\u{1f}�\\u{8}pictu`, expected NRRD000", "head.nrrd", suffix]
    );
    assert_eq!(
        lines(&folder, folder.read("head.nii", b"NRRD0004\ntype: uchar\n")),
        [
            "this is not a NIfTI file: it begins with `NRRD0004`, expected the length of its header, 348 or 540",
            "head.nii, field sizeof_hdr",
            suffix
        ]
    );
    let mut header = Nifti::one(U8, &[2, 3, 2], false);
    header.bytes[344..348].copy_from_slice(b"abcd");
    assert_eq!(
        lines(&folder, folder.read("head.nii", header.with(&[0; 12]))),
        ["found `abcd`, expected `n+1`, `ni1`, `n+2` or `ni2`", "head.nii, field magic", "correct the header"]
    );
    assert_eq!(
        lines(&folder, folder.read("head.mhd", "NRRD0004\ntype: uchar\n")),
        [
            "this is not a MetaImage file: it begins with `NRRD0004`, expected `ObjectType = Image`",
            "head.mhd, line 1",
            suffix
        ]
    );
}

#[test]
fn headers_that_say_the_wrong_thing() {
    let folder = Folder::new();
    let nrrd = |lines: &str| folder.read("head.nrrd", format!("NRRD0004\n{lines}\n").as_bytes());
    assert_eq!(
        lines(&folder, nrrd("type: uint24\n")),
        [
            "found `uint24`, expected a numeric type such as uint8, short or float",
            "head.nrrd, line 2, field type",
            "correct the header"
        ]
    );
    assert_eq!(
        lines(&folder, nrrd("type: short\nencoding: raw\n")),
        ["the field is missing, expected little or big", "head.nrrd, field endian", "add the field to the header"]
    );
    let whole = nrrd_lines(U8, "2 3 2", "raw", false);
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", whole)),
        [
            "the field is missing, expected a blank line with the data behind it, or the name of their file",
            "head.nrrd, field data file",
            "add the field to the header"
        ]
    );
    assert_eq!(
        lines(&folder, nrrd("type: short\ntype: short\n")),
        ["the field is given a second time", "head.nrrd, line 3, field type", "keep one of the two"]
    );
    assert_eq!(
        lines(&folder, nrrd("type: short\nspace direction: (1,0,0)\n")),
        [
            "the format has no such field",
            "head.nrrd, line 3, field `space direction`",
            "correct its name, or make it a key with := in place of the colon"
        ]
    );
    assert_eq!(
        lines(&folder, nrrd("type uchar\n")),
        ["the line `type uchar` is not a field", "head.nrrd, line 2", "correct the header"]
    );
    assert_eq!(
        lines(&folder, nrrd("type: uchar\nencoding: hex\n")),
        [
            "data in encoding `hex`; supported: raw, gzip, bzip2 and ascii",
            "head.nrrd, line 3, field encoding",
            "convert the file first"
        ]
    );
    let header = nrrd_lines(U8, "2 3 2", "ascii", false) + "\n";
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", joined(header, b"1 2 3\n4 5 256 7 8 9 10 11 12"))),
        ["found `256`, expected a number of type u8", "head.nrrd, line 10", "correct the header"]
    );
}

#[test]
fn voxels_without_a_finite_value() {
    let folder = Folder::new();
    let data: Vec<u8> = [f32::NAN, f32::INFINITY].repeat(6).iter().flat_map(|x| x.to_le_bytes()).collect();
    let header = nrrd_lines(VoxelType::F32, "2 3 2", "raw", false) + "\n";
    assert_eq!(
        lines(&folder, folder.read("head.nrrd", joined(header, &data))),
        ["no voxel has a finite value", "head.nrrd", "give a volume with at least one finite value"]
    );
}

#[test]
fn files_that_are_not_there_or_not_known() {
    let folder = Folder::new();
    let [what, place, remedy] = lines(&folder, read(&folder.path("head.nrrd"), None));
    assert!(what.starts_with("the file cannot be read: "), "{what}");
    assert_eq!([place.as_str(), remedy.as_str()], ["head.nrrd", "check the path"]);
    assert_eq!(
        lines(&folder, folder.read("head.jpg", [0; 12])),
        [
            "the suffix is not that of a supported volume format",
            "head.jpg",
            "give a file with one of the suffixes nrrd, nhdr, nii, nii.gz, hdr, hdr.gz, img, img.gz, mhd, mha, raw, \
             raw.gz, or describe raw voxels in head.jpg.toml, with --raw or as volume.raw"
        ]
    );
    assert_eq!(
        lines(&folder, folder.read("head.raw", [0; 12])),
        [
            "raw voxels without a description of their layout",
            "head.raw",
            "open the header that belongs to it, or describe it in head.raw.toml, with --raw or as volume.raw: size, \
             type, endian, spacing and skip"
        ]
    );
    std::fs::create_dir(folder.path("x.nrrd")).unwrap();
    assert_eq!(
        lines(&folder, read(&folder.path("x.nrrd"), None)),
        ["this is not a regular file", "x.nrrd", "give a file that may be read"]
    );
    let mut pair = Nifti::one(U8, &[2, 3, 2], false);
    pair.bytes[344..348].copy_from_slice(b"ni1\0");
    assert_eq!(lines(&folder, folder.read("half.hdr", pair.bytes))[1], "half.img");
    let detached = nrrd_lines(U8, "2 3 2", "raw", false) + "data file: gone.raw\n";
    assert_eq!(lines(&folder, folder.read("a.nhdr", detached))[1], "gone.raw");
}

#[test]
fn sidecars() {
    let folder = Folder::new();
    folder.put("a.raw", [0; 12]);
    let described = |text: &str| {
        folder.put("a.raw.toml", text);
        lines(&folder, read(&folder.path("a.raw"), None))
    };
    let [what, place, remedy] = described("size = [2, 3, 2]\ntype = \"u8\"\nskipp = 1\n");
    assert!(what.starts_with("the description of raw voxels is not valid: unknown field `skipp`"), "{what}");
    assert_eq!([place.as_str(), remedy.as_str()], ["a.raw.toml, line 3", "correct the layout"]);
    assert_eq!(
        described("size = [2, 3, 2]\ntype = \"byte\"\n"),
        [
            "found `byte`, expected one of u8, i8, u16, i16, u32, i32, u64, i64, f32, f64",
            "a.raw.toml, field type",
            "correct the layout"
        ]
    );
    assert_eq!(
        described("size = [2, 3, 3]\ntype = \"u8\"\n"),
        [
            "the data are too short: found 12 bytes, expected 18",
            "a.raw, field size of a.raw.toml",
            "get the file again, or correct the sizes and the type in the layout"
        ]
    );
    assert_eq!(
        described("size = [2, 3, 2]\ntype = \"u8\"\nspacing = [1, 0, 1]\n")[1..],
        ["a.raw.toml, field spacing", "correct the sizes or the spacing in the layout"]
    );
}

#[test]
fn dicom() {
    let folder = Folder::new();
    let mut preamble = vec![0; 128];
    preamble.extend(b"DICM and more");
    for (name, bytes) in
        [("a.dcm", &b"old"[..]), ("b.DICOM", b""), ("IM0001", &preamble), ("c.nii", &preamble), ("d.raw", &preamble)]
    {
        assert_eq!(
            lines(&folder, folder.read(name, bytes)),
            [
                "this is a DICOM file, and DICOM is not read yet",
                name,
                "convert its series to .nii.gz or .nrrd first: dcm2niix, 3D Slicer and ITK-SNAP do that"
            ]
        );
    }
    assert_eq!(lines(&folder, read(&folder.path("gone.dcm"), None))[2], "check the path");
    preamble[130] = b'X';
    let other = folder.read("IM0002", &preamble).unwrap_err();
    assert!(matches!(*other.fault, super::super::Fault::Suffix), "{other}");
    // A folder says how to convert what is in it. Folders in it are not looked into.
    for (name, file) in [("series", "IM0001"), ("suffix", "1.dcm")] {
        std::fs::create_dir_all(folder.path(name).join("more")).unwrap();
        preamble[130] = b'C';
        std::fs::write(folder.path(name).join(file), &preamble).unwrap();
        let [what, place, remedy] = lines(&folder, read(&folder.path(name), None));
        assert_eq!([what, place], ["this is a folder of DICOM files, and DICOM is not read yet", name]);
        assert!(remedy.starts_with("convert its series to .nii.gz or .nrrd first, such as with dcm2niix -z y -o . "));
        assert!(remedy.ends_with(&format!("{name}; 3D Slicer and ITK-SNAP do that, too")), "{remedy}");
    }
    std::fs::create_dir(folder.path("empty")).unwrap();
    assert_eq!(lines(&folder, read(&folder.path("empty"), None))[2], "give a file that may be read");
    // A layout that is given wins over the mark.
    let layout = RawLayout { size: [141, 1, 1], voxel_type: U8, big_endian: false, spacing: [1.0; 3], skip: 0 };
    assert!(read(&folder.path("c.nii"), Some(&layout)).is_ok());
}
