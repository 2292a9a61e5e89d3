//! Files that are what they claim, and more than the memory budget has room for: an error that says so. The budget is one
//! for the whole process, so this test has a process of its own.

use drypoint_scene::memory;
use drypoint_scene::phantom::generate;
use drypoint_scene::style::{PictureFault, SourcePicture, Style};
use drypoint_scene::tables::PhantomSource;
use drypoint_scene::volume::VoxelType;
use drypoint_scene::volume::read::{Fault, read};
use image::{GrayImage, ImageFormat};
use std::io::{Cursor, Write};

/// Bytes of the budget.
const BUDGET: u64 = 128 << 20;

/// One after another: what one of them holds would count against the others.
#[test]
fn more_than_the_budget_is_refused() {
    memory::limit(BUDGET);
    compressed_volume();
    phantom();
    pictures();
}

fn compressed_volume() {
    let mut file = b"NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1024 512 512\nencoding: gzip\n\n".to_vec();
    let mut encoder = flate2::write::GzEncoder::new(&mut file, flate2::Compression::fast());
    let slice = vec![0; 1024 * 512];
    for _ in 0..512 {
        encoder.write_all(&slice).unwrap();
    }
    encoder.finish().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("zeros.nrrd");
    std::fs::write(&path, file).unwrap();
    let error = read(&path, None).unwrap_err();
    assert!(matches!(*error.fault, Fault::Memory { voxels: 268_435_456, .. }), "{error}");
    assert!(error.what().starts_with("268435456 voxels need 0.25 GiB of memory, and 0."), "{error}");
}

fn phantom() {
    let (size, spacing, voxel_type) = ([600; 3], [1.0; 3], VoxelType::U8);
    let source = PhantomSource { name: "sphere".into(), size, spacing, voxel_type, params: Vec::new() };
    let error = generate(&source).unwrap_err();
    assert!(error.to_string().starts_with("600 × 600 × 600 voxels need 0.21 GiB of memory, and 0."), "{error}");
}

fn pictures() {
    let png = |side: u32| {
        let mut bytes = Cursor::new(Vec::new());
        GrayImage::new(side, side).write_to(&mut bytes, ImageFormat::Png).unwrap();
        bytes.into_inner()
    };
    assert_eq!(Style::decode("s", &png(100), false).unwrap().side, 100);
    assert_eq!(SourcePicture::decode(&png(1500), false).unwrap().width(), 1500);
    let style = Style::decode("s", &png(1500), false).unwrap_err();
    let source = SourcePicture::decode(&png(2600), false).unwrap_err();
    for (fault, side) in [(style, 1500), (source, 2600)] {
        assert!(matches!(fault, PictureFault::Memory { width, .. } if width == side), "{fault}");
        let (what, help) = (fault.to_string(), fault.help());
        assert!(what.starts_with(&format!("{side} × {side} pixels need 0.2")) && what.contains("are free"), "{what}");
        assert_eq!(help, "scale the picture down");
    }
}
