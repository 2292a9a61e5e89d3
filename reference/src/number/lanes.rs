//! Functions of [`drypoint_scene::math`] of eight numbers side by side: the same steps, so the same bits ([PREC-4]).

use super::Vec3;
use drypoint_scene::math;
use drypoint_scene::math::angle::{ANGLES, FRAC_PI_2_LO, STEPS as ANGLE_STEPS};
use drypoint_scene::math::power::{LEAST, TO_12_BITS, TO_28_BITS};
use drypoint_scene::math::transmittance::{LN_2_HI, LN_2_LO, LOGARITHMS, POWERS, STEPS, STEPS_BITS, TO_WHOLE};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, f64x8};
use std::f64::consts::{FRAC_PI_2, PI};

/// Numbers side by side.
pub(crate) const LANES: usize = 8;

/// Registers of the processor that hold lanes: AVX2 where an x86 has it, NEON on ARM, none elsewhere. AVX-512 gained nothing
/// beyond AVX2, for twice the code.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
pub(crate) fn wide() -> Option<impl Simd> {
    fearless_simd::Level::new().as_avx2()
}

/// Registers of the processor that hold lanes: NEON, which every such processor has.
#[cfg(target_arch = "aarch64")]
pub(crate) fn wide() -> Option<impl Simd> {
    fearless_simd::Level::new().as_neon()
}

/// Registers of the processor that hold lanes: none here.
#[cfg(not(any(target_arch = "x86", target_arch = "x86_64", target_arch = "aarch64")))]
pub(crate) fn wide() -> Option<impl Simd> {
    None::<fearless_simd::Fallback>
}

/// Runs something compiled for those registers, where there are any: the same operations, so the same bits. What is to gain
/// from it has to be inlined.
#[inline(always)]
pub(crate) fn widely<T>(compute: impl FnOnce() -> T) -> T {
    match wide() {
        Some(simd) => simd.vectorize(compute),
        None => compute(),
    }
}

const MANTISSA_BITS: u32 = f64::MANTISSA_DIGITS - 1;

/// The rows of a table, turned into lanes; a row beyond the last is the last.
#[inline(always)]
pub(crate) fn look_up<S: Simd, const N: usize, const ROWS: usize>(
    simd: S,
    table: &[[f64; N]; ROWS],
    rows: [u64; LANES],
) -> [f64x8<S>; N] {
    let mut columns = [[0.0; LANES]; N];
    for lane in 0..LANES {
        let row = &table[(rows[lane] as usize).min(ROWS - 1)];
        for i in 0..N {
            columns[i][lane] = row[i];
        }
    }
    let mut lanes = [f64x8::splat(simd, 0.0); N];
    for i in 0..N {
        lanes[i] = columns[i].simd_into(simd);
    }
    lanes
}

