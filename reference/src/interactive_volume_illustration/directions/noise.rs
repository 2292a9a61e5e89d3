//! Noise of the values at an iso-surface ([HATCH-3]).
//!
//! The rule for directions knows the rounding of stored numbers, which is the only error of a phantom. A scanner's
//! noise is up to fifty times as large, and like rounding it creates directions where there are none.

use super::super::seeds::Pyramid;
use crate::field::Outside;
use drypoint_scene::parallel;
use drypoint_scene::volume::Volume;

/// The median of |x| of a normal variable x, in standard deviations.
const MEDIAN: f64 = 0.674_489_750_196_081_7;

/// Estimates the standard deviation of a volume's noise on the inner side of the surface f = `iso`. Returns 0 if
/// there is no estimate.
///
/// The estimate uses second differences taken along each axis in turn, at one voxel of each pyramid block that holds
/// the value. For noise, each axis multiplies the standard deviation by √6. For an edge, the differences nearly
/// vanish: they cancel functions of one or two axes, and polynomials of degree below 2 along any axis. The median
/// ignores corners and points. Axes of fewer than three voxels are left out.
pub fn deviation(volume: &Volume, pyramid: &Pyramid, iso: f64, outside: Outside) -> f64 {
    let dims = volume.dims();
    let differs = dims.map(|n| n >= 3);
    let axes = differs.iter().filter(|&&differs| differs).count();
    let place = |block: [usize; 3]| {
        let at: [usize; 3] = std::array::from_fn(|a| (2 * block[a] + 1).min(dims[a] - 1));
        let whole = (0..3).all(|a| !differs[a] || at[a] + 1 < dims[a]) && !masked(volume, at);
        let value = volume.value(at);
        let inner = match outside {
            Outside::Low => value >= iso,
            Outside::High => value <= iso,
        };
        (whole && inner).then_some(at)
    };
    let blocks = pyramid.blocks(iso, None);
    let mut sizes = parallel::gather(blocks.len(), 1 << 10, &|run, sizes| {
        let places = blocks[run].iter().filter_map(|&block| place(block));
        sizes.extend(places.map(|at| difference(volume, at, differs).abs()));
    });
    sizes.retain(|size| size.is_finite());
    if axes == 0 || sizes.is_empty() {
        return 0.0;
    }
    let middle = sizes.len() / 2;
    let (_, median, _) = sizes.select_nth_unstable_by(middle, f64::total_cmp);
    (0..axes).fold(*median / MEDIAN, |size, _| size / 6f64.sqrt())
}

/// Whether a cell at a voxel touches a masked one ([PREC-2]).
fn masked(volume: &Volume, at: [usize; 3]) -> bool {
    let Some(mask) = volume.mask() else { return false };
    (0..8).any(|corner| mask.touches_cell([0, 1, 2].map(|a| at[a].saturating_sub(corner >> a & 1))))
}

/// The second difference along these axes, one after the other.
fn difference(volume: &Volume, at: [usize; 3], along: [bool; 3]) -> f64 {
    let taps =
        |axis: usize| -> &[(isize, f64)] { if along[axis] { &[(-1, 1.0), (0, -2.0), (1, 1.0)] } else { &[(0, 1.0)] } };
    let mut sum = 0.0;
    for &(k, wz) in taps(2) {
        for &(j, wy) in taps(1) {
            for &(i, wx) in taps(0) {
                let voxel = [(at[0], i), (at[1], j), (at[2], k)].map(|(at, by)| at.saturating_add_signed(by));
                sum += wx * wy * wz * volume.value(voxel);
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniforms;
    use drypoint_scene::space::Grid;
    use drypoint_scene::volume::Voxels;

    fn volume(dims: [usize; 3], value: impl Fn([usize; 3]) -> f64) -> Volume {
        let [nx, ny, _] = dims;
        let voxels = (0..dims.iter().product()).map(|i: usize| value([i % nx, i / nx % ny, i / nx / ny])).collect();
        Volume::new(Grid::with_spacing(dims, [1.0; 3]).unwrap(), Voxels::F64(voxels), 1.0, 0.0).unwrap()
    }

    fn of(volume: &Volume, iso: f64) -> f64 {
        deviation(volume, &Pyramid::new(volume), iso, Outside::Low)
    }

    /// Normal numbers (Box and Muller).
    fn normal(at: [usize; 3]) -> f64 {
        let [a, b, ..] = uniforms(7, at.map(|i| i as u32), 0);
        (-2.0 * (1.0 - a).ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }

    /// The median of n numbers |x| of normal noise has a relative standard deviation of 1.17/√n; four of these are
    /// beyond chance. About half of the blocks have their middle on the inner side.
    fn is_found(volume: &Volume, noise: f64) {
        let n = Pyramid::new(volume).blocks(0.0, None).len() as f64 / 2.0;
        let found = of(volume, 0.0);
        assert!(n > 500.0 && (found / noise - 1.0).abs() < 4.0 * 1.17 / n.sqrt(), "{found} of {n}");
    }

    #[test]
    fn the_noise_of_an_edge_is_found_in_three_dimensions_and_in_two() {
        for ([x, y, z], slope) in [([1.0, 2.0, 3.0], 3.0), ([0.0, 0.0, 1.0], 20.0), ([3.0, -1.0, 0.5], 8.0)] {
            let edge = |at: [usize; 3]| {
                let s = (x * (at[0] as f64 - 32.0) + y * (at[1] as f64 - 32.0) + z * (at[2] as f64 - 32.0))
                    / f64::sqrt(x * x + y * y + z * z);
                slope * s
            };
            let noisy = volume([64; 3], |at| edge(at) + 2.5 * normal(at));
            is_found(&noisy, 2.5);
        }
        is_found(&volume([200, 200, 1], |at| 0.25 * (at[0] as f64 - 100.0) + 2.5 * normal(at)), 2.5);
    }

    /// Differences of integers that vanish vanish exactly, and a smooth volume has no noise.
    #[test]
    fn what_is_smooth_has_none() {
        let paraboloid = volume([33; 3], |at| at.map(|i| (i as f64 - 16.0) * (i as f64 - 16.0)).iter().sum());
        assert_eq!(of(&paraboloid, 60.0), 0.0);
        assert_eq!(of(&volume([9; 3], |_| 4.0), 4.0), 0.0);
        assert_eq!(of(&volume([1; 3], |_| 4.0), 4.0), 0.0);
        assert_eq!(of(&volume([2, 2, 2], |at| at[0] as f64), 0.5), 0.0);
    }

    /// Rounding is noise of 1/√12. The estimate is exact to one step: |x| is an integer, and so is the median.
    #[test]
    fn rounding_is_found() {
        let wave = |at: [usize; 3]| {
            let [x, y, z] = at.map(|i| i as f64);
            (12.0 * ((0.11 * x).sin() + (0.13 * y + 0.4).sin() + (0.17 * z + 1.0).sin())).round()
        };
        let found = of(&volume([48; 3], wave), 0.0);
        assert!((found - 1.0 / 12f64.sqrt()).abs() < 1.0 / (MEDIAN * 6f64.powf(1.5)), "{found}");
    }

    #[test]
    fn powers_of_two_go_through() {
        let noise = |scale: f64| volume([17; 3], move |at| scale * normal(at));
        assert_eq!(of(&noise(2f64.powi(60)), 0.0), of(&noise(1.0), 0.0) * 2f64.powi(60));
    }
}
