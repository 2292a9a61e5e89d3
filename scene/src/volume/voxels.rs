//! Voxels in the type that the file has: a u8 stays one byte.

use crate::parallel;

/// A number that a voxel can be.
pub trait Voxel: Copy + Send + Sync + PartialOrd + 'static {
    /// The value in f64; 64-bit integers are rounded to the nearest.
    fn to_f64(self) -> f64;
    /// The value in f32, rounded to the nearest.
    fn to_f32(self) -> f32;
    /// [`to_f64`](Self::to_f64) of several numbers, by vector instructions.
    fn all_to_f64<const N: usize>(all: [Self; N]) -> [f64; N];
    /// [`to_f32`](Self::to_f32) of several numbers.
    fn all_to_f32<const N: usize>(all: [Self; N]) -> [f32; N];
}

macro_rules! side_by_side {
    () => {
        #[inline(always)]
        fn all_to_f64<const N: usize>(all: [Self; N]) -> [f64; N] {
            let mut numbers = [0.0; N];
            for i in 0..N {
                numbers[i] = all[i] as f64;
            }
            numbers
        }

        #[inline(always)]
        fn all_to_f32<const N: usize>(all: [Self; N]) -> [f32; N] {
            let mut numbers = [0.0; N];
            for i in 0..N {
                numbers[i] = all[i] as f32;
            }
            numbers
        }
    };
}

macro_rules! voxel_types {
    ($($variant:ident $type:ty, $name:literal, $doc:literal;)*) => {
        /// Stored voxels, x fastest.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Voxels {
            $(#[doc = $doc] $variant(Vec<$type>),)*
        }

        /// The type of a stored voxel.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum VoxelType {
            $(#[doc = $doc] $variant,)*
        }

        impl VoxelType {
            /// Every type that a voxel can have.
            pub const ALL: &[Self] = &[$(Self::$variant),*];

            /// The name in a scene and on the command line: `u8`, `f32`, …
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// Bytes of one voxel.
            pub fn bytes(self) -> usize {
                match self { $(Self::$variant => size_of::<$type>(),)* }
            }
        }

        impl Voxels {
            /// The type of each voxel.
            pub fn voxel_type(&self) -> VoxelType {
                match self { $(Self::$variant(_) => VoxelType::$variant,)* }
            }

            /// Number of voxels.
            pub fn len(&self) -> usize {
                match self { $(Self::$variant(v) => v.len(),)* }
            }

            /// The stored number at a linear index.
            ///
            /// # Panics
            /// If the index is out of range.
            #[inline]
            pub fn get(&self, i: usize) -> f64 {
                match self { $(Self::$variant(v) => v[i].to_f64(),)* }
            }

            /// Numbers rounded to the nearest value of a type (ties to even) and clamped to its range.
            pub fn from_f64(values: &[f64], to: VoxelType) -> Self {
                match to { $(VoxelType::$variant => Self::$variant(values.iter().map(|&v| <$type as FromF64>::from_f64(v)).collect()),)* }
            }
        }

        /// Runs an expression once for the stored type of a volume, with a reader of that type bound to a name. The
        /// type is decided here, outside the loops that read.
        #[macro_export]
        macro_rules! with_access {
            ($volume:expr, |$access:ident| $body:expr) => {
                match $volume.voxels() {
                    $($crate::volume::Voxels::$variant(data) => {
                        let $access = $crate::volume::Linear::new(data, $volume.dims());
                        $body
                    })*
                }
            };
        }
    };
}

voxel_types! {
    U8 u8, "u8", "Unsigned 8-bit.";
    I8 i8, "i8", "Signed 8-bit.";
    U16 u16, "u16", "Unsigned 16-bit.";
    I16 i16, "i16", "Signed 16-bit.";
    U32 u32, "u32", "Unsigned 32-bit.";
    I32 i32, "i32", "Signed 32-bit.";
    U64 u64, "u64", "Unsigned 64-bit.";
    I64 i64, "i64", "Signed 64-bit.";
    F32 f32, "f32", "IEEE 754 binary32.";
    F64 f64, "f64", "IEEE 754 binary64.";
}

macro_rules! cast {
    ($($type:ty)*) => { $(impl Voxel for $type {
        #[inline(always)]
        fn to_f64(self) -> f64 { self as f64 }
        #[inline(always)]
        fn to_f32(self) -> f32 { self as f32 }
        side_by_side!();
    })* };
}
cast!(u16 i16 u32 i32 u64 i64 f32 f64);

