//! Limits that the length of a file puts on the claims of its header ([IO-1]).

use crate::memory::{self, NoRoom};

/// DEFLATE's limit: one stored byte decodes to 1032 bytes at the most (a match of 258 bytes takes two bits).
const EXPANSION: u128 = 1032;

/// bzip2's limit. A block holds at most 900 000 bytes, of which five may stand for a run of 259: 46 620 000 decoded
/// bytes. A block takes at least 24 stored bytes: sums, tables and the length of its runs.
const BZIP2_EXPANSION: u128 = 46_620_000 / 24;

/// Numbers that are taken in one step: decoded data get memory as they arrive, not as the header claims.
const STEP: usize = 1 << 16;

/// The encoding of a file's voxels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    /// Bytes as in memory.
    Raw,
    /// One or more gzip members.
    Gzip,
    /// One or more bzip2 streams.
    Bzip2,
    /// A zlib stream, or gzip where its magic says so.
    Zlib,
    /// Numbers in ASCII, parted by white space or commas.
    Text,
}

impl Encoding {
    /// The most bytes of voxels that `stored` bytes can decode to, a voxel having `voxel` bytes.
    pub(super) fn most(self, stored: u64, voxel: usize) -> u128 {
        match self {
            Self::Raw => stored.into(),
            Self::Gzip | Self::Zlib => EXPANSION * u128::from(stored),
            Self::Bzip2 => BZIP2_EXPANSION * u128::from(stored),
            // A digit and a separator for each number, no separator after the last.
            Self::Text => u128::from(stored).div_ceil(2) * voxel as u128,
        }
    }
}

/// Makes room for `more` numbers behind those that have arrived, doubling what is there and never beyond `total`.
/// The memory budget is asked for what is added.
pub(super) fn make_room<T>(numbers: &mut Vec<T>, more: usize, total: usize) -> Result<(), NoRoom> {
    if numbers.capacity() - numbers.len() >= more {
        return Ok(());
    }
    let step = more.max(numbers.len()).max(STEP).min(total.saturating_sub(numbers.len())).max(more);
    memory::room_for(step as u64, size_of::<T>() as u64).map_err(|no_room| {
        let bytes = |n: usize| (n as u64).saturating_mul(size_of::<T>() as u64);
        NoRoom { needed: bytes(total), free: no_room.free.saturating_add(bytes(numbers.len())) }
    })?;
    numbers.reserve_exact(step);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_holds_no_more_than_its_length_allows() {
        assert_eq!(Encoding::Raw.most(10, 8), 10);
        assert_eq!(Encoding::Gzip.most(100, 2), 103_200);
        assert_eq!(Encoding::Text.most(5, 4), 12); // "1 2 3"
        assert_eq!(Encoding::Zlib.most(u64::MAX, 1), 1032 * u128::from(u64::MAX));
    }

    #[test]
    fn deflate_reaches_its_limit_but_does_not_pass_it() {
        use std::io::Write;
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
        encoder.write_all(&vec![0; 10_000_000]).unwrap();
        let stored = encoder.finish().unwrap().len() as u64;
        let most = Encoding::Gzip.most(stored, 1);
        assert!((10_000_000..10_200_000).contains(&most), "{most}");
    }

    #[test]
    fn bzip2_reaches_half_its_limit_but_does_not_pass_it() {
        use std::io::Read;
        let mut encoder = bzip2::read::BzEncoder::new(std::io::repeat(0).take(90_000_000), bzip2::Compression::best());
        let stored = std::io::copy(&mut encoder, &mut std::io::sink()).unwrap();
        let most = Encoding::Bzip2.most(stored, 1);
        assert!((90_000_000..180_000_000).contains(&most), "{most}");
    }

    #[test]
    fn memory_follows_the_data_not_the_claim() {
        let mut v: Vec<u8> = Vec::new();
        let total = 1 << 40;
        for arrived in [0usize, 1 << 16, 1 << 17, 1 << 20] {
            v.resize(arrived, 0);
            make_room(&mut v, 1 << 16, total).unwrap();
            assert!(v.capacity() <= (2 * arrived).max(1 << 16) + (1 << 16), "{arrived}: {}", v.capacity());
        }
        let mut v: Vec<u16> = Vec::new();
        make_room(&mut v, 100, 100).unwrap();
        assert_eq!(v.capacity(), 100);
    }
}
