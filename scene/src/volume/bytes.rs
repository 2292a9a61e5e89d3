//! Numbers as they stand in files: bytes in either order, or text.

use super::Voxel;
use std::str::FromStr;

/// A voxel that a file can hold.
pub(super) trait Stored: Voxel + FromStr {
    /// Appends the numbers in `bytes`, a whole number of them.
    fn append(bytes: &[u8], big_endian: bool, to: &mut Vec<Self>);

    /// Appends the bytes of a number, lowest first.
    fn push_little(self, to: &mut Vec<u8>);

    /// A key of as many bits as the number has: keys are in the order of the numbers, −0 below 0.
    fn key(self) -> u64;

    /// The number of a key.
    fn of_key(key: u64) -> Self;

    /// Not a number, in the types that have it.
    fn nan() -> Option<Self>;
}

macro_rules! stored {
    ($($type:ty, $bits:ty, $nan:expr, $key:expr, $of_key:expr;)*) => { $(impl Stored for $type {
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

        #[inline(always)]
        fn key(self) -> u64 {
            let key: fn($type) -> $bits = $key;
            u64::from(key(self))
        }

        fn of_key(key: u64) -> Self {
            let of_key: fn($bits) -> $type = $of_key;
            of_key(key as $bits)
        }

        fn nan() -> Option<Self> {
            $nan
        }
    })* };
}

// The order of signed integers is that of their bits with the sign turned over. Floats below 0 go the other way: all their
// bits are turned over.
stored! {
    u8, u8, None, |x| x, |k| k;
    i8, u8, None, |x| x as u8 ^ (1 << 7), |k| (k ^ (1 << 7)) as i8;
    u16, u16, None, |x| x, |k| k;
    i16, u16, None, |x| x as u16 ^ (1 << 15), |k| (k ^ (1 << 15)) as i16;
    u32, u32, None, |x| x, |k| k;
    i32, u32, None, |x| x as u32 ^ (1 << 31), |k| (k ^ (1 << 31)) as i32;
    u64, u64, None, |x| x, |k| k;
    i64, u64, None, |x| x as u64 ^ (1 << 63), |k| (k ^ (1 << 63)) as i64;
    f32, u32, Some(f32::NAN),
        |x| if x.is_sign_negative() { !x.to_bits() } else { x.to_bits() | (1 << 31) },
        |k| f32::from_bits(if k >> 31 == 0 { !k } else { k ^ (1 << 31) });
    f64, u64, Some(f64::NAN),
        |x| if x.is_sign_negative() { !x.to_bits() } else { x.to_bits() | (1 << 63) },
        |k| f64::from_bits(if k >> 63 == 0 { !k } else { k ^ (1 << 63) });
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

    #[test]
    fn keys_are_in_the_order_of_their_numbers() {
        fn check<T: Stored + std::fmt::Debug>(ascending: &[T]) {
            assert!(ascending.windows(2).all(|two| two[0].key() < two[1].key()), "{ascending:?}");
            for &x in ascending {
                let mut bytes = [Vec::new(), Vec::new()];
                x.push_little(&mut bytes[0]);
                T::of_key(x.key()).push_little(&mut bytes[1]);
                assert_eq!(bytes[0], bytes[1], "{x:?}");
            }
        }
        check(&[0u8, 1, 200, 255]);
        check(&[i8::MIN, -1, 0, 1, i8::MAX]);
        check(&[0u16, 300, u16::MAX]);
        check(&[i16::MIN, -300, -1, 0, 300, i16::MAX]);
        check(&[0u32, 70_000, u32::MAX]);
        check(&[i32::MIN, -1, 0, 70_000, i32::MAX]);
        check(&[0u64, 1 << 40, u64::MAX]);
        check(&[i64::MIN, -(1 << 40), 0, 1 << 40, i64::MAX]);
        check(&[f32::MIN, -1.5, -1e-40, -0.0, 0.0, 1e-40, 1.5, f32::MAX]);
        check(&[f64::MIN, -1.5, -1e-310, -0.0, 0.0, 1e-310, 1.5, f64::MAX]);
    }
}