/// [`math::power`] of the lanes `asked`; whatever in the others.
#[inline(always)]
pub(crate) fn power<S: Simd>(x: f64x8<S>, y: f64x8<S>, asked: u64) -> f64x8<S> {
    let tiny = asked & x.simd_lt(LEAST).to_bitmask();
    let mut result = x;
    let mut alone = tiny;
    if (asked & !tiny).count_ones() > 2 {
        result = power_in_reach(x, y);
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

#[inline(always)]
fn power_in_reach<S: Simd>(x: f64x8<S>, y: f64x8<S>) -> f64x8<S> {
    let simd = x.simd;
    let nearest = x.to_bits() + (1u64 << (MANTISSA_BITS - STEPS_BITS - 1));
    let step = (nearest >> (MANTISSA_BITS - STEPS_BITS)) & (STEPS as u64 - 1);
    // The exponent with its bias of 1023.
    let exponent = nearest >> MANTISSA_BITS;
    let whole = (1u64 << MANTISSA_BITS) as f64;
    let n = f64x8::from_bits(exponent | whole.to_bits()) - (whole + 1023.0);
    let scale = f64x8::from_bits(((exponent ^ 2047) - 1) << MANTISSA_BITS);
    let c = f64x8::from_bits((step << (MANTISSA_BITS - STEPS_BITS)) | 1f64.to_bits());
    let d = x * scale - c;
    let [inverse, ln_hi, ln_lo] = look_up(simd, &LOGARITHMS, step.into());
    let r = d * inverse;
    let r2 = r * r;
    let series = (r * (1.0 / 3.0) + -0.5) + r2 * ((r * 0.2 + -0.25) + r2 * (r * (1.0 / 7.0) + -1.0 / 6.0));
    let h = n * LN_2_HI + ln_hi;
    let l = r + ((n * LN_2_LO + ln_lo) + r2 * series);
    let h1 = (h + TO_28_BITS) - TO_28_BITS;
    let y1 = (y + TO_12_BITS) - TO_12_BITS;
    let z = y1 * h1;
    let tail = (y - y1) * h1 + y * ((h - h1) + l);
    let whole = (z + tail) * (STEPS as f64 * std::f64::consts::LOG2_E) + TO_WHOLE;
    let k = whole - TO_WHOLE;
    let r = (z - k * (LN_2_HI / STEPS as f64)) + (tail - k * (LN_2_LO / STEPS as f64));
    let r2 = r * r;
    let series = (r * (1.0 / 6.0) + 0.5) + r2 * ((r * (1.0 / 120.0) + 1.0 / 24.0) + r2 * (1.0 / 720.0));
    let grown = r + r2 * series;
    let k = whole.to_bits();
    let exponent = (k >> STEPS_BITS) << MANTISSA_BITS;
    let [hi, lo] = look_up(simd, &POWERS, (k & (STEPS as u64 - 1)).into());
    let scale = f64x8::from_bits(exponent + 1f64.to_bits());
    (hi + (hi * grown + lo)) * scale
}

/// [`math::angle`].
#[inline(always)]
pub(crate) fn angle<S: Simd>(y: f64x8<S>, x: f64x8<S>) -> f64x8<S> {
    let simd = x.simd;
    let zero = f64x8::splat(simd, 0.0);
    let behind = x.simd_lt(0.0);
    let across = behind.select(-x, x);
    let steep = y.simd_gt(across);
    let (small, large) = (steep.select(across, y), steep.select(y, across));
    let t = large.simd_gt(0.0).select(small / large, zero);
    let whole = t * ANGLE_STEPS as f64 + TO_WHOLE;
    let c = (whole - TO_WHOLE) * (1.0 / ANGLE_STEPS as f64);
    let d = (t - c) / (t * c + 1.0);
    let [hi, lo] = look_up(simd, &ANGLES, (whole.to_bits() & 127u64).into());
    let d2 = d * d;
    let rest = d - d * d2 * ((d2 * -0.2 + 1.0 / 3.0) + d2 * d2 * (1.0 / 7.0));
    let rest = lo + rest;
    let (hi, rest) = (steep.select(FRAC_PI_2 - hi, hi), steep.select(FRAC_PI_2_LO - rest, rest));
    let (hi, rest) = (behind.select(PI - hi, hi), behind.select(2.0 * FRAC_PI_2_LO - rest, rest));
    hi + rest
}

/// One vector or the other.
#[inline(always)]
pub(crate) fn select<S: Simd>(
    lanes: fearless_simd::mask64x8<S>,
    a: Vec3<f64x8<S>>,
    b: Vec3<f64x8<S>>,
) -> Vec3<f64x8<S>> {
    Vec3::new(lanes.select(a.x, b.x), lanes.select(a.y, b.y), lanes.select(a.z, b.z))
}

/// From rows of four numbers, one a lane, to columns.
#[inline(always)]
pub(crate) fn columns<S: Simd>(rows: [f64x4<S>; LANES]) -> [f64x8<S>; 4] {
    let low = turned([rows[0], rows[1], rows[2], rows[3]]);
    let high = turned([rows[4], rows[5], rows[6], rows[7]]);
    [low[0].combine(high[0]), low[1].combine(high[1]), low[2].combine(high[2]), low[3].combine(high[3])]
}

/// From four columns to rows, one a lane.
#[inline(always)]
pub(crate) fn rows<S: Simd>([a, b, c, d]: [f64x8<S>; 4]) -> [f64x4<S>; LANES] {
    let ((a, a_high), (b, b_high), (c, c_high), (d, d_high)) = (a.split(), b.split(), c.split(), d.split());
    let [r0, r1, r2, r3] = turned([a, b, c, d]);
    let [r4, r5, r6, r7] = turned([a_high, b_high, c_high, d_high]);
    [r0, r1, r2, r3, r4, r5, r6, r7]
}

/// Rows for columns, columns for rows.
#[inline(always)]
fn turned<S: Simd>([a, b, c, d]: [f64x4<S>; 4]) -> [f64x4<S>; 4] {
    let (ac, bd) = (a.zip_low(c), b.zip_low(d));
    let (ac_high, bd_high) = (a.zip_high(c), b.zip_high(d));
    [ac.zip_low(bd), ac.zip_high(bd), ac_high.zip_low(bd_high), ac_high.zip_high(bd_high)]
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
            let got: [f64; LANES] = dispatch!(level, simd => { angle(y.simd_into(simd), x.simd_into(simd)).into() });
            for lane in 0..LANES {
                assert_eq!(got[lane].to_bits(), math::angle(y[lane], x[lane]).to_bits(), "{y:?} {x:?}");
            }
        }
    }
}
