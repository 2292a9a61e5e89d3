//! Random and mutated files: an error or a volume, never a panic, and never more memory than the file justifies.

use super::*;
use crate::tables::RawLayout;
use proptest::prelude::*;

/// Buffers of readers and decoders, whatever the file: the largest is that of bzip2, four bytes for each of the 900 000 of
/// a block.
const FIXED: u64 = 1 << 22;

/// Reads a file of so many bytes, with those beside it, and checks what that gives: an error that says what, where and
/// what to do, in one line each, or a whole volume. A byte of text or a run of a compressed stream may be several numbers
/// of eight bytes, and DEFLATE makes up to 1032 bytes of one.
fn sound(bytes: usize, read: impl FnOnce() -> Result<Volume, ReadError>) {
    let mut result = None;
    let used = allocation_counter::measure(|| result = Some(read())).bytes_max;
    let allowed = FIXED + 4 * 1032 * (bytes as u64 + 24);
    assert!(used <= allowed, "{used} bytes asked for by a file of {bytes}");
    match result.unwrap() {
        Ok(volume) => {
            assert_eq!(volume.voxels().len(), volume.grid().len());
            assert!(volume.range().iter().all(|v| v.is_finite()) && volume.slope().is_finite());
            assert!(volume.grid().axes().is_finite() && volume.grid().inverse_axes().is_finite());
        }
        Err(error) => {
            for line in [error.what(), error.place(), error.remedy()] {
                assert!(!line.is_empty() && !line.contains('\n'), "{error}");
            }
        }
    }
}

/// Valid files of every format, small enough that a mutation hits the header.
fn valid() -> Vec<(&'static str, Vec<u8>)> {
    let voxels = sample(VoxelType::I16);
    let stored = bytes_of(&voxels, false);
    let nrrd = |encoding: &str, more: &str| nrrd_lines(VoxelType::I16, "2 3 2", encoding, false) + more + "\n";
    let directions = "space: LPS\nspace directions: (1,0,0) (0,1.5,0) (0.25,0,2)\nspace origin: (1,2,3)\n";
    let meta = |more: &str| {
        let more = format!("{more}ElementSpacing = 1 2 3\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\n");
        meta_lines(VoxelType::I16, "2 3 2", &more)
    };
    let one = Nifti::one(VoxelType::I16, &[2, 3, 2], false).with(&stored);
    let two = Nifti::two(VoxelType::I16, &[2, 3, 2], true).with(&bytes_of(&voxels, true));
    vec![
        ("a.nrrd", joined(nrrd("raw", directions), &stored)),
        ("a.nrrd", joined(nrrd("gzip", "spacings: 1 2 3\n"), &gzip(&stored))),
        ("a.nrrd", joined(nrrd("bzip2", "spacings: 1 2 3\n"), &bzip2(&stored))),
        ("a.nrrd", joined(nrrd("ascii", "kinds: domain domain domain\n"), text_of(&voxels, " ").as_bytes())),
        ("a.nhdr", nrrd("raw", "line skip: 0\nbyte skip: 0\ndata file: data.raw\n").into_bytes()),
        ("a.nhdr", nrrd("raw", "byte skip: 0\ndata file: s%d.raw 0 1 1 2\n").into_bytes()),
        ("a.nhdr", nrrd("raw", "byte skip: -1\ndata file: LIST 2\ns0.raw\ns1.raw\n").into_bytes()),
        ("a.mha", joined(meta("") + "ElementDataFile = LOCAL\n", &stored)),
        ("a.mha", joined(meta("CompressedData = True\n") + "ElementDataFile = LOCAL\n", &zlib(&stored))),
        ("a.mha", joined(meta("BinaryData = False\n") + "ElementDataFile = LOCAL\n", text_of(&voxels, " ").as_bytes())),
        ("a.mhd", (meta("HeaderSize = 0\n") + "ElementDataFile = s%d.raw 0 1 1\n").into_bytes()),
        ("a.mhd", (meta("HeaderSize = -1\n") + "ElementDataFile = LIST 2\ns0.raw\ns1.raw\n").into_bytes()),
        ("a.nii", one.clone()),
        ("a.nii.gz", gzip(&one)),
        ("a.nii", two),
        ("a.raw.toml", b"size = [2, 3, 2]\ntype = \"i16\"\nendian = \"big\"\nspacing = [1, 2, 3]\nskip = 0\n".to_vec()),
    ]
}