// Bytes are looked up: a sum or difference takes a number of a table as it is, where a conversion of each byte costs
// three instructions. A gradient of 32 voxels is made in three quarters of the time.
macro_rules! look_up {
    ($($type:ty, $wide:ident, $narrow:ident;)*) => { $(
        static $wide: [f64; 256] = {
            let mut table = [0.0; 256];
            let mut i = 0;
            while i < 256 {
                table[i] = i as u8 as $type as f64;
                i += 1;
            }
            table
        };

        static $narrow: [f32; 256] = {
            let mut table = [0.0; 256];
            let mut i = 0;
            while i < 256 {
                table[i] = i as u8 as $type as f32;
                i += 1;
            }
            table
        };

        impl Voxel for $type {
            #[inline(always)]
            fn to_f64(self) -> f64 { $wide[self as u8 as usize] }
            #[inline(always)]
            fn to_f32(self) -> f32 { $narrow[self as u8 as usize] }
            side_by_side!();
        }
    )* };
}
look_up! {
    u8, U8_F64, U8_F32;
    i8, I8_F64, I8_F32;
}

trait FromF64 {
    fn from_f64(v: f64) -> Self;
}

macro_rules! rounded {
    ($($type:ty)*) => { $(impl FromF64 for $type {
        // `as` clamps to the range of the integer type.
        fn from_f64(v: f64) -> Self { v.round_ties_even() as $type }
    })* };
}
rounded!(u8 i8 u16 i16 u32 i32 u64 i64);

impl FromF64 for f32 {
    fn from_f64(v: f64) -> Self {
        v as f32
    }
}

impl FromF64 for f64 {
    fn from_f64(v: f64) -> Self {
        v
    }
}

impl VoxelType {
    /// The type of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|t| t.name() == name)
    }

    /// Whether the type is an integer, which sets the automatic Hessian ([REC-3]).
    pub fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

impl Voxels {
    /// Whether there is no voxel.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Replaces the numbers whose linear index is flat by the lowest stored number, or by the highest.
    pub(super) fn flatten(&mut self, is_flat: &(dyn Fn(usize) -> bool + Sync), to_highest: bool) {
        fn put<V: Voxel>(v: &mut [V], is_flat: &(dyn Fn(usize) -> bool + Sync), to_highest: bool) {
            const RUN: usize = 1 << 12;
            let outermost = |a: V, b: V| if (b > a) == to_highest { b } else { a };
            let Some(value) = v.iter().copied().reduce(outermost) else { return };
            parallel::chunks_mut(v, RUN, &|run, voxels| {
                let flat = (run * RUN..).zip(voxels).filter(|(i, _)| is_flat(*i));
                flat.for_each(|(_, voxel)| *voxel = value);
            });
        }
        match self {
            Self::U8(v) => put(v, is_flat, to_highest),
            Self::I8(v) => put(v, is_flat, to_highest),
            Self::U16(v) => put(v, is_flat, to_highest),
            Self::I16(v) => put(v, is_flat, to_highest),
            Self::U32(v) => put(v, is_flat, to_highest),
            Self::I32(v) => put(v, is_flat, to_highest),
            Self::U64(v) => put(v, is_flat, to_highest),
            Self::I64(v) => put(v, is_flat, to_highest),
            Self::F32(v) => put(v, is_flat, to_highest),
            Self::F64(v) => put(v, is_flat, to_highest),
        }
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        self.len() * self.voxel_type().bytes()
    }

    /// Lowest and highest stored number; both NaN where there is no voxel.
    pub fn range(&self) -> [f64; 2] {
        fn ends<V: Voxel>(v: &[V]) -> [f64; 2] {
            let Some(&first) = v.first() else { return [f64::NAN; 2] };
            let (lo, hi) = v
                .iter()
                .fold((first, first), |(lo, hi), &x| (if x < lo { x } else { lo }, if x > hi { x } else { hi }));
            [lo.to_f64(), hi.to_f64()]
        }
        match self {
            Self::U8(v) => ends(v),
            Self::I8(v) => ends(v),
            Self::U16(v) => ends(v),
            Self::I16(v) => ends(v),
            Self::U32(v) => ends(v),
            Self::I32(v) => ends(v),
            Self::U64(v) => ends(v),
            Self::I64(v) => ends(v),
            Self::F32(v) => ends(v),
            Self::F64(v) => ends(v),
        }
    }
}

/// Reading voxels by position, whatever the order of storage. Another order is one more implementation.
pub trait Access: Copy + Sync {
    /// The stored type.
    type Voxel: Voxel;
    /// Reads a part of the volume.
    type Window: Access<Voxel = Self::Voxel>;

    /// Voxels along x, y, z.
    fn dims(&self) -> [usize; 3];

