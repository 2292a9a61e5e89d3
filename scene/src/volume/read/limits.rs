//! What the length of a file allows its header to claim ([IO-1]), and what memory allows.

use crate::memory;

/// DEFLATE's limit: one stored byte decodes to 1032 bytes at the most (a match of 258 bytes takes two bits).
const EXPANSION: u128 = 1032;

/// Numbers that are taken in one step: decoded data get memory as they arrive, not as the header claims.
const STEP: usize = 1 << 16;

/// Steps of so many bytes ask the memory budget first. Smaller ones are taken without a look at the system.
const LARGE: usize = 1 << 24;

/// How voxels are stored in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    /// As in memory.
    Raw,
    /// One or more gzip members.
    Gzip,
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
            // A digit and a separator for each number, no separator after the last.
            Self::Text => u128::from(stored).div_ceil(2) * voxel as u128,
        }
    }
}

/// Makes room for `more` numbers behind those that have arrived, doubling what is there and never beyond `total`.
/// False where there is no memory, or the budget has no room.
pub(super) fn make_room<T>(numbers: &mut Vec<T>, more: usize, total: usize) -> bool {
    if numbers.capacity() - numbers.len() >= more {
        return true;
    }
    let step = more.max(numbers.len()).max(STEP).min(total.saturating_sub(numbers.len())).max(more);
    let bytes = step.saturating_mul(size_of::<T>());
    (bytes < LARGE || memory::room(bytes as u64).is_ok()) && numbers.try_reserve_exact(step).is_ok()
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
    fn what_memory_has_no_room_for_is_not_asked_for() {
        let mut v: Vec<u64> = Vec::new();
        assert!(!make_room(&mut v, 1 << 50, 1 << 50));
        assert_eq!(v.capacity(), 0);
    }

    #[test]
    fn memory_follows_the_data_not_the_claim() {
        let mut v: Vec<u8> = Vec::new();
        let total = 1 << 40;
        for arrived in [0usize, 1 << 16, 1 << 17, 1 << 20] {
            v.resize(arrived, 0);
            assert!(make_room(&mut v, 1 << 16, total));
            assert!(v.capacity() <= (2 * arrived).max(1 << 16) + (1 << 16), "{arrived}: {}", v.capacity());
        }
        let mut v: Vec<u16> = Vec::new();
        assert!(make_room(&mut v, 100, 100));
        assert_eq!(v.capacity(), 100);
    }
}
