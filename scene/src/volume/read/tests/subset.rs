//! Less of a file ([VOL-1]): the volume is that of a file with just the kept voxels.

use super::super::{Fault, read_part};
use super::*;
use crate::source::Disk;
use crate::tables::RawLayout;
use crate::volume::Subset;
use std::path::Path;

const DIMS: [usize; 3] = [5, 4, 3];

/// Every second voxel along x from 1 to 4, all but the first along y, and both ends along z.
const SUBSET: Subset = Subset { ranges: Some([[1, 4], [1, 3], [0, 2]]), stride: [2, 1, 2] };

fn part(path: &Path, raw: Option<&RawLayout>) -> Result<Volume, ReadError> {
    read_part(&Disk, path, raw, &|grid, _| SUBSET.of(grid.dims()))
}

/// Voxels that hold their linear index, and the kept ones.
fn numbers() -> [Vec<u16>; 2] {
    let kept = |x: u16, y: u16, z: u16| (z * 4 + y) * 5 + x;
    let kept = (0..12).map(|i| kept(1 + 2 * (i % 2), 1 + i / 2 % 3, 2 * (i / 6)));
    [(0..60).collect(), kept.collect()]
}

#[test]
fn every_encoding_and_split_reads_the_kept_voxels() {
    let folder = Folder::new();
    let [all, kept] = numbers();
    let bytes = |big| bytes_of(&Voxels::U16(all.clone()), big);
    let nrrd = |encoding: &str, big| nrrd_lines(VoxelType::U16, "5 4 3", encoding, big);
    let text = text_of(&Voxels::U16(all.clone()), " ");
    for (slice, z) in bytes(false).chunks(40).zip(0..) {
        folder.put(&format!("s{z}.raw"), slice);
    }
    let files = [
        folder.put("raw.nrrd", joined(nrrd("raw", true) + "\n", &bytes(true))),
        folder.put("gzip.nrrd", joined(nrrd("gzip", false) + "\n", &gzip(&bytes(false)))),
        folder.put("bzip2.nrrd", joined(nrrd("bzip2", false) + "\n", &bzip2(&bytes(false)))),
        folder.put("text.nrrd", nrrd("ascii", false) + "\n" + &text),
        folder.put("slices.nhdr", nrrd("raw", false) + "data file: s%d.raw 0 2 1\n"),
    ];
    for path in files {
        let volume = part(&path, None).unwrap();
        assert_eq!(volume.voxels(), &Voxels::U16(kept.clone()), "{}", path.display());
        assert_eq!((volume.dims(), volume.grid().spacing()), ([2, 3, 2], [2.0, 1.0, 2.0]));
        assert_eq!(volume.grid().origin().to_array(), [1.0, 1.0, 0.0]);
        // The range is that of the kept voxels.
        assert_eq!(volume.range(), [6.0, 58.0]);
        assert_eq!(read(&path, None).unwrap().voxels(), &Voxels::U16(all.clone()));
    }
    let layout = RawLayout { size: DIMS, voxel_type: VoxelType::U16, big_endian: false, spacing: [1.0; 3], skip: 0 };
    let volume = part(&folder.put("a.raw", bytes(false)), Some(&layout)).unwrap();
    assert_eq!(volume.voxels(), &Voxels::U16(kept));
}

#[test]
fn voxels_that_are_left_out_may_be_anything() {
    let folder = Folder::new();
    let [all, kept] = numbers();
    // Voxel 26 lies in the slice that is left out.
    let value = |n: u16| if n == 26 { f32::NAN } else { f32::from(n) };
    let voxels = Voxels::F32(all.into_iter().map(value).collect());
    let header = nrrd_lines(VoxelType::F32, "5 4 3", "raw", false) + "\n";
    let holed = Subset { ranges: None, stride: [1, 1, 2] };
    let path = folder.put("a.nrrd", joined(header, &bytes_of(&voxels, false)));
    assert!(read_part(&Disk, &path, None, &|grid, _| holed.of(grid.dims())).unwrap().mask().is_none());
    assert_eq!(read(&path, None).unwrap().mask().map(crate::volume::Mask::count), Some(1));
    let own = Voxels::F32(kept.into_iter().map(value).collect());
    assert_eq!(part(&path, None).unwrap().voxels(), &own);
}

#[test]
fn a_file_at_fault_is_refused_whatever_is_kept() {
    let folder = Folder::new();
    let short = joined(nrrd_lines(VoxelType::U16, "5 4 3", "raw", false) + "\n", &[0; 118]);
    assert!(matches!(*part(&folder.put("a.nrrd", short), None).unwrap_err().fault, Fault::Short { .. }));
    let small = joined(nrrd_lines(VoxelType::U8, "5 3 3", "raw", false) + "\n", &[0; 45]);
    let error = part(&folder.put("a.nrrd", small), None).unwrap_err();
    assert_eq!(error.what(), "the range [1, 3] along y is not in the volume, whose indices go from 0 to 2");
}
