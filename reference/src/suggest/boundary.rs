//! Where the data have their strongest boundary, from a histogram of values and differences.

use drypoint_scene::volume::{Access, Volume, Voxel};
use drypoint_scene::with_access;
use rayon::prelude::*;

/// Values that a first picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Boundary {
    /// The value that separates content from its surroundings.
    pub threshold: f64,
    /// From fully transparent to fully opaque.
    pub ramp: [f64; 2],
    /// A value that separates denser content, if there is a second boundary.
    pub denser: Option<f64>,
}

const BINS: usize = 512;

/// For each value the pairs of face neighbours that it lies between: how many, and the sum of their differences.
///
/// The pairs are the area of the surface at that value; the mean difference is how sharp it is.
struct Crossings {
    lo: f64,
    width: f64,
    count: Vec<f64>,
    difference: Vec<f64>,
}

impl Boundary {
    /// The value whose surface has the greatest product of area and squared sharpness.
    pub(super) fn find(volume: &Volume) -> Self {
        let [lo, hi] = volume.range();
        if hi <= lo {
            // A constant volume: everything is content.
            return Self { threshold: lo, ramp: [lo - 1.0, lo], denser: None };
        }
        let crossings = Crossings::of(volume);
        let strength = |b: usize| {
            let n = crossings.count[b];
            if n > 0.0 { crossings.difference[b] * crossings.difference[b] / n } else { 0.0 }
        };
        let best = (0..BINS).fold(0, |best, b| if strength(b) > strength(best) { b } else { best });
        let sharpness =
            if crossings.count[best] > 0.0 { crossings.difference[best] / crossings.count[best] } else { 0.0 };
        let threshold = crossings.value(best);
        // A quarter of the step across one voxel on either side keeps the surface thin and its edge soft.
        let half = (0.25 * sharpness).clamp(crossings.width, 0.25 * (hi - lo));
        let ramp = [(threshold - half).max(lo), (threshold + half).min(hi)];
        Self { threshold, ramp, denser: crossings.denser(best, sharpness, strength) }
    }
}

impl Crossings {
    fn of(volume: &Volume) -> Self {
        let [lo, hi] = volume.range();
        let width = (hi - lo) / BINS as f64;
        let (slope, intercept) = (volume.slope(), volume.intercept());
        let [nx, ny, nz] = volume.dims();
        let bin = |v: f64| (((v - lo) / width) as usize).min(BINS - 1);
        // Increments where a pair begins and ends, summed afterwards: a pair costs the same however far it reaches.
        let steps = with_access!(volume, |a| {
            let value = |x, y, z| slope * a.at(x, y, z).to_f64() + intercept;
            (0..nz)
                .into_par_iter()
                .map(|z| {
                    let mut steps = vec![[0.0; 2]; BINS + 1];
                    let mut pair = |p: f64, q: f64| {
                        let (from, to, d) = (bin(p.min(q)), bin(p.max(q)), (p - q).abs());
                        steps[from][0] += 1.0;
                        steps[from][1] += d;
                        steps[to][0] -= 1.0;
                        steps[to][1] -= d;
                    };
                    for y in 0..ny {
                        for x in 0..nx {
                            let v = value(x, y, z);
                            if x + 1 < nx {
                                pair(v, value(x + 1, y, z));
                            }
                            if y + 1 < ny {
                                pair(v, value(x, y + 1, z));
                            }
                            if z + 1 < nz {
                                pair(v, value(x, y, z + 1));
                            }
                        }
                    }
                    steps
                })
                .collect::<Vec<_>>()
        });
        let (mut count, mut difference) = (Vec::with_capacity(BINS), Vec::with_capacity(BINS));
        let (mut n, mut d) = (0.0, 0.0);
        for b in 0..BINS {
            for slice in &steps {
                n += slice[b][0];
                d += slice[b][1];
            }
            count.push(n.max(0.0));
            difference.push(d.max(0.0));
        }
        Self { lo, width, count, difference }
    }

    /// The value at the upper end of a bin, which its pairs lie around.
    fn value(&self, bin: usize) -> f64 {
        self.lo + (bin as f64 + 1.0) * self.width
    }

    /// A second boundary above the first: a local maximum of strength, well apart and not negligible.
    fn denser(&self, first: usize, sharpness: f64, strength: impl Fn(usize) -> f64) -> Option<f64> {
        let apart = first + ((sharpness / self.width) as usize / 2).max(BINS / 16);
        let best = (apart..BINS).fold(None, |best: Option<usize>, b| match best {
            Some(a) if strength(a) >= strength(b) => best,
            _ => Some(b),
        })?;
        // On the flank of the first boundary the strongest is the nearest: that is no maximum of its own.
        (best > apart && best + 1 < BINS && strength(best) > 0.02 * strength(first)).then(|| self.value(best))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::space::Grid;
    use drypoint_scene::volume::Voxels;

    fn volume(value: impl Fn([usize; 3]) -> f64) -> Volume {
        let n = 32;
        let voxels = (0..n * n * n).map(|i| value([i % n, i / n % n, i / (n * n)])).collect();
        Volume::new(Grid::with_spacing([n; 3], [1.0; 3]).unwrap(), Voxels::F64(voxels), 1.0, 0.0).unwrap()
    }

    fn radius([x, y, z]: [usize; 3]) -> f64 {
        let square = |i: usize| (i as f64 - 15.5).powi(2);
        (square(x) + square(y) + square(z)).sqrt()
    }

    #[test]
    fn a_ball_in_noise_is_found_between_the_two() {
        // A deterministic ripple of ±5 around 20 outside and around 200 inside.
        let ripple = |p: [usize; 3]| ((p[0] * 7 + p[1] * 13 + p[2] * 29) % 11) as f64 - 5.0;
        let b = Boundary::find(&volume(|p| ripple(p) + if radius(p) < 10.0 { 200.0 } else { 20.0 }));
        assert!(b.threshold > 25.0 && b.threshold < 195.0, "{b:?}");
        assert!(b.ramp[0] < b.threshold && b.threshold < b.ramp[1]);
    }

    #[test]
    fn a_kernel_inside_a_shell_is_a_second_boundary() {
        // Smooth edges, so that the jump into the kernel does not cross the first boundary's values.
        let edge = |d: f64| 1.0 / (1.0 + (-d / 0.7).exp());
        let b = Boundary::find(&volume(|p| 100.0 * edge(13.0 - radius(p)) + 100.0 * edge(7.0 - radius(p))));
        assert!(b.threshold > 20.0 && b.threshold < 80.0, "{b:?}");
        assert!(b.denser.is_some_and(|d| d > 110.0 && d < 190.0), "{b:?}");
    }

    #[test]
    fn a_constant_volume_is_all_content() {
        let b = Boundary::find(&volume(|_| 7.0));
        assert_eq!((b.threshold, b.denser), (7.0, None));
        assert!(b.ramp[0] < b.ramp[1]);
    }
}
