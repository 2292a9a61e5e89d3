//! Every type, both byte orders, every way to store: the voxels come back bit by bit.

use super::*;
use crate::tables::RawLayout;

/// Compares bit by bit, so that −0 is not 0.
fn same(volume: &Volume, want: &Voxels, what: &str) {
    assert_eq!(volume.voxels().voxel_type(), want.voxel_type(), "{what}");
    assert_eq!(bytes_of(volume.voxels(), false), bytes_of(want, false), "{what}");
    assert_eq!(volume.dims(), [2, 3, 2], "{what}");
    assert!(volume.mask().is_none(), "{what}");
}

/// Every type in both byte orders.
fn all() -> impl Iterator<Item = (Voxels, bool, String)> {
    VoxelType::ALL.iter().flat_map(|&t| {
        [false, true].map(|big| (sample(t), big, format!("{}, {}", t.name(), if big { "big" } else { "little" })))
    })
}

#[test]
fn nrrd() {
    let folder = Folder::new();
    for (voxels, big, what) in all() {
        let t = voxels.voxel_type();
        let stored = bytes_of(&voxels, big);
        for (encoding, data) in [
            ("raw", stored.clone()),
            ("gzip", gzip(&stored)),
            ("gz", [gzip(&stored[..5]), gzip(&stored[5..])].concat()),
            ("bzip2", bzip2(&stored)),
            // pbzip2 writes a stream a block.
            ("bz2", [bzip2(&stored[..5]), bzip2(&stored[5..])].concat()),
            ("ascii", text_of(&voxels, "\n").into_bytes()),
            ("txt", text_of(&voxels, " , ").into_bytes()),
        ] {
            let lines = nrrd_lines(t, "2 3 2", encoding, big);
            let what = format!("{what}, {encoding}");
            same(&folder.read("a.nrrd", joined(lines.clone() + "\n", &data)).unwrap(), &voxels, &what);
            folder.put("a.data", &data);
            same(&folder.read("a.nhdr", lines + "data file: a.data\n").unwrap(), &voxels, &what);
        }
    }
}

/// Bytes of another bzip2 than the one that the other tests compress with: two streams, of the levels 9 and 1.
#[test]
fn nrrd_of_another_program_in_bzip2() {
    let data = b"\
        \x42\x5a\x68\x39\x31\x41\x59\x26\x53\x59\x06\xdc\xae\xd5\x00\x00\x00\x40\x00\x7c\x00\x20\x00\x21\x83\x41\
        \x9a\x02\x5c\x71\x77\x24\x53\x85\x09\x00\x6d\xca\xed\x50\x42\x5a\x68\x31\x31\x41\x59\x26\x53\x59\x5e\x25\
        \xa1\xd6\x00\x00\x00\x40\x00\x03\xf8\x20\x00\x31\x0c\x00\xc4\xc2\x65\xce\x5d\xe2\xee\x48\xa7\x0a\x12\x0b\
        \xc4\xb4\x3a\xc0\
        ";
    let folder = Folder::new();
    let lines = nrrd_lines(VoxelType::U8, "2 3 2", "bzip2", false);
    let want = Voxels::U8((0..12).collect());
    same(&folder.read("a.nrrd", joined(lines.clone() + "\n", data)).unwrap(), &want, "attached");
    folder.put("a.raw.bz2", data);
    same(&folder.read("a.nhdr", lines.clone() + "data file: a.raw.bz2\n").unwrap(), &want, "detached");
    // Bytes to skip are those of the voxels, not of the file.
    folder.put("b.raw.bz2", bzip2(&[[9; 4].as_slice(), &bytes_of(&want, false)].concat()));
    let skipping = lines + "byte skip: 4\ndata file: b.raw.bz2\n";
    same(&folder.read("b.nhdr", skipping).unwrap(), &want, "behind bytes to skip");
}

#[test]
fn metaimage() {
    let folder = Folder::new();
    for (voxels, big, what) in all() {
        let t = voxels.voxel_type();
        let stored = bytes_of(&voxels, big);
        for (more, data) in [
            ("BinaryData = True\n", stored.clone()),
            ("CompressedData = True\n", zlib(&stored)),
            ("CompressedData = True\n", gzip(&stored)),
            ("BinaryData = False\n", text_of(&voxels, " ").into_bytes()),
        ] {
            let lines = meta_lines(t, "2 3 2", &format!("{more}ElementByteOrderMSB = {big}\n"));
            let what = format!("{what}, {more}");
            let local = joined(lines.clone() + "ElementDataFile = LOCAL\n", &data);
            same(&folder.read("a.mha", local).unwrap(), &voxels, &what);
            folder.put("a.zraw", &data);
            same(&folder.read("a.mhd", lines + "ElementDataFile = a.zraw\n").unwrap(), &voxels, &what);
        }
    }
}

#[test]
fn nifti() {
    let folder = Folder::new();
    for (voxels, big, what) in all() {
        let t = voxels.voxel_type();
        let stored = bytes_of(&voxels, big);
        for mut header in [Nifti::one(t, &[2, 3, 2], big), Nifti::two(t, &[2, 3, 2], big)] {
            let file = header.with(&stored);
            same(&folder.read("a.nii", &file).unwrap(), &voxels, &what);
            same(&folder.read("a.nii.gz", gzip(&file)).unwrap(), &voxels, &what);
            // The other half of a pair: its own magic, and no offset.
            if header.bytes.len() == 352 {
                header.f32(108, 0.0).bytes[344..348].copy_from_slice(b"ni1\0");
            } else {
                header.i64(168, 0).bytes[4..8].copy_from_slice(b"ni2\0");
            }
            folder.put("p.img", &stored);
            same(&folder.read("p.hdr", &header.bytes).unwrap(), &voxels, &what);
            same(&read(&folder.path("p.img"), None).unwrap(), &voxels, &what);
            std::fs::remove_file(folder.path("p.img")).unwrap();
            folder.put("p.img.gz", gzip(&stored));
            same(&read(&folder.path("p.hdr"), None).unwrap(), &voxels, &what);
            std::fs::remove_file(folder.path("p.img.gz")).unwrap();
        }
    }
}

#[test]
fn raw() {
    let folder = Folder::new();
    for (voxels, big, what) in all() {
        let voxel_type = voxels.voxel_type();
        let data = joined("skip", &bytes_of(&voxels, big));
        let layout = RawLayout { size: [2, 3, 2], voxel_type, big_endian: big, spacing: [1.0, 2.0, 3.0], skip: 4 };
        for (name, data) in [("a.raw", data.clone()), ("a.weird", data.clone()), ("a.raw.gz", gzip(&data))] {
            let file = folder.put(name, &data);
            let volume = read(&file, Some(&layout)).unwrap();
            same(&volume, &voxels, &what);
            assert_eq!(volume.grid().spacing(), [1.0, 2.0, 3.0]);
            let endian = if big { "big" } else { "little" };
            let sidecar = format!(
                "size = [2, 3, 2]\ntype = \"{}\"\nendian = \"{endian}\"\nspacing = [1, 2, 3]\nskip = 4\n",
                voxel_type.name()
            );
            folder.put(&format!("{name}.toml"), sidecar);
            let described = read(&file, None).unwrap();
            same(&described, &voxels, &what);
            assert_eq!(described.grid(), volume.grid());
        }
    }
}
