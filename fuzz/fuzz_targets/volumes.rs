//! Volume files. The first byte chooses the name, and with it the reader; the rest is the file.

#![no_main]

use drypoint_fuzz::{Folder, check_error, start};
use drypoint_scene::tables::RawLayout;
use drypoint_scene::volume::info::Info;
use drypoint_scene::volume::read::{ReadError, read};
use drypoint_scene::volume::{Volume, VoxelType};
use libfuzzer_sys::fuzz_target;

/// A name for each reader. The last two are the sidecar of raw voxels, and compressed voxels of [`layout`].
const NAMES: [&str; 9] = ["a.nrrd", "a.nhdr", "a.mha", "a.mhd", "a.nii", "a.nii.gz", "a.hdr", "a.raw.toml", "a.raw.gz"];

/// Voxels for headers that name a file: 2 × 3 × 2 of 16 bits.
const VOXELS: [u8; 24] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23];

fuzz_target!(init: start(), |data: &[u8]| {
    let Some((choice, file)) = data.split_first() else { return };
    let name = NAMES[usize::from(*choice) % NAMES.len()];
    match beside(name, file) {
        Ok(volume) => check_volume(&volume),
        Err(error) => check_error([error.what(), error.place(), error.remedy()]),
    }
});

/// Reads a file, with the files beside it that headers and sidecars need.
fn beside(name: &str, file: &[u8]) -> Result<Volume, ReadError> {
    let folder = Folder::new();
    let path = folder.put(name, file);
    match name {
        "a.nhdr" | "a.mhd" => {
            folder.put("a.raw", &VOXELS);
            folder.put("s0.raw", &VOXELS[..12]);
            folder.put("s1.raw", &VOXELS[12..]);
            read(&path, None)
        }
        "a.hdr" => {
            folder.put("a.img", &VOXELS);
            read(&path, None)
        }
        "a.raw.toml" => read(&folder.put("a.raw", &VOXELS), None),
        "a.raw.gz" => read(&path, Some(&layout())),
        _ => read(&path, None),
    }
}

fn layout() -> RawLayout {
    RawLayout { size: [2, 3, 2], voxel_type: VoxelType::I16, big_endian: true, spacing: [1.0, 2.0, 3.0], skip: 0 }
}

/// Checks that a volume is whole and finite, and that `info` can tell about it.
fn check_volume(volume: &Volume) {
    assert_eq!(volume.voxels().len(), volume.grid().len());
    assert!(volume.range().iter().all(|value| value.is_finite()));
    assert!(volume.slope().is_finite() && volume.intercept().is_finite());
    assert!(volume.grid().axes().is_finite() && volume.grid().inverse_axes().is_finite());
    assert!(volume.grid().origin().is_finite());
    assert!(!Info::new("a".as_ref(), volume).to_string().is_empty());
}
