//! The power of points in a square at whole waves across it, by a fast Fourier transform of the points spread over a grid
//! with Gaussians (L. Greengard and J.-Y. Lee, *Accelerating the nonuniform fast Fourier transform*, SIAM Review 46, 2004).

use drypoint::scene::glam::DVec2;
use drypoint::scene::math::{cos, exp, sin};
use std::f64::consts::{PI, TAU};

/// Grid points to either side that a point is spread over: good for 10⁻⁶ of its amplitude.
const REACH: i64 = 6;

/// Powers |Σ exp(−2πi f·p)|²/n at the frequencies of `i` and `j` waves across the square, |i| ≤ most and 0 ≤ j ≤ most.
pub(super) struct Spectrum {
    most: i64,
    power: Vec<f64>,
}

impl Spectrum {
    /// Of points in [−half, half]².
    pub(super) fn new(points: &[DVec2], half: f64, most: usize) -> Self {
        // Twice as many grid points as waves and more.
        let n = (4 * most + 2).next_power_of_two();
        let step = TAU / n as f64;
        // The best width for twice oversampling.
        let tau = PI * REACH as f64 / (n as f64 * n as f64) * 4.0 / 3.0;
        let mut grid = vec![[0.0; 2]; n * n];
        for p in points {
            let at = (p / (2.0 * half)) * TAU;
            let near = (at / step).round();
            let weights = |x: f64, near: f64| {
                (-REACH..=REACH).map(move |k| exp(-(x - (near + k as f64) * step).powi(2) / (4.0 * tau)))
            };
            let index = |near: f64, k: usize| (near as i64 + k as i64 - REACH).rem_euclid(n as i64) as usize;
            let across: Vec<f64> = weights(at.x, near.x).collect();
            for (j, wy) in weights(at.y, near.y).enumerate() {
                let row = index(near.y, j) * n;
                for (i, wx) in across.iter().enumerate() {
                    grid[row + index(near.x, i)][0] += wx * wy;
                }
            }
        }
        grid.chunks_exact_mut(n).for_each(transform);
        let mut columns = vec![[0.0; 2]; n * n];
        for (i, value) in grid.iter().enumerate() {
            columns[i % n * n + i / n] = *value;
        }
        columns.chunks_exact_mut(n).for_each(transform);
        // Of one axis; what a Gaussian takes from a wave is given back.
        let whole = |k: i64| (PI / tau).sqrt() / n as f64 * exp((k * k) as f64 * tau);
        let most = most as i64;
        let place = |k: i64| k.rem_euclid(n as i64) as usize;
        let power = |(i, j): (i64, i64)| {
            let [re, im] = columns[place(i) * n + place(j)];
            (re * re + im * im) * (whole(i) * whole(j)).powi(2) / points.len() as f64
        };
        let power = (0..=most).flat_map(|j| (-most..=most).map(move |i| (i, j))).map(power).collect();
        Self { most, power }
    }

    /// Each frequency of the upper half plane once, in waves across the square, with its power.
    pub(super) fn each(&self) -> impl Iterator<Item = (DVec2, f64)> {
        let all = (0..=self.most).flat_map(|j| (-self.most..=self.most).map(move |i| (i, j))).zip(&self.power);
        all.filter(|((i, j), _)| *j > 0 || *i > 0).map(|((i, j), &power)| (DVec2::new(i as f64, j as f64), power))
    }
}

/// The discrete Fourier transform of a power of two of complex numbers, in place.
fn transform(x: &mut [[f64; 2]]) {
    let n = x.len();
    let bits = n.trailing_zeros();
    for i in 0..n {
        let j = i.reverse_bits() >> (usize::BITS - bits);
        if i < j {
            x.swap(i, j);
        }
    }
    let mut half = 1;
    while half < n {
        let turns: Vec<[f64; 2]> = (0..half).map(|k| -PI * k as f64 / half as f64).map(|a| [cos(a), sin(a)]).collect();
        for block in x.chunks_exact_mut(2 * half) {
            let (a, b) = block.split_at_mut(half);
            for ((a, b), w) in a.iter_mut().zip(b).zip(&turns) {
                let t = [b[0] * w[0] - b[1] * w[1], b[0] * w[1] + b[1] * w[0]];
                (*a, *b) = ([a[0] + t[0], a[1] + t[1]], [a[0] - t[0], a[1] - t[1]]);
            }
        }
        half *= 2;
    }
}

/// Against the sum itself.
#[test]
fn a_spectrum_is_the_sum_of_waves() {
    let uniform = |i| drypoint::scene::philox::uniforms(4, [i, 0, 0], 0);
    let points: Vec<DVec2> = (0..60).map(uniform).map(|[x, y, ..]| DVec2::new(6.0 * x - 3.0, 6.0 * y - 3.0)).collect();
    for (f, power) in Spectrum::new(&points, 3.0, 13).each() {
        let phase = |p: &DVec2| TAU * f.dot(*p) / 6.0;
        let re: f64 = points.iter().map(|p| cos(phase(p))).sum();
        let im: f64 = points.iter().map(|p| sin(phase(p))).sum();
        let wanted = (re * re + im * im) / 60.0;
        // 10⁻⁶ of each of 60 amplitudes, squared with a sum of at most 60: 2·60·60·10⁻⁶/60.
        assert!((power - wanted).abs() < 1.2e-4, "{f}: {power} {wanted}");
    }
}
