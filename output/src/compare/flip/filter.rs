//! The filters of FLIP (sections 4.1 and 4.2) and separable convolution with them.
//!
//! Every filter of the paper is a product of a function of x and one of y, or a sum of two such products. Two passes of
//! one dimension therefore give the same result at less cost.

use drypoint_scene::math;
use std::f64::consts::PI;

/// Gaussians of the contrast sensitivity of the opponent channels, g(d) = a √(π/b) exp(−π² d²/b) of the distance d in
/// degrees. Each pair is the amplitude a and the width b in degrees squared.
const Y: (f64, f64) = (1.0, 0.0047);
const CX: (f64, f64) = (1.0, 0.0053);
const CZ: [(f64, f64); 2] = [(34.1, 0.04), (13.5, 0.025)];

/// Width w of the features that the eye detects best, in degrees.
const FEATURE_WIDTH: f64 = 0.082;

/// One-dimensional weights, an odd number of each, with the middle weight at the pixel itself.
pub(super) struct Kernels {
    /// Sums to 1.
    pub y: Vec<f64>,
    /// Sums to 1.
    pub cx: Vec<f64>,
    /// Two Gaussians, each applied along x and y. The squares of their sums add up to 1.
    pub cz: [Vec<f64>; 2],
    /// Sums to 1.
    pub gaussian: Vec<f64>,
    /// First derivative of a Gaussian. Its positive weights sum to 1 and its negative ones to −1.
    pub edge: Vec<f64>,
    /// Second derivative of a Gaussian, with the same sums.
    pub point: Vec<f64>,
}

impl Kernels {
    /// Returns the weights for a viewing distance.
    pub(super) fn new(pixels_per_degree: f64) -> Self {
        // Three standard deviations of the widest Gaussian of section 4.1, b = 0.04: σ² = b/2π².
        let radius = (3.0 * (CZ[0].1 / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil();
        let degrees = |i: f64| i / pixels_per_degree;
        let [y, cx] = [Y, CX].map(|(_, b)| unit_sum(weights(radius, |i| bell(degrees(i), b))));
        // In two dimensions each Gaussian has the amplitude a √(π/b). Each dimension gets the square root of it.
        let cz = CZ.map(|(a, b)| weights(radius, |i| (a * (PI / b).sqrt()).sqrt() * bell(degrees(i), b)));
        let volume: f64 = cz.iter().map(|kernel| kernel.iter().sum::<f64>()).map(|sum| sum * sum).sum();
        let cz = cz.map(|kernel| kernel.into_iter().map(|w| w / volume.sqrt()).collect());

        let sigma = 0.5 * FEATURE_WIDTH * pixels_per_degree;
        let radius = (3.0 * sigma).ceil();
        let gauss = |i: f64| math::exp(-i * i / (2.0 * sigma * sigma));
        Self {
            y,
            cx,
            cz,
            gaussian: unit_sum(weights(radius, gauss)),
            edge: unit_signs(weights(radius, |i| -i * gauss(i))),
            point: unit_signs(weights(radius, |i| (i * i / (sigma * sigma) - 1.0) * gauss(i))),
        }
    }
}

/// exp(−π² d²/b).
fn bell(d: f64, b: f64) -> f64 {
    math::exp(-PI * PI * d * d / b)
}

/// Returns f at the integers −radius … radius.
pub(in crate::compare) fn weights(radius: f64, f: impl Fn(f64) -> f64) -> Vec<f64> {
    let radius = radius as i32;
    (-radius..=radius).map(|i| f(f64::from(i))).collect()
}

pub(in crate::compare) fn unit_sum(kernel: Vec<f64>) -> Vec<f64> {
    let sum: f64 = kernel.iter().sum();
    kernel.into_iter().map(|w| w / sum).collect()
}

fn unit_signs(kernel: Vec<f64>) -> Vec<f64> {
    let sum = |sign: f64| kernel.iter().map(|w| (w * sign).max(0.0)).sum::<f64>();
    let (positive, negative) = (sum(1.0), sum(-1.0));
    kernel.iter().map(|&w| if w > 0.0 { w / positive } else { w / negative }).collect()
}

/// Correlates a plane with `along_x` in each row, then with `along_y` in each column. Beyond the border the outermost
/// pixels repeat.
pub(in crate::compare) fn separable(
    plane: &[f64],
    width: usize,
    height: usize,
    along_x: &[f64],
    along_y: &[f64],
) -> Vec<f64> {
    let inside = |i: usize, k: usize, radius: usize, n: usize| (i + k).saturating_sub(radius).min(n - 1);
    let radius = along_x.len() / 2;
    let mut rows = Vec::with_capacity(plane.len());
    let mut padded = vec![0.0; width + 2 * radius];
    for row in plane.chunks_exact(width) {
        for (i, p) in padded.iter_mut().enumerate() {
            *p = row[inside(i, 0, radius, width)];
        }
        rows.extend(padded.windows(along_x.len()).map(|w| w.iter().zip(along_x).map(|(a, b)| a * b).sum::<f64>()));
    }
    let radius = along_y.len() / 2;
    let mut result = vec![0.0; plane.len()];
    for (y, out) in result.chunks_exact_mut(width).enumerate() {
        for (k, weight) in along_y.iter().enumerate() {
            let from = inside(y, k, radius, height) * width;
            for (o, r) in out.iter_mut().zip(&rows[from..from + width]) {
                *o += weight * r;
            }
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::flip::PIXELS_PER_DEGREE;

    fn near(found: f64, expected: f64) {
        // Some twenty roundings of numbers up to 1.
        assert!((found - expected).abs() < 1e-14, "{found} for {expected}");
    }

    #[test]
    fn kernels_are_normalized_and_have_the_papers_radii() {
        let k = Kernels::new(PIXELS_PER_DEGREE);
        // 3·√(0.04/2π²)·67.02 = 9.05 and 3·½·0.082·67.02 = 8.24, rounded up.
        assert_eq!((k.y.len(), k.cz[0].len(), k.gaussian.len()), (21, 21, 19));
        for kernel in [&k.y, &k.cx, &k.gaussian] {
            near(kernel.iter().sum(), 1.0);
        }
        let sums = k.cz.each_ref().map(|kernel| kernel.iter().sum::<f64>());
        near(sums[0] * sums[0] + sums[1] * sums[1], 1.0);
        for kernel in [&k.edge, &k.point] {
            near(kernel.iter().filter(|w| **w > 0.0).sum(), 1.0);
            near(kernel.iter().sum(), 0.0);
        }
        for (left, right) in k.edge.iter().zip(k.edge.iter().rev()) {
            near(*left, -right);
        }
    }

    #[test]
    fn convolution_by_hand() {
        // Rows [1 2 4], [8 16 32]: along x with (¼, ½, ¼) and repeated borders, then along y with (0, 1, 3).
        let plane = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0];
        let rows = separable(&plane, 3, 2, &[0.25, 0.5, 0.25], &[1.0]);
        assert_eq!(rows, [1.25, 2.25, 3.5, 10.0, 18.0, 28.0]);
        let both = separable(&plane, 3, 2, &[0.25, 0.5, 0.25], &[0.0, 1.0, 3.0]);
        assert_eq!(both, [31.25, 56.25, 87.5, 40.0, 72.0, 112.0]);
        // A picture smaller than the kernel.
        near(separable(&[3.0], 1, 1, &[0.2; 5], &[1.0])[0], 3.0);
    }
}