thread_local! {
    /// The files beside the headers, made once for all cases of a test.
    static FOLDER: Folder = {
        let folder = Folder::new();
        let stored = bytes_of(&sample(VoxelType::I16), false);
        folder.put("data.raw", &stored);
        folder.put("a.raw", &stored);
        for (i, slice) in stored.chunks(12).enumerate() {
            folder.put(&format!("s{i}.raw"), slice);
        }
        folder
    };
}

/// Reads a file that may need others, or be the sidecar of one.
fn read_beside(name: &str, bytes: &[u8]) -> Result<Volume, ReadError> {
    FOLDER.with(|folder| {
        let path = folder.put(name, bytes);
        if name == "a.raw.toml" { read(&folder.path("a.raw"), None) } else { read(&path, None) }
    })
}

/// One change of a file.
#[derive(Clone, Debug)]
enum Mutation {
    Set(prop::sample::Index, u8),
    Insert(prop::sample::Index, u8),
    Remove(prop::sample::Index),
    Truncate(prop::sample::Index),
    /// Replaces a word of a text header, one that is a number if there is one at the place.
    Word(prop::sample::Index, &'static str),
    /// Replaces bytes of a binary header.
    Bytes(prop::sample::Index, Vec<u8>),
    Line(prop::sample::Index, prop::sample::Index),
}

const WORDS: [&str; 20] = [
    "0",
    "1",
    "-1",
    "3",
    "7",
    "16",
    "100000",
    "1000000000000",
    "4294967296",
    "9223372036854775807",
    "18446744073709551615",
    "1e308",
    "-1e-308",
    "nan",
    "inf",
    "none",
    "(1,2,3)",
    "",
    "True",
    "s%d.raw 0 9223372036854775807 1",
];

/// The first bytes of files of the formats.
const STARTS: [&[u8]; 6] =
    [b"", b"NRRD0004\n", b"ObjectType = Image\n", b"\x5c\x01\0\0", b"\0\0\x02\x1c", b"\x1f\x8b\x08\0"];

/// One name for each reader and each half of a pair.
const NAMES: [&str; 9] = ["a.nrrd", "a.nhdr", "a.nii", "a.nii.gz", "a.hdr", "a.img", "a.mhd", "a.mha", "a.raw.toml"];

fn mutation() -> impl Strategy<Value = Mutation> {
    let at = || any::<prop::sample::Index>();
    prop_oneof![
        (at(), any::<u8>()).prop_map(|(i, c)| Mutation::Set(i, c)),
        (at(), any::<u8>()).prop_map(|(i, c)| Mutation::Insert(i, c)),
        at().prop_map(Mutation::Remove),
        at().prop_map(Mutation::Truncate),
        (at(), prop::sample::select(&WORDS[..])).prop_map(|(i, word)| Mutation::Word(i, word)),
        (at(), prop::sample::select(&WORDS[..])).prop_map(|(i, word)| Mutation::Word(i, word)),
        (
            at(),
            prop_oneof![
                Just(vec![0xff; 8]),
                Just(vec![0x7f; 8]),
                Just(vec![0; 8]),
                Just(vec![0x7f, 0xff]),
                Just(vec![0xff, 0x7f]),
                prop::collection::vec(any::<u8>(), 1..8),
            ]
        )
            .prop_map(|(i, bytes)| Mutation::Bytes(i, bytes)),
        (at(), at()).prop_map(|(from, to)| Mutation::Line(from, to)),
    ]
}

fn apply(bytes: &mut Vec<u8>, mutation: &Mutation) {
    if bytes.is_empty() {
        return;
    }
    let n = bytes.len();
    match mutation {
        Mutation::Set(i, c) => bytes[i.index(n)] = *c,
        Mutation::Insert(i, c) => bytes.insert(i.index(n), *c),
        Mutation::Remove(i) => {
            bytes.remove(i.index(n));
        }
        Mutation::Truncate(i) => bytes.truncate(i.index(n)),
        Mutation::Word(i, word) => {
            let ends = |c: &u8| b" \n(),[]".contains(c);
            let from = bytes[..i.index(n)].iter().rposition(ends).map_or(0, |p| p + 1);
            let to = bytes[from..].iter().position(ends).map_or(n, |p| from + p);
            bytes.splice(from..to, word.bytes());
        }
        Mutation::Bytes(i, new) => {
            let from = i.index(n);
            let to = (from + new.len()).min(n);
            bytes[from..to].copy_from_slice(&new[..to - from]);
        }
        Mutation::Line(from, to) => {
            let lines: Vec<Vec<u8>> = bytes.split_inclusive(|&c| c == b'\n').map(<[u8]>::to_vec).collect();
            let line = lines[from.index(lines.len())].clone();
            let at = lines[..to.index(lines.len())].iter().map(Vec::len).sum::<usize>();
            bytes.splice(at..at, line);
        }
    }
}

#[test]
fn the_files_that_are_mutated_are_valid() {
    for (name, bytes) in valid() {
        let volume =
            read_beside(name, &bytes).unwrap_or_else(|e| panic!("{name}: {e}\n{}", String::from_utf8_lossy(&bytes)));
        assert_eq!(volume.dims(), [2, 3, 2]);
    }
}

#[test]
fn a_truncated_file_is_an_error_or_has_lost_nothing_that_counts() {
    // Not the sidecar, whose last keys have defaults.
    for (name, bytes) in valid().into_iter().filter(|(name, _)| *name != "a.raw.toml") {
        let whole = read_beside(name, &bytes).unwrap();
        for n in 0..bytes.len() {
            let Ok(volume) = read_beside(name, &bytes[..n]) else { continue };
            // Lost: line ends, words with a default, or a digit of the last number in text.
            assert!(bytes.len() - n < 9, "{name}, first {n} of {} bytes", bytes.len());
            assert_eq!(volume.grid(), whole.grid());
            assert!((0..11).all(|i| volume.voxels().get(i) == whole.voxels().get(i)), "{name}, first {n} bytes");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(800))]

    #[test]
    fn mutated_files(
        which in any::<prop::sample::Index>(),
        mutations in prop::collection::vec(mutation(), 1..5),
    ) {
        let files = valid();
        let (name, mut bytes) = files[which.index(files.len())].clone();
        mutations.iter().for_each(|m| apply(&mut bytes, m));
        sound(bytes.len(), || read_beside(name, &bytes));
    }

    #[test]
    fn mutated_headers_inside_gzip(mutations in prop::collection::vec(mutation(), 1..5)) {
        let mut bytes = Nifti::one(VoxelType::I16, &[2, 3, 2], false).with(&[0; 24]);
        mutations.iter().for_each(|m| apply(&mut bytes, m));
        let bytes = gzip(&bytes);
        sound(bytes.len(), || read_beside("a.nii.gz", &bytes));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn random_bytes(
        bytes in prop::collection::vec(any::<u8>(), 0..700),
        name in prop::sample::select(&NAMES[..]),
        start in prop::sample::select(&STARTS[..]),
    ) {
        let bytes = joined(start, &bytes);
        sound(bytes.len(), || read_beside(name, &bytes));
    }

    #[test]
    fn random_layouts(
        size in prop::array::uniform3(prop_oneof![0usize..4, Just(1 << 20), Just(1 << 40), Just(usize::MAX)]),
        voxel_type in prop::sample::select(VoxelType::ALL),
        skip in prop_oneof![0u64..40, Just(u64::MAX), Just(1 << 40)],
        spacing in prop::array::uniform3(prop_oneof![Just(1.0), Just(0.0), Just(-2.0), Just(f64::NAN), Just(1e-300), Just(1e300)]),
        name in prop::sample::select(&["a.raw", "a.raw.gz"][..]),
        data in prop::collection::vec(any::<u8>(), 0..64),
    ) {
        let folder = Folder::new();
        let data = if name == "a.raw" { data } else { gzip(&data) };
        let layout = RawLayout { size, voxel_type, big_endian: true, spacing, skip };
        let (bytes, path) = (data.len(), folder.put(name, data));
        sound(bytes, || read(&path, Some(&layout)));
    }
}
