//! Smooth cutaways (6.2, 7; [VS-7]): a funnel about an object, from a smoothed depth map.

use drypoint_scene::math;
use drypoint_scene::parallel;

/// c̃ and d̂ of each pixel of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct FunnelMap {
    width: usize,
    /// c̃ and d̂; c̃ = 0 where there is no cut.
    pixels: Vec<[f64; 2]>,
}

/// The least coverage c̃ that cuts.
const LEAST: f64 = 1e-6;

/// Width in pixels of the band beyond each side of the picture that a funnel's map reads: ⌊4σ⌋ + ⌊1.5σ⌋.
pub fn guard(sigma: f64) -> usize {
    (4.0 * sigma) as usize + (1.5 * sigma) as usize
}

impl FunnelMap {
    /// The map of a picture of `size`. `depths` holds the depths d of its pixels and of a guard band, row by row; −∞ if
    /// a ray misses the object. c is 1 if d is not −∞. Both are dilated by 1.5σ and smoothed by a Gaussian of σ pixels.
    /// Then d̂ = K∗(cd)/c̃.
    ///
    /// # Panics
    /// If there is not one depth for each pixel.
    pub fn new([width, height]: [usize; 2], sigma: f64, depths: &[f64]) -> Self {
        let guard = guard(sigma);
        let size = [width + 2 * guard, height + 2 * guard];
        assert_eq!(depths.len(), size[0] * size[1]);
        let dilated = dilated(size, 1.5 * sigma, depths);
        let taps = taps(sigma);
        // c and c·d, smoothed along rows, then along columns.
        let sums: Vec<[f64; 2]> =
            dilated.into_iter().map(|d| if d > f64::NEG_INFINITY { [1.0, d] } else { [0.0; 2] }).collect();
        let rows = smoothed_rows(size, &taps, &sums);
        let columns =
            transposed([size[1], size[0]], &smoothed_rows([size[1], size[0]], &taps, &transposed(size, &rows)));
        let pixel = |i: usize| {
            let [c, cd] = columns[(i / width + guard) * size[0] + i % width + guard];
            if c > LEAST { [c, cd / c] } else { [0.0; 2] }
        };
        Self { width, pixels: (0..width * height).map(pixel).collect() }
    }

    /// d̃ at a pixel, for a ray that enters the background's box at z_in: z_in + min(1, 2c̃)(d̂ − z_in). It is d itself
    /// if the ray hits the object and d is larger. It is −∞ where there is no cut.
    pub fn depth(&self, [x, y]: [usize; 2], z_in: f64, d: f64) -> f64 {
        let [c, mean] = self.pixels[y * self.width + x];
        if c <= LEAST {
            return d;
        }
        (z_in + (2.0 * c).min(1.0) * (mean - z_in)).max(d)
    }

    /// Whether a pixel is cut.
    pub fn cuts(&self, [x, y]: [usize; 2]) -> bool {
        self.pixels[y * self.width + x][0] > LEAST
    }
}

/// The largest depth within a radius of each pixel, over pixel offsets with x² + y² ≤ r².
fn dilated([width, height]: [usize; 2], radius: f64, depths: &[f64]) -> Vec<f64> {
    let reach = radius as usize;
    let half = |y: usize| ((radius * radius - (y * y) as f64).max(0.0).sqrt() as usize).min(width);
    let halves: Vec<usize> = (0..=reach).map(half).collect();
    let row = |y: usize| {
        let mut out = vec![f64::NEG_INFINITY; width];
        for other in y.saturating_sub(reach)..(y + reach + 1).min(height) {
            let (half, line) = (halves[other.abs_diff(y)], &depths[other * width..(other + 1) * width]);
            for (x, most) in out.iter_mut().enumerate() {
                let near = &line[x.saturating_sub(half)..(x + half + 1).min(width)];
                *most = near.iter().fold(*most, |most, &d| most.max(d));
            }
        }
        out
    };
    parallel::gather(height, 1, &|rows, out| rows.for_each(|y| out.extend(row(y))))
}

/// Weights of a Gaussian at −⌊4σ⌋ … ⌊4σ⌋, of sum 1.
fn taps(sigma: f64) -> Vec<f64> {
    let reach = (4.0 * sigma) as i64;
    let weights: Vec<f64> =
        (-reach..=reach).map(|i| math::exp(-0.5 * (i as f64 / sigma) * (i as f64 / sigma))).collect();
    let sum: f64 = weights.iter().sum();
    weights.into_iter().map(|w| w / sum).collect()
}

