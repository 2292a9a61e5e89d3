//! Eight numbers side by side: the width of the vector registers.

use drypoint_scene::math::{self, Width};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, f64x8, mask64x8, u64x8};

/// Numbers side by side.
pub(crate) const LANES: usize = 8;

/// The processor's vector instructions: AVX2 if an x86 has it, NEON on ARM, none elsewhere. AVX-512 gained nothing
/// beyond AVX2, for twice the code.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
pub(crate) fn wide() -> Option<impl Simd> {
    fearless_simd::Level::new().as_avx2()
}

/// The processor's vector instructions: NEON, which every such processor has.
#[cfg(target_arch = "aarch64")]
pub(crate) fn wide() -> Option<impl Simd> {
    fearless_simd::Level::new().as_neon()
}

/// The processor's vector instructions: none here.
#[cfg(not(any(target_arch = "x86", target_arch = "x86_64", target_arch = "aarch64")))]
pub(crate) fn wide() -> Option<impl Simd> {
    None::<fearless_simd::Fallback>
}

/// Runs a closure compiled for the instructions of [`wide`], if the processor has them. The operations are the same, so
/// the bits are too. Only code that is inlined into the closure benefits.
#[inline(always)]
pub(crate) fn widely<T>(compute: impl FnOnce() -> T) -> T {
    match wide() {
        Some(simd) => simd.vectorize(compute),
        None => compute(),
    }
}

/// The width of eight numbers, for the series of [`math`].
#[derive(Clone, Copy)]
pub(crate) struct Eight<S>(pub(crate) S);

impl<S: Simd> Width for Eight<S> {
    type Number = f64x8<S>;
    type Bits = u64x8<S>;
    type Mask = mask64x8<S>;

    #[inline(always)]
    fn number(self, x: f64) -> f64x8<S> {
        f64x8::splat(self.0, x)
    }

    #[inline(always)]
    fn sqrt(self, x: f64x8<S>) -> f64x8<S> {
        SimdFloat::sqrt(x)
    }

    #[inline(always)]
    fn below(self, a: f64x8<S>, b: f64x8<S>) -> mask64x8<S> {
        a.simd_lt(b)
    }

    #[inline(always)]
    fn select(self, mask: mask64x8<S>, a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
        mask.select(a, b)
    }

    #[inline(always)]
    fn bits(self, x: f64x8<S>) -> u64x8<S> {
        x.to_bits()
    }

    #[inline(always)]
    fn of_bits(self, bits: u64x8<S>) -> f64x8<S> {
        f64x8::from_bits(bits)
    }

    #[inline(always)]
    fn scaled(self, x: f64x8<S>, exponent: u64x8<S>) -> f64x8<S> {
        f64x8::from_bits(x.to_bits() + exponent)
    }

    /// The rows of a table, turned into lanes.
    #[inline(always)]
    fn look_up<const N: usize, const ROWS: usize>(self, table: &[[f64; N]; ROWS], row: u64x8<S>) -> [f64x8<S>; N] {
        let rows: [u64; LANES] = row.into();
        let mut columns = [[0.0; LANES]; N];
        for lane in 0..LANES {
            let row = &table[(rows[lane] as usize).min(ROWS - 1)];
            for i in 0..N {
                columns[i][lane] = row[i];
            }
        }
        let mut lanes = [f64x8::splat(self.0, 0.0); N];
        for i in 0..N {
            lanes[i] = columns[i].simd_into(self.0);
        }
        lanes
    }
}

/// [`math::power`] of the lanes `asked`; the other lanes hold arbitrary numbers. Tiny numbers, and one or two lanes,
/// are computed lane by lane.
#[inline(always)]
pub(super) fn power<S: Simd>(x: f64x8<S>, y: f64x8<S>, asked: u64) -> f64x8<S> {
    let tiny = asked & x.simd_lt(math::power::LEAST).to_bitmask();
    let mut result = x;
    let mut alone = tiny;
    if (asked & !tiny).count_ones() > 2 {
        result = math::power::power(Eight(x.simd), x, y);
    } else {
        alone = asked;
    }
    while alone != 0 {
        let lane = alone.trailing_zeros() as usize;
        alone &= alone - 1;
        result[lane] = math::power(x[lane], y[lane]);
    }
    result
}

/// Transposes rows of four numbers, one for each lane, to columns.
#[inline(always)]
pub(crate) fn columns<S: Simd>(rows: [f64x4<S>; LANES]) -> [f64x8<S>; 4] {
    let low = turned([rows[0], rows[1], rows[2], rows[3]]);
    let high = turned([rows[4], rows[5], rows[6], rows[7]]);
    [low[0].combine(high[0]), low[1].combine(high[1]), low[2].combine(high[2]), low[3].combine(high[3])]
}

/// Transposes four columns to rows, one for each lane.
#[inline(always)]
pub(crate) fn rows<S: Simd>([a, b, c, d]: [f64x8<S>; 4]) -> [f64x4<S>; LANES] {
    let ((a, a_high), (b, b_high), (c, c_high), (d, d_high)) = (a.split(), b.split(), c.split(), d.split());
    let [r0, r1, r2, r3] = turned([a, b, c, d]);
    let [r4, r5, r6, r7] = turned([a_high, b_high, c_high, d_high]);
    [r0, r1, r2, r3, r4, r5, r6, r7]
}

