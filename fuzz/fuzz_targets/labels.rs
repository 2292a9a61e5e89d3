//! Labels. An input that begins with NRRD is a label volume, any other a table of names.

#![no_main]

use drypoint_scene::source::Disk;
use drypoint_fuzz::{Folder, check_error, start};
use drypoint_scene::volume::labels::{LabelError, LabelNames, LabelVolume};
use drypoint_scene::volume::read::read;
use libfuzzer_sys::fuzz_target;

fuzz_target!(init: start(), |data: &[u8]| {
    if data.starts_with(b"NRRD") { volume(data) } else { names(data) }
});

/// Reads a table, and finds each name by its label and each label by its name.
fn names(file: &[u8]) {
    match LabelNames::read(&Disk, &Folder::new().put("a.csv", file)) {
        Ok(names) => {
            for (id, name) in names.iter() {
                assert_eq!((names.id(name), names.name(id)), (Some(id), Some(name)));
                assert!(names.nearest(name).is_some());
            }
        }
        Err(error) => check_error([error.what(), error.place(), error.remedy().into()]),
    }
}

/// Reads labels, and compares each with the voxel that it comes from.
fn volume(file: &[u8]) {
    let volume = match read(&Folder::new().put("a.nrrd", file), None) {
        Ok(volume) => volume,
        Err(error) => return check_error([error.what(), error.place(), error.remedy()]),
    };
    match LabelVolume::new(&volume) {
        Ok(labels) => {
            let voxels = volume.voxels();
            let value = |i| volume.slope() * voxels.get(i) + volume.intercept();
            assert!((0..voxels.len()).all(|i| f64::from(labels.id(i)) == value(i)));
        }
        Err(LabelError::NotAnId { voxel, .. }) => assert!(voxel.iter().zip(volume.dims()).all(|(i, n)| *i < n)),
    }
}
