//! Irregularity that is a function of place alone: gradient noise over Philox ([RAY-4]), so that a style is the same
//! picture on every machine.
//!
//! K. Perlin: Improving noise. ACM Transactions on Graphics 21(3), 2002, for the fade curve; the gradients are drawn
//! from Philox at each corner of the grid instead of from a permutation.

use drypoint::scene::philox::uniforms;
use drypoint_reference::number::Vec3;

/// The key of all noise of the gallery.
const SEED: u64 = 0x5354_5946;

/// What a field of noise is for: its draw number, so that no two share their numbers. Octave k of a field adds
/// 256·k to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Draw {
    /// The tooth of paper.
    Tooth = 0,
    /// The unsteadiness of a hand: where borders and strokes wander.
    Hand = 1,
    /// Pigment that settles in pools.
    Pool = 2,
    /// The mottling of tissue and stone.
    Mottle = 3,
    /// Fibres and scratches.
    Fibre = 4,
    /// The pressure of a stroke.
    Pressure = 5,
}

/// Gradient noise at (x, y): 0 at the corners of the unit grid, in [−1, 1], with two continuous derivatives.
pub(super) fn noise(x: f64, y: f64, draw: u32) -> f64 {
    let (left, top) = (x.floor(), y.floor());
    let (u, v) = (x - left, y - top);
    // The slope times the way from a corner, for slopes from a square around 0.
    let corner = |i: i32, j: i32| {
        let cell = [left as i32 + i, top as i32 + j].map(|c| c as u32);
        let [gx, gy, ..] = uniforms(SEED, [cell[0], cell[1], 0], draw);
        (2.0 * gx - 1.0) * (u - f64::from(i)) + (2.0 * gy - 1.0) * (v - f64::from(j))
    };
    let fade = |t: f64| t * t * t * (t * (6.0 * t - 15.0) + 10.0);
    let across = |j: i32| {
        let (a, b) = (corner(0, j), corner(1, j));
        a + fade(u) * (b - a)
    };
    let (a, b) = (across(0), across(1));
    a + fade(v) * (b - a)
}

/// Noise in octaves, each of twice the frequency and half the height: about [−1, 1], 0 in the mean.
pub(super) fn fractal(x: f64, y: f64, octaves: u32, draw: Draw) -> f64 {
    let (mut sum, mut scale, mut height) = (0.0, 1.0, 1.0);
    for octave in 0..octaves {
        sum += height * noise(scale * x, scale * y, draw as u32 + 256 * octave);
        scale *= 2.0;
        height *= 0.5;
    }
    // The largest value of one octave is seldom above 0.7.
    sum * 1.4 / (2.0 - 2.0 * height)
}

/// Where a place of the sphere lies on a plane that keeps angles: N_xy/(1 + N_z), stereographic. Noise over it clings
/// to the form, while noise over N_xy lies in the plane of the paper.
pub(super) fn on_form(n: Vec3<f64>) -> (f64, f64) {
    (n.x / (1.0 + n.z), n.y / (1.0 + n.z))
}

/// Where a place of the form lies along and across fibres that run up to the right.
pub(super) fn on_fibres(n: Vec3<f64>) -> (f64, f64) {
    let (x, y) = on_form(n);
    (0.82 * x + 0.57 * y, 0.82 * y - 0.57 * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_zero_on_the_grid_and_bounded_and_smooth() {
        for k in 0..2000 {
            let (x, y) = (f64::from(k) * 0.137 - 50.0, f64::from(k) * 0.071 - 30.0);
            assert_eq!(noise(x.floor(), y.floor(), 3), 0.0);
            assert!(noise(x, y, 3).abs() <= 1.0);
            // The slope is below 2 · 1.875 (fade's steepest) + 2.
            assert!((noise(x + 1e-6, y, 3) - noise(x, y, 3)).abs() < 6e-6);
        }
    }

    #[test]
    fn noise_has_no_mean_and_fields_are_strangers() {
        let mut sums = [0.0; 4];
        let count = 40_000;
        for k in 0..count {
            let (x, y) = (f64::from(k % 200) * 0.37, f64::from(k / 200) * 0.37);
            let (a, b) = (fractal(x, y, 3, Draw::Tooth), fractal(x, y, 3, Draw::Hand));
            for (sum, term) in sums.iter_mut().zip([a, a * a, b * b, a * b]) {
                *sum += term / f64::from(count);
            }
        }
        let [mean, aa, bb, ab] = sums;
        // About 5500 cells of the grid: means and correlations within five standard errors.
        assert!(mean.abs() < 5.0 * aa.sqrt() / 5500f64.sqrt(), "{mean}");
        assert!(ab.abs() < 5.0 * (aa * bb).sqrt() / 5500f64.sqrt(), "{ab}");
        assert!((0.1..0.5).contains(&aa.sqrt()), "{aa}");
    }
}
