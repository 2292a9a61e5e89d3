//! Colours as a painter mixes them: in OKLab (Ottosson 2020), where equal steps look equal and a mixture of two hues
//! does not turn grey or bright on its way.

use drypoint::scene::color::{linear_to_oklab, linear_to_srgb, srgb_to_linear};
use std::sync::LazyLock;

/// Linear red, green and blue.
pub(super) type Linear = [f64; 3];

/// The linear light of each 8-bit code of sRGB.
static LIGHT: LazyLock<[f64; 256]> = LazyLock::new(|| std::array::from_fn(|code| srgb_to_linear(code as f64 / 255.0)));

/// The linear light of an `#rrggbb` colour in sRGB.
pub(super) fn linear(rgb: u32) -> Linear {
    [rgb >> 16 & 255, rgb >> 8 & 255, rgb & 255].map(|c| LIGHT[c as usize])
}

/// L, a, b of OKLab.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Paint([f64; 3]);

impl Paint {
    /// From the 24 bits of an `#rrggbb` colour in sRGB.
    pub(super) fn hex(rgb: u32) -> Self {
        Self::linear(linear(rgb))
    }

    /// From linear sRGB.
    pub(super) fn linear(color: Linear) -> Self {
        Self(linear_to_oklab(color))
    }

    /// As sRGB in [0, 1]; what lies outside the gamut is clamped.
    pub(super) fn srgb(self) -> [f64; 3] {
        let [lightness, a, b] = self.0;
        let [l, m, s] = [
            lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b,
            lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b,
            lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b,
        ]
        .map(|c| c * c * c);
        [
            4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
            -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
            -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701_0 * s,
        ]
        .map(|c| linear_to_srgb(c.clamp(0.0, 1.0)))
    }

    /// How far two colours are apart, about 0.02 where one can just see it.
    #[cfg(test)]
    pub(super) fn difference(self, other: Self) -> f64 {
        (0..3).map(|c| (self.0[c] - other.0[c]).powi(2)).sum::<f64>().sqrt()
    }

    /// This colour with the share `t` of another laid over it.
    pub(super) fn over(self, other: Self, t: f64) -> Self {
        Self(std::array::from_fn(|c| self.0[c] + t * (other.0[c] - self.0[c])))
    }
}

/// A run of colours over [0, 1], smooth through its stops.
pub(super) struct Ramp(Vec<(f64, Paint)>);

impl Ramp {
    /// From stops (position, `0xrrggbb`) in increasing order.
    pub(super) fn new(stops: &[(f64, u32)]) -> Self {
        Self(stops.iter().map(|&(t, rgb)| (t, Paint::hex(rgb))).collect())
    }

    /// The colour at t: a cubic through each pair of stops whose slopes never overshoot (Steffen 1990), so that no
    /// stop shows as an edge and no channel leaves the range of its stops. The end colours hold beyond the ends.
    pub(super) fn at(&self, t: f64) -> Paint {
        let stops = &self.0;
        let k = stops.partition_point(|(at, _)| *at <= t);
        if k == 0 || k == stops.len() {
            return stops[k.saturating_sub(1)].1;
        }
        let (left, right) = (k - 1, k);
        let h = stops[right].0 - stops[left].0;
        let u = (t - stops[left].0) / h;
        Paint(std::array::from_fn(|c| {
            let (a, b) = (stops[left].1.0[c], stops[right].1.0[c]);
            let [p, q] = [left, right].map(|at| self.slope(at, c) * h);
            let rest = u - 1.0;
            a * (1.0 + 2.0 * u) * rest * rest + b * u * u * (3.0 - 2.0 * u) + p * u * rest * rest + q * u * u * rest
        }))
    }

    /// The slope of channel c at a stop; 0 at the ends, which meet the constants beyond them.
    fn slope(&self, at: usize, c: usize) -> f64 {
        if at == 0 || at + 1 == self.0.len() {
            return 0.0;
        }
        let [before, here, after] = [at - 1, at, at + 1].map(|k| (self.0[k].0, self.0[k].1.0[c]));
        let (h0, h1) = (here.0 - before.0, after.0 - here.0);
        let (s0, s1) = ((here.1 - before.1) / h0, (after.1 - here.1) / h1);
        if s0 * s1 <= 0.0 {
            return 0.0;
        }
        let parabola = (s0 * h1 + s1 * h0) / (h0 + h1);
        s0.signum() * parabola.abs().min(2.0 * s0.abs()).min(2.0 * s1.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_come_back() {
        for rgb in [0x000000, 0xffffff, 0xff0000, 0x00ff00, 0x0000ff, 0x6e3318, 0x93d9dd] {
            let back = Paint::hex(rgb).srgb().map(|c| (c * 255.0).round() as u32);
            assert_eq!(back[0] << 16 | back[1] << 8 | back[2], rgb);
        }
    }

    #[test]
    fn white_and_red_are_ottossons() {
        // Published with the space: white is (1, 0, 0); red's XYZ gives L 0.628, a 0.225, b 0.126.
        for (rgb, lab) in [(0xffffff, [1.0, 0.0, 0.0]), (0xff0000, [0.628, 0.225, 0.126])] {
            let Paint(found) = Paint::hex(rgb);
            assert!((0..3).all(|c| (found[c] - lab[c]).abs() < 5e-4), "{found:?}");
        }
    }

    #[test]
    fn ramps_go_through_their_stops_and_never_overshoot() {
        let stops = [(0.1, 0x2f1408), (0.3, 0x803010), (0.35, 0xc08040), (0.9, 0xfff0e0)];
        let ramp = Ramp::new(&stops);
        for (t, rgb) in stops {
            let (Paint(found), Paint(stop)) = (ramp.at(t), Paint::hex(rgb));
            assert!((0..3).all(|c| (found[c] - stop[c]).abs() < 1e-15), "{t}");
        }
        assert_eq!((ramp.at(0.0), ramp.at(1.0)), (Paint::hex(stops[0].1), Paint::hex(stops[3].1)));
        let lightness: Vec<f64> = (0..=1000).map(|k| ramp.at(f64::from(k) / 1000.0).0[0]).collect();
        assert!(lightness.windows(2).all(|pair| pair[0] <= pair[1]));
    }

    #[test]
    fn ramps_have_no_edges() {
        // One-sided slopes at the inner stops agree: to h times half the second derivative, below 300 here.
        let ramp = Ramp::new(&[(0.0, 0x2f1408), (0.3, 0x803010), (0.5, 0xc08040), (1.0, 0xfff0e0)]);
        let h = 1e-6;
        for t in [0.3, 0.5] {
            let [Paint(before), Paint(here), Paint(after)] = [t - h, t, t + h].map(|t| ramp.at(t));
            for c in 0..3 {
                assert!((after[c] - 2.0 * here[c] + before[c]).abs() / h < 300.0 * h + 1e-9, "{t}");
            }
        }
    }
}
