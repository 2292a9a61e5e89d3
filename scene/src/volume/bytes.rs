//! Numbers as they stand in files: bytes in either order, or text.

use super::Voxel;
use std::str::FromStr;

/// A voxel that a file can hold.
pub(super) trait Stored: Voxel + FromStr {
    /// Appends the numbers in `bytes`, a whole number of them.
    fn append(bytes: &[u8], big_endian: bool, to: &mut Vec<Self>);

    /// Appends the bytes of a number, lowest first.
    fn push_little(self, to: &mut Vec<u8>);

    /// Not a number, in the types that have it.
    fn nan() -> Option<Self>;
}

macro_rules! stored {
    ($($type:ty, $nan:expr;)*) => { $(impl Stored for $type {
        fn append(bytes: &[u8], big_endian: bool, to: &mut Vec<Self>) {
            let (numbers, _) = bytes.as_chunks();
            // The byte order is decided outside the loops, so that each is a plain copy or a plain swap.
            if big_endian {
                to.extend(numbers.iter().map(|&b| Self::from_be_bytes(b)));
            } else {
                to.extend(numbers.iter().map(|&b| Self::from_le_bytes(b)));
            }
        }

        fn push_little(self, to: &mut Vec<u8>) {
            to.extend_from_slice(&self.to_le_bytes());
        }

        fn nan() -> Option<Self> {
            $nan
        }
    })* };
}

stored! {
    u8, None;
    i8, None;
    u16, None;
    i16, None;
    u32, None;
    i32, None;
    u64, None;
    i64, None;
    f32, Some(f32::NAN);
    f64, Some(f64::NAN);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_byte_orders() {
        let mut v: Vec<i16> = Vec::new();
        i16::append(&[0x01, 0x02, 0xff, 0xfe], true, &mut v);
        i16::append(&[0x01, 0x02, 0xff, 0xfe], false, &mut v);
        assert_eq!(v, [0x0102, -2, 0x0201, -257]);
        let mut bytes = Vec::new();
        0x0102i16.push_little(&mut bytes);
        assert_eq!(bytes, [2, 1]);
    }
}