/// Transposes a 4×4 block.
#[inline(always)]
fn turned<S: Simd>([a, b, c, d]: [f64x4<S>; 4]) -> [f64x4<S>; 4] {
    let (ac, bd) = (a.zip_low(c), b.zip_low(d));
    let (ac_high, bd_high) = (a.zip_high(c), b.zip_high(d));
    [ac.zip_low(bd), ac.zip_high(bd), ac_high.zip_low(bd_high), ac_high.zip_high(bd_high)]
}

/// Helpers of tests that compare lanes with single numbers.
#[cfg(test)]
pub(crate) mod testing {
    use super::*;
    use crate::number::Vec3;

    /// Numbers in [0, 1), a sequence for each seed, with the ends among them.
    pub(crate) fn numbers(seed: u64) -> impl Iterator<Item = f64> {
        (0u64..).map(move |i| match i % 11 {
            0 if i % 3 == 0 => 0.0,
            5 if i % 2 == 0 => 1.0,
            _ => {
                (i * 2 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15 ^ seed.wrapping_mul(0xff51_afd7_ed55_8ccd)) as f64
                    / 2f64.powi(64)
            }
        })
    }

    pub(crate) fn column(numbers: &mut impl Iterator<Item = f64>) -> [f64; LANES] {
        std::array::from_fn(|_| numbers.next().unwrap())
    }

    /// Unit vectors, one a lane.
    pub(crate) fn units(numbers: &mut impl Iterator<Item = f64>) -> [Vec3<f64>; LANES] {
        let mut next = || numbers.next().unwrap() - 0.4;
        std::array::from_fn(|_| {
            let v = Vec3::new(next(), next(), next());
            v * (1.0 / v.length())
        })
    }

    /// Vectors side by side.
    pub(crate) fn side_by_side<S: Simd>(simd: S, v: [Vec3<f64>; LANES]) -> Vec3<f64x8<S>> {
        Vec3::new(v.map(|v| v.x).simd_into(simd), v.map(|v| v.y).simd_into(simd), v.map(|v| v.z).simd_into(simd))
    }

    /// Compares lanes with the number that each would be alone, bit by bit.
    pub(crate) fn same(got: [f64; LANES], want: impl Fn(usize) -> f64) {
        for (lane, got) in got.into_iter().enumerate() {
            assert_eq!(got.to_bits(), want(lane).to_bits(), "lane {lane}: {got} {}", want(lane));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};

    /// Runs a function of two numbers over all pairs, eight at a time.
    fn pairs(a: &[f64], b: &[f64]) -> Vec<[[f64; LANES]; 2]> {
        let all: Vec<[f64; 2]> = a.iter().flat_map(|&a| b.iter().map(move |&b| [a, b])).collect();
        all.chunks_exact(LANES).map(|pairs| [0, 1].map(|i| std::array::from_fn(|lane| pairs[lane][i]))).collect()
    }

    #[test]
    fn powers_take_the_steps_of_one() {
        let level = Level::new();
        let one = 1f64.to_bits();
        let by_exponent = (0..2048u64).map(|i| f64::from_bits(one / 2048 * i + 1));
        let octaves = (0..4096u64).map(|i| f64::from_bits(one - i * ((44 << 52) / 4096)));
        let x: Vec<f64> = by_exponent.chain(octaves).chain((1..2048).map(|i| f64::from(i) / 2048.0)).collect();
        let y: Vec<f64> = (0..40).map(|i| 0.5 + f64::from(i) * 0.025_7).collect();
        for [x, y] in pairs(&x, &y).into_iter().chain(pairs(&y, &x).into_iter().map(|[y, x]| [x, y])) {
            for asked in [0xff, 0x15, 0x80] {
                let got: [f64; LANES] = dispatch!(level, simd => {
                    power(x.simd_into(simd), y.simd_into(simd), asked).into()
                });
                for lane in (0..LANES).filter(|lane| asked >> lane & 1 == 1) {
                    assert_eq!(got[lane].to_bits(), math::power(x[lane], y[lane]).to_bits(), "{x:?} {y:?} {asked}");
                }
            }
        }
    }

    #[test]
    fn angles_take_the_steps_of_one() {
        let level = Level::new();
        let sizes = [0.0, 1e-300, 1e-9, 1.0 / 128.0, 0.3, 0.5, 0.999, 1.0, 3.0];
        let y: Vec<f64> = sizes.into_iter().chain((0..700).map(|i| f64::from(i) / 699.0)).collect();
        let x: Vec<f64> = y.iter().flat_map(|&x| [x, -x]).collect();
        for [y, x] in pairs(&y, &x) {
            let got: [f64; LANES] = dispatch!(level, simd => {
                math::angle::angle(Eight(simd), y.simd_into(simd), x.simd_into(simd)).into()
            });
            for lane in 0..LANES {
                assert_eq!(got[lane].to_bits(), math::angle(y[lane], x[lane]).to_bits(), "{y:?} {x:?}");
            }
        }
    }
}
