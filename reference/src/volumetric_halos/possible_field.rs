//! The intensities of a halo that errors of its seeds leave possible ([GPU-2]).
//!
//! The median of seeds rises with each of them. So does every pass of the spreading, which is a convex mix of numbers in
//! [0, 1]. Run on the least and on the largest images, they give the least and the largest result. The gradient does not
//! rise with seeds. Its magnitude changes by at most that of the changes of both differences, and a difference of taps
//! by the mean of their changes.
//!
//! Numbers in f32 are all positive, so each rounding is relative to its result: at most twenty a pass.

use super::taps::{Border, Taps};
use super::{HaloField, Process, SpreadParams};
use crate::number::Bounded;

/// Half a unit in the last place of 1, with a little more for products of errors.
const ROUNDING: f64 = 0.5 * f32::EPSILON as f64 * (1.0 + 1e-6);

/// Roundings of a pass, relative to its result.
const OF_PASS: f64 = 20.0;

/// Roundings of the gradient's magnitude, relative to it.
const OF_GRADIENT: f64 = 32.0;

/// The seeds of a group of planes: by the values, and at least and at most.
#[derive(Clone, Debug)]
pub(crate) struct PossibleField {
    size: [usize; 2],
    spread: SpreadParams,
    pub(crate) seeds: [Vec<f64>; 3],
}

impl PossibleField {
    /// Seeds of 0. `size` is width and height with the guard band.
    pub(crate) fn new(size: [usize; 2], spread: SpreadParams) -> Self {
        Self { size, spread, seeds: std::array::from_fn(|_| vec![0.0; size[0] * size[1]]) }
    }

    /// H with its errors, from the seeds, which become 0. Returns none if no seed is possible.
    #[inline]
    pub(crate) fn generate(&mut self) -> Option<Vec<Bounded>> {
        if self.seeds[2].iter().all(|s| *s == 0.0) {
            return None;
        }
        let spread = self.spread;
        let h = self.run(&self.seeds[0], spread, Process::Spread);
        let source = SpreadParams { passes: 0, floor: 0.0, ..spread };
        let [least, most] = self.sources(source);
        let passes = SpreadParams { from_gradient: false, median: false, floor: 0.0, ..spread };
        let [least, most] = [least, most].map(|source| self.run(&source, passes, Process::Spread));
        self.seeds.iter_mut().for_each(|seeds| seeds.fill(0.0));
        let rounded = OF_PASS * ROUNDING * (f64::from(spread.passes) + 1.0);
        let pixel = |((&h, &least), &most): ((&f64, &f64), &f64)| {
            let [least, most] = [least * (1.0 - rounded), most * (1.0 + rounded)];
            if most < spread.floor {
                return Bounded::exact(h);
            }
            // At the floor f32 may find 0.
            let least = if least < spread.floor { 0.0 } else { least };
            Bounded::new(h, (most - h).max(h - least).max(0.0))
        };
        Some(h.iter().zip(&least).zip(&most).map(pixel).collect())
    }

    /// H₀ at least and at most.
    #[inline]
    fn sources(&self, source: SpreadParams) -> [Vec<f64>; 2] {
        let filtered = SpreadParams { from_gradient: false, ..source };
        let [middle, least, most] = self.seeds.each_ref().map(|seeds| match source.median {
            true => self.run(seeds, filtered, Process::Source),
            false => seeds.clone(),
        });
        if !source.from_gradient {
            return [least, most];
        }
        let g = self.run(&self.seeds[0], source, Process::Source);
        let ends = |(middle, (least, most)): (&f64, (&f64, &f64))| (most - middle).max(middle - least).max(0.0);
        let changes: Vec<f64> = middle.iter().zip(least.iter().zip(&most)).map(ends).collect();
        let [width, height] = self.size;
        let Taps { j, f } = Taps::new(source.tap(), width.max(height));
        // The mean of two taps on both sides of a pixel, of which those beyond the border are 0.
        let mean = |image: &[f64], x: usize, y: usize, [dx, dy]: [usize; 2]| {
            let at = |t: usize| {
                let before = x.checked_sub(dx * t).zip(y.checked_sub(dy * t));
                let after = Some((x + dx * t, y + dy * t)).filter(|(x, y)| *x < width && *y < height);
                let of = |place: Option<(usize, usize)>| place.map_or(0.0, |(x, y)| image[y * width + x]);
                0.5 * (of(before) + of(after))
            };
            if f > 0.0 { (1.0 - f) * at(j) + f * at(j + 1) } else { at(j) }
        };
        let pixel = |i: usize| {
            let (x, y) = (i % width, i / width);
            let both = |image: &[f64]| [[1, 0], [0, 1]].map(|axis| mean(image, x, y, axis));
            let [dx, dy] = both(&changes);
            let change = dx.hypot(dy);
            // Differences between taps are rounded relative to the seeds.
            let seeds = both(&most);
            let rounded = OF_GRADIENT * ROUNDING * (g[i] + change)
                + if f > 0.0 { 8.0 * ROUNDING * seeds[0].max(seeds[1]) } else { 0.0 };
            let change = change + rounded;
            [(g[i] - change).max(0.0), (g[i] + change).min(1.0)]
        };
        let ends: Vec<[f64; 2]> = (0..width * height).map(pixel).collect();
        [0, 1].map(|end| ends.iter().map(|ends| ends[end]).collect())
    }

    fn run(&self, seeds: &[f64], spread: SpreadParams, process: Process) -> Vec<f64> {
        let mut field = HaloField::with_border(self.size, spread, Border::Zero);
        field.seeds_mut().copy_from_slice(seeds);
        field.generate_as(process);
        field.intensities().to_vec()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniform;

    /// H of seeds anywhere between their ends lies between the ends of H, for every process.
    #[test]
    fn possible_intensities_hold_those_of_all_seeds_between() {
        let size = [31, 23];
        let unit = |i: usize, which: u32| uniform(5, [i as u32, which, 0], 0);
        for case in 0..24usize {
            let spread = SpreadParams {
                from_gradient: case % 2 == 0,
                passes: (case % 5) as u32,
                delta: [0.3, 0.8, 1.0][case % 3],
                stretch: [1.0, 1.5, 2.3][case / 3 % 3],
                median: case / 2 % 2 == 1,
                floor: [0.0, 1.0 / 255.0][case / 4 % 2],
            };
            let mut possible = PossibleField::new(size, spread);
            for i in 0..size[0] * size[1] {
                let s = if unit(i, 0) < 0.2 { unit(i, 1) } else { 0.0 };
                let error = 1e-3 * unit(i, 2);
                possible.seeds[0][i] = s;
                (possible.seeds[1][i], possible.seeds[2][i]) = ((s - error).max(0.0), (s + error).min(1.0));
            }
            let between = |which: u32| -> Vec<f64> {
                let [_, least, most] = &possible.seeds;
                (0..least.len()).map(|i| least[i] + (most[i] - least[i]) * unit(i, which)).collect()
            };
            let others = [3, 4, 5].map(|which| possible.run(&between(which), spread, Process::Spread));
            let mut largest = 0.0f64;
            let h = possible.generate().unwrap();
            for other in others {
                for (h, other) in h.iter().zip(other) {
                    assert!((other - h.value()).abs() <= h.error(), "{spread:?}: {other} {h:?}");
                    largest = largest.max(h.error());
                }
            }
            assert!(largest < 0.01, "{spread:?}: {largest}");
            assert!(possible.generate().is_none(), "no seed since");
        }
    }
}
