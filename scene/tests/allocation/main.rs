//! Headers that claim far more than their file holds: memory follows the file, not the claim ([IO-1]).
//!
use drypoint_scene::tables::RawLayout;
use drypoint_scene::volume::VoxelType;
use drypoint_scene::volume::read::read;
use std::io::Write;

/// Buffers of readers and decoders, whatever the file.
const FIXED: u64 = 1 << 20;

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::none());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn nrrd(sizes: &str, encoding: &str, data: &[u8]) -> Vec<u8> {
    let header =
        format!("NRRD0004\ntype: double\ndimension: 3\nsizes: {sizes}\nendian: little\nencoding: {encoding}\n\n");
    [header.as_bytes(), data].concat()
}

fn nifti(dims: [i16; 3], data: &[u8]) -> Vec<u8> {
    let mut bytes = vec![0u8; 352];
    bytes[..4].copy_from_slice(&348i32.to_le_bytes());
    for (i, n) in [3, dims[0], dims[1], dims[2]].into_iter().enumerate() {
        bytes[40 + 2 * i..42 + 2 * i].copy_from_slice(&n.to_le_bytes());
        bytes[76 + 4 * i..80 + 4 * i].copy_from_slice(&1f32.to_le_bytes());
    }
    bytes[70..72].copy_from_slice(&64i16.to_le_bytes());
    bytes[72..74].copy_from_slice(&64i16.to_le_bytes());
    bytes[108..112].copy_from_slice(&352f32.to_le_bytes());
    bytes[344..348].copy_from_slice(b"n+1\0");
    [&bytes, data].concat()
}

#[test]
fn memory_follows_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let meta = |encoding: &str, data: &[u8]| {
        let header = format!(
            "ObjectType = Image\nNDims = 3\nDimSize = 10000 10000 10000\nElementType = MET_DOUBLE\n{encoding}\n\
             ElementDataFile = LOCAL\n"
        );
        [header.as_bytes(), data].concat()
    };
    let million = vec![7u8; 1_000_000];
    let text = "1 ".repeat(500_000);
    let cases: Vec<(&str, Vec<u8>)> = vec![
        ("a.nrrd", nrrd("10000 10000 10000", "raw", &[0; 100])),
        ("a.nrrd", nrrd("10000 10000 10000", "gzip", &gzip(&[0; 100]))),
        ("a.nrrd", nrrd("10000 10000 10000", "ascii", b"1 2 3")),
        // Within DEFLATE's limit (a gigabyte), but only a megabyte arrives.
        ("a.nrrd", nrrd("500 500 500", "gzip", &gzip(&million))),
        ("a.nrrd", nrrd("500000 1 1", "ascii", &text.as_bytes()[..999_990])),
        ("a.nii", nifti([32767; 3], &[0; 100])),
        ("a.nii.gz", gzip(&nifti([32767; 3], &[0; 100]))),
        ("a.nii.gz", gzip(&nifti([500; 3], &million))),
        ("a.mha", meta("BinaryData = True", &[0; 100])),
        ("a.mha", meta("CompressedData = True", &[0x78, 0x9c, 0, 0])),
        ("a.mha", meta("BinaryData = False", b"1 2 3")),
        ("a.nrrd", [b"NRRD0004\n# ".to_vec(), million.clone()].concat()),
        ("a.nhdr", b"NRRD0004\ntype: uchar\ndimension: 3\nsizes: 9 9 1000000000\nencoding: raw\ndata file: a%0999999999d.raw 0 999999999 1\n".to_vec()),
        ("a.nhdr", b"NRRD0004\ntype: uchar\ndimension: 3\nsizes: 9 9 1000000000\nencoding: raw\ndata file: a%d.raw 0 999999999 1\n".to_vec()),
        ("a.nhdr", b"NRRD0004\ntype: uchar\ndimension: 9999999999\nsizes: 9 9 9\nencoding: raw\n".to_vec()),
    ];
    for (i, (name, bytes)) in cases.iter().enumerate() {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let used = allocation_counter::measure(|| assert!(read(&path, None).is_err(), "case {i}")).bytes_max;
        // A text of n bytes may be n / 2 numbers of eight bytes; growing copies from the old half to the new whole.
        let allowed = FIXED + 12 * bytes.len() as u64;
        assert!(used <= allowed, "case {i}, {name} of {} bytes: {used} bytes asked for", bytes.len());
    }
    let path = folder.path().join("a.bin");
    std::fs::write(&path, [0; 100]).unwrap();
    let layout = RawLayout {
        size: [1 << 20, 1 << 20, 1 << 20],
        voxel_type: VoxelType::F64,
        big_endian: false,
        spacing: [1.0; 3],
        skip: 0,
    };
    let used = allocation_counter::measure(|| assert!(read(&path, Some(&layout)).is_err())).bytes_max;
    assert!(used <= FIXED, "{used}");
}