/// Each row convolved with the taps. Rows are continued by zeros.
fn smoothed_rows([width, height]: [usize; 2], taps: &[f64], pixels: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let reach = taps.len() / 2;
    let row = |y: usize| {
        let line = &pixels[y * width..(y + 1) * width];
        (0..width).map(move |x| {
            let first = x.saturating_sub(reach);
            let near = line[first..(x + reach + 1).min(width)].iter().zip(&taps[first + reach - x..]);
            near.fold([0.0; 2], |[c, cd], ([c_i, cd_i], w)| [c + c_i * w, cd + cd_i * w])
        })
    };
    parallel::gather(height, 1, &|rows, out| rows.for_each(|y| out.extend(row(y))))
}

/// Columns as rows.
fn transposed([width, height]: [usize; 2], pixels: &[[f64; 2]]) -> Vec<[f64; 2]> {
    (0..width * height).map(|i| pixels[i % height * width + i / height]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Depths of a picture and its guard band: `depth` of the pixels of the picture's coordinates.
    fn map(size: [usize; 2], sigma: f64, depth: impl Fn(i64, i64) -> f64) -> FunnelMap {
        let g = guard(sigma) as i64;
        let [w, h] = size.map(|n| n as i64 + 2 * g);
        let depths: Vec<f64> = (0..w * h).map(|i| depth(i % w - g, i / w - g)).collect();
        FunnelMap::new(size, sigma, &depths)
    }

    /// A half-plane of constant depth: c̃ is a sum of the Gaussian's taps, and the funnel falls monotonically to z_in, nowhere
    /// steeper than 2(d − z_in)/(σ√(2π)) a pixel, up to what the Gaussian lacks beyond 4σ.
    #[test]
    fn a_straight_edge_has_the_funnel_of_the_closed_form() {
        let (sigma, d, z_in) = (4.0, 10.0, 2.0);
        let funnel = map([64, 1], sigma, |x, _| if x < 20 { d } else { f64::NEG_INFINITY });
        let taps = taps(sigma);
        let edge = 20 + (1.5f64 * sigma) as i64;
        let depths: Vec<f64> = (0..64).map(|x| funnel.depth([x, 0], z_in, f64::NEG_INFINITY)).collect();
        for (x, got) in depths.iter().enumerate() {
            // The taps over the dilated half-plane.
            let c: f64 = (0..taps.len()).filter(|&i| x as i64 + i as i64 - 16 < edge).map(|i| taps[i]).sum();
            let expected = if c > LEAST { z_in + (2.0 * c).min(1.0) * (d - z_in) } else { f64::NEG_INFINITY };
            assert!(*got == expected || (got - expected).abs() < 1e-12, "{x}: {got} {expected}");
        }
        // A mean of equal depths is rounded.
        let steepest = 2.0 * (d - z_in) / (sigma * std::f64::consts::TAU.sqrt());
        let cut: Vec<f64> = depths.into_iter().filter(|d| d.is_finite()).collect();
        assert!(cut.windows(2).all(|pair| pair[1] <= pair[0] + 1e-13 && pair[0] - pair[1] <= steepest * (1.0 + 1e-4)));
        assert!(cut.len() > 20 + 6 + 8 && (cut[cut.len() - 1] - z_in).abs() < 1e-3);
    }

    #[test]
    fn the_object_itself_is_cut_to_its_own_depth() {
        let funnel = map([12, 12], 1.0, |x, y| if (x, y) == (4, 4) { 7.0 } else { f64::NEG_INFINITY });
        // The mean depth is 7 everywhere; a deeper ray keeps its own depth.
        assert_eq!(funnel.depth([4, 4], 1.0, 9.0), 9.0);
        assert!(funnel.cuts([4, 5]) && !funnel.cuts([11, 11]));
        assert_eq!(funnel.depth([11, 11], 1.0, f64::NEG_INFINITY), f64::NEG_INFINITY);
        let near = funnel.depth([4, 5], 1.0, f64::NEG_INFINITY);
        assert!(near > 1.0 && near <= 7.0 + 1e-14, "{near}");
    }

    #[test]
    fn dilation_by_hand() {
        let dot = |radius| {
            let mut depths = [f64::NEG_INFINITY; 15];
            depths[7] = 5.0;
            let found = dilated([5, 3], radius, &depths);
            found.iter().map(|&d| if d == 5.0 { '#' } else { '.' }).collect::<String>()
        };
        assert_eq!(dot(0.9), ".......#.......");
        assert_eq!(dot(1.2), "..#...###...#..");
        assert_eq!(dot(1.5), ".###..###..###.");
    }
}