    /// The `S`³ voxels from (x, y, z) on, which is the window's (0, 0, 0). This function checks once, and not for each
    /// row, that all voxels lie inside the grid.
    ///
    /// # Panics
    /// If one lies outside.
    fn window<const S: usize>(&self, x: usize, y: usize, z: usize) -> Self::Window;

    /// `N` neighbours along x from (x, y, z) on, all inside the grid.
    ///
    /// # Panics
    /// If one lies outside.
    fn row<const N: usize>(&self, x: usize, y: usize, z: usize) -> [Self::Voxel; N];

    /// The voxel at (x, y, z).
    ///
    /// # Panics
    /// If it lies outside.
    #[inline(always)]
    fn at(&self, x: usize, y: usize, z: usize) -> Self::Voxel {
        self.row::<1>(x, y, z)[0]
    }
}

/// Voxels stored one row after the other, x fastest.
#[derive(Clone, Copy, Debug)]
pub struct Linear<'a, V> {
    data: &'a [V],
    dims: [usize; 3],
    /// Steps from a voxel to the next one along y and along z.
    strides: [usize; 2],
}

/// The largest stride. With it the compiler knows that an offset inside a window does not overflow, and leaves out the
/// checks that follow from the window's own. With 32-bit addresses it is a slice of 16384² voxels.
const LONGEST_STRIDE: usize = usize::MAX >> 4;

impl<'a, V: Voxel> Linear<'a, V> {
    /// Reads `data`, which has the product of `dims` voxels.
    ///
    /// # Panics
    /// If a slice has more than a sixteenth of the voxels that addresses can count.
    #[inline(always)]
    pub fn new(data: &'a [V], dims: [usize; 3]) -> Self {
        debug_assert_eq!(data.len(), dims.iter().product::<usize>());
        let strides = [dims[0], dims[0] * dims[1]];
        assert!(strides[0] <= LONGEST_STRIDE && strides[1] <= LONGEST_STRIDE);
        Self { data, dims, strides }
    }

    #[inline(always)]
    fn offset(&self, x: usize, y: usize, z: usize) -> usize {
        z * self.strides[1] + y * self.strides[0] + x
    }

    /// A [`window`](Access::window) that starts at the voxel with the linear index `start`.
    ///
    /// # Panics
    /// If the window reaches beyond the last voxel. A window that reaches beyond the end of a row reads the next row.
    #[inline(always)]
    pub fn window_at<const S: usize>(&self, start: usize) -> Self {
        // Checked in `new`; said again for the compiler, which does not look that far.
        assert!(self.strides[0] | self.strides[1] <= LONGEST_STRIDE);
        let data = &self.data[start..start + self.offset(S - 1, S - 1, S - 1) + 1];
        Self { data, dims: [S; 3], strides: self.strides }
    }
}

impl<V: Voxel> Access for Linear<'_, V> {
    type Voxel = V;
    type Window = Self;

    #[inline(always)]
    fn dims(&self) -> [usize; 3] {
        self.dims
    }

    #[inline(always)]
    fn window<const S: usize>(&self, x: usize, y: usize, z: usize) -> Self {
        // `offset` is avoided: the compiler makes a slow vector of its two independent products.
        self.window_at::<S>((z * self.dims[1] + y) * self.dims[0] + x)
    }

    #[inline(always)]
    fn row<const N: usize>(&self, x: usize, y: usize, z: usize) -> [V; N] {
        let start = self.offset(x, y, z);
        let mut row = [self.data[start]; N];
        row.copy_from_slice(&self.data[start..start + N]);
        row
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_the_numbers_they_stand_for() {
        for i in 0..=255u8 {
            assert_eq!((i.to_f64(), i.to_f32()), (f64::from(i), f32::from(i)));
            let i = i as i8;
            assert_eq!((i.to_f64(), i.to_f32()), (f64::from(i), f32::from(i)));
        }
    }

    #[test]
    fn rows_and_windows_are_the_voxels_in_order() {
        let data: Vec<u8> = (0..60).collect();
        let all = Linear::new(&data, [3, 4, 5]);
        assert_eq!(all.row::<3>(0, 2, 4), [54, 55, 56]);
        let part = all.window::<2>(1, 2, 3);
        for (x, y, z) in (0..8).map(|i| (i % 2, i / 2 % 2, i / 4)) {
            assert_eq!(part.at(x, y, z), all.at(1 + x, 2 + y, 3 + z));
        }
        assert_eq!(part.dims(), [2; 3]);
    }

    #[test]
    #[should_panic]
    fn a_window_beyond_the_last_voxel() {
        Linear::new(&[0u8; 60], [3, 4, 5]).window::<2>(2, 3, 4);
    }
}
