//! Statistics of the surface at each value, from one pass over the voxels.

use drypoint_scene::math;
use drypoint_scene::parallel;
use drypoint_scene::shot::Outside;
use drypoint_scene::volume::histogram::Histogram;
use drypoint_scene::volume::{Access, Volume, Voxel};
use drypoint_scene::with_access;

/// The surface at one value. Lengths and areas are in voxels and their faces, differences in shares of the range.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Level {
    /// Number of pairs of face neighbours with the value in between.
    pub area: f64,
    /// Mean difference of these pairs: the change of the values in one voxel.
    pub step: f64,
    /// Share of the differences that the voxels before and after each pair confirm: 1 at a clean boundary, 0 in
    /// noise.
    pub agreement: f64,
    /// Share of all voxels that are inside.
    pub inside: f64,
    /// Share of the voxels on the faces of the box that are inside: content that the box cuts.
    pub cut: f64,
    /// Area of a surface that could enclose the same volume, over this one's area; a cube's is 1/6.
    pub simplicity: f64,
}

/// The levels of a volume between two values.
#[derive(Clone, Debug)]
pub(super) struct Levels {
    lo: f64,
    hi: f64,
    outside: Outside,
    voxels: f64,
    levels: Vec<Level>,
}

/// Number of levels.
pub(super) const LEVELS: usize = 256;

/// Increments at the bins where pairs begin and end, so that a pair costs the same for any distance.
#[derive(Clone)]
struct BinSums {
    /// Pairs, their differences, and the confirmed part of the differences.
    pairs: Vec<[f64; 3]>,
    voxels: Vec<f64>,
    on_faces: Vec<f64>,
}

impl Levels {
    /// Counts the levels of a volume. If `outside` is high, values are mirrored, so that the inside is above. Returns
    /// none if all voxels have one value.
    pub(super) fn of(volume: &Volume, outside: Outside) -> Option<Self> {
        let [lo, hi] = robust_range(volume);
        let per_half = 1.0 / half(lo, hi);
        if !(hi > lo && per_half.is_finite() && per_half > 0.0) {
            return None;
        }
        let (slope, intercept) = (volume.slope(), volume.intercept());
        let share = |value: f64| {
            let u = (half(lo, slope * value + intercept) * per_half).clamp(0.0, 1.0);
            if outside == Outside::Low { u } else { 1.0 - u }
        };
        let dims = volume.dims();
        let slices = with_access!(volume, |a| sums(dims, &|z| SliceShares::new(a, z, share)));
        Some(Self { lo, hi, outside, voxels: volume.grid().len() as f64, levels: levels(&slices) })
    }

    /// All levels, from the outside inwards.
    pub(super) fn all(&self) -> &[Level] {
        &self.levels
    }

    /// The data value in the middle of a level, or at a share of the range from the outside.
    pub(super) fn value(&self, share: f64) -> f64 {
        let u = if self.outside == Outside::Low { share } else { 1.0 - share };
        2.0 * (0.5 * self.lo + u * half(self.lo, self.hi))
    }

    /// The share of the range at which a value lies, from the outside.
    pub(super) fn share(&self, value: f64) -> f64 {
        let u = (half(self.lo, value) / half(self.lo, self.hi)).clamp(0.0, 1.0);
        if self.outside == Outside::Low { u } else { 1.0 - u }
    }

    /// Converts a share of the range to a difference of data values. An overflow gives the largest number.
    pub(super) fn difference(&self, share: f64) -> f64 {
        (2.0 * (share * half(self.lo, self.hi))).min(f64::MAX)
    }

    /// Returns the surfaces as seen from the other side, with inside and outside exchanged.
    pub(super) fn mirrored(&self) -> Self {
        let outside = match self.outside {
            Outside::Low => Outside::High,
            Outside::High => Outside::Low,
        };
        // Level b is the surface at the upper end of its bin. Nothing lies beyond the last level.
        let other_side = |level: &Level| {
            let inside = 1.0 - level.inside;
            if level.area < 0.5 {
                return Level { inside, ..Level::default() };
            }
            Level { inside, cut: 1.0 - level.cut, simplicity: simplicity(inside * self.voxels, level.area), ..*level }
        };
        let levels = self.levels[..LEVELS - 1].iter().rev().map(other_side).chain([Level::default()]).collect();
        Self { outside, levels, ..*self }
    }

    /// The level at a share of the range.
    pub(super) fn at(&self, share: f64) -> &Level {
        &self.levels[bin(share)]
    }
}

/// Half the difference of two values; the whole difference may overflow.
fn half(from: f64, to: f64) -> f64 {
    0.5 * to - 0.5 * from
}

/// Area of a surface that could enclose so many voxels, over another area.
fn simplicity(inside: f64, area: f64) -> f64 {
    (math::pow(inside, 2.0 / 3.0) / area).min(1.0 / 6.0)
}

fn bin(share: f64) -> usize {
    ((share * LEVELS as f64) as usize).min(LEVELS - 1)
}

/// The voxels of a slice across z: shares of the range from the outside, and bins.
struct SliceShares {
    shares: Vec<f64>,
    bins: Vec<u16>,
}

impl SliceShares {
    fn new<A: Access>(voxels: A, z: usize, share: impl Fn(f64) -> f64) -> Self {
        let [nx, ny, _] = voxels.dims();
        let mut shares = Vec::with_capacity(nx * ny);
        for y in 0..ny {
            shares.extend((0..nx).map(|x| share(voxels.at(x, y, z).to_f64())));
        }
        let bins = shares.iter().map(|&u| bin(u) as u16).collect();
        Self { shares, bins }
    }
}

/// Number of consecutive slices for one thread, which reads three more.
const THICKNESS: usize = 8;

/// The sums of each slice.
fn sums([nx, ny, nz]: [usize; 3], slice: &(dyn Fn(usize) -> SliceShares + Sync)) -> Vec<BinSums> {
    // Four voxels in a row along an axis; the border's voxel replaces those outside.
    let around = |i: usize, n: usize| [i.saturating_sub(1), i, i + 1, i + 2].map(|i| i.min(n - 1));
    // A thread walks through consecutive slices with a window of four, and adds each voxel and its three forward
    // pairs.
    let part = |part: usize| {
        let first = part * THICKNESS;
        let mut slices = around(first, nz).map(slice);
        (first..nz.min(first + THICKNESS)).map(move |z| {
            if z > first {
                slices.rotate_left(1);
                slices[3] = slice((z + 2).min(nz - 1));
            }
            let mut sums = BinSums::default();
            let here = &slices[1];
            for y in 0..ny {
                let rows = around(y, ny).map(|y| y * nx);
                for x in 0..nx {
                    let i = rows[1] + x;
                    sums.voxel(here.bins[i], [(x, nx), (y, ny), (z, nz)]);
                    if x + 1 < nx {
                        let row = around(x, nx).map(|x| rows[1] + x);
                        sums.pair([here.bins[i], here.bins[i + 1]], || row.map(|i| here.shares[i]));
                    }
                    if y + 1 < ny {
                        let row = rows.map(|row| row + x);
                        sums.pair([here.bins[i], here.bins[row[2]]], || row.map(|i| here.shares[i]));
                    }
                    if z + 1 < nz {
                        let row = [0, 1, 2, 3];
                        sums.pair([here.bins[i], slices[2].bins[i]], || row.map(|s| slices[s].shares[i]));
                    }
                }
            }
            sums
        })
    };
    parallel::gather(nz.div_ceil(THICKNESS), 1, &|parts, sums| parts.for_each(|i| sums.extend(part(i))))
}

impl Default for BinSums {
    fn default() -> Self {
        Self { pairs: vec![[0.0; 3]; LEVELS], voxels: vec![0.0; LEVELS], on_faces: vec![0.0; LEVELS] }
    }
}

impl BinSums {
    #[inline(always)]
    fn voxel(&mut self, bin: u16, place: [(usize, usize); 3]) {
        self.voxels[usize::from(bin)] += 1.0;
        // A corner lies on three faces. An axis of one voxel has no faces that cut.
        let on_face = |(i, n): (usize, usize)| n > 1 && (i == 0 || i + 1 == n);
        let faces = place.into_iter().filter(|&p| on_face(p)).count();
        if faces > 0 {
            self.on_faces[usize::from(bin)] += faces as f64;
        }
    }

    /// Adds the middle pair of four voxels in a row. p and q are the pair's bins.
    #[inline(always)]
    fn pair(&mut self, [p, q]: [u16; 2], shares: impl FnOnce() -> [f64; 4]) {
        if p != q {
            self.step(usize::from(p.min(q)), usize::from(p.max(q)), shares());
        }
    }

    fn step(&mut self, from: usize, to: usize, [before, p, q, after]: [f64; 4]) {
        let (step, wide) = (q - p, after - before);
        let confirmed = step.abs().min(wide.abs()) * if step * wide > 0.0 { 1.0 } else { -1.0 };
        for (c, amount) in [1.0, step.abs(), confirmed].into_iter().enumerate() {
            self.pairs[from][c] += amount;
            self.pairs[to][c] -= amount;
        }
    }
}

/// Running sums over the bins, slice by slice, so that the order of additions is fixed.
fn levels(slices: &[BinSums]) -> Vec<Level> {
    let total = |column: &dyn Fn(&BinSums) -> f64| slices.iter().map(column).sum::<f64>();
    let all = total(&|s| s.voxels.iter().sum());
    let all_on_faces = total(&|s| s.on_faces.iter().sum());
    let (mut inside, mut on_faces) = (all, all_on_faces);
    let mut pairs = [0.0f64; 3];
    (0..LEVELS)
        .map(|b| {
            for (c, sum) in pairs.iter_mut().enumerate() {
                *sum += total(&|s| s.pairs[b][c]);
            }
            inside -= total(&|s| s.voxels[b]);
            on_faces -= total(&|s| s.on_faces[b]);
            let [area, steps, confirmed] = pairs;
            if area < 0.5 {
                // Sums of differences leave rounding errors; counts are exact.
                return Level { inside: inside / all, ..Level::default() };
            }
            Level {
                area,
                step: steps / area,
                agreement: (confirmed / steps).clamp(0.0, 1.0),
                inside: inside / all,
                cut: if all_on_faces > 0.0 { on_faces / all_on_faces } else { 0.0 },
                simplicity: simplicity(inside, area),
            }
        })
        .collect()
}

/// The volume's range, or the range of nearly all voxels if a few outliers would merge all others into the same
/// levels.
fn robust_range(volume: &Volume) -> [f64; 2] {
    /// Share of the voxels that may lie beyond either end.
    const BEYOND: f64 = 5e-4;
    let [lo, hi] = volume.range();
    let histogram = Histogram::new(volume, 4096);
    let beyond = BEYOND * histogram.total() as f64;
    let mut sum = 0.0;
    let (mut first, mut last) = (0, histogram.bins.len() - 1);
    for (b, &n) in histogram.bins.iter().enumerate() {
        if sum <= beyond {
            first = b;
        }
        sum += n as f64;
        if sum >= histogram.total() as f64 - beyond {
            last = b;
            break;
        }
    }
    // A few voxels of content in an empty volume are not outliers: the rest would have one value.
    if first == last && one_value(volume, histogram.edges(first)) {
        return [lo, hi];
    }
    let [most_lo, most_hi] = [histogram.edges(first)[0], histogram.edges(last)[1]];
    if half(most_lo, most_hi) < half(lo, hi) / 16.0 { [most_lo, most_hi] } else { [lo, hi] }
}

/// Whether all voxels between two values have the same value.
fn one_value(volume: &Volume, [lo, hi]: [f64; 2]) -> bool {
    let (slope, intercept) = (volume.slope(), volume.intercept());
    let [nx, ny, nz] = volume.dims();
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    let slices = with_access!(volume, |a| parallel::map(nz, &|z| {
        let values = (0..nx * ny).map(|i| slope * a.at(i % nx, i / nx, z).to_f64() + intercept);
        let between = values.filter(|value| (lo..=hi).contains(value));
        between.fold(none, |[l, m], value| [l.min(value), m.max(value)])
    }));
    let [least, most] = slices.into_iter().fold(none, |[l, m], [v, w]| [l.min(v), m.max(w)]);
    least >= most
}

#[cfg(test)]
mod tests {
    use super::super::tests::{radius, volume};
    use super::*;

    #[test]
    fn a_box_by_hand() {
        // 10 × 10 × 10 voxels of 200 in 0: 600 faces, no step smaller than the whole range, nothing on the box.
        let inside = |i: usize| (11..21).contains(&i);
        let v = volume(|[x, y, z]| if inside(x) && inside(y) && inside(z) { 200.0 } else { 0.0 });
        let levels = Levels::of(&v, Outside::Low).unwrap();
        let middle = levels.at(0.5);
        assert_eq!((middle.area, middle.step, middle.agreement, middle.cut), (600.0, 1.0, 1.0, 0.0));
        // The running sum takes 31 768 voxels off 32 768.
        assert!((middle.inside - 1000.0 / 32768.0).abs() < 1e-15);
        assert!((middle.simplicity - 1.0 / 6.0).abs() < 1e-12);
        assert_eq!((levels.value(0.25), levels.share(150.0)), (50.0, 0.75));
    }

    #[test]
    fn mirrored_data_have_the_same_levels() {
        let ball = |p| if radius(p) < 10.0 { 200.0 } else { 20.0 };
        let low = Levels::of(&volume(ball), Outside::Low).unwrap();
        let high = Levels::of(&volume(|p| -ball(p)), Outside::High).unwrap();
        assert_eq!(low.all(), high.all());
        // Numbers seen from the other side are equal, up to the rounding of shares and of powers.
        for (a, b) in low.mirrored().all().iter().zip(Levels::of(&volume(ball), Outside::High).unwrap().all()) {
            for (a, b) in [(a.area, b.area), (a.step, b.step), (a.inside, b.inside), (a.cut, b.cut)] {
                assert!((a - b).abs() < 1e-12, "{a} {b}");
            }
            assert!((a.simplicity - b.simplicity).abs() < 1e-12 && a.agreement == b.agreement);
        }
        // Three roundings of numbers up to 200.
        assert!((low.value(0.3) + high.value(0.3)).abs() < 4.0 * 200.0 * f64::EPSILON);
    }

    #[test]
    fn noise_confirms_nothing() {
        // A ripple whose neighbours are unrelated.
        let ripple = |[x, y, z]: [usize; 3]| (((x * 7919 + y * 104_729 + z * 1_299_709) * 2_654_435_761) >> 7) % 256;
        let noise = Levels::of(&volume(|p| ripple(p) as f64), Outside::Low).unwrap();
        assert!(noise.at(0.5).agreement < 0.2, "{:?}", noise.at(0.5));
        let clean = Levels::of(&volume(radius), Outside::High).unwrap();
        assert!(clean.at(0.5).agreement > 0.95, "{:?}", clean.at(0.5));
    }

    #[test]
    fn one_hot_voxel_does_not_take_all_levels() {
        let hot = volume(|p| if p == [3, 3, 3] { 1e9 } else { radius(p) });
        let levels = Levels::of(&hot, Outside::Low).unwrap();
        assert!(levels.value(1.0) < 1e6, "{}", levels.value(1.0));
        assert!(Levels::of(&volume(|_| 7.0), Outside::Low).is_none());
        // In an empty volume the voxel is the content.
        let alone = volume(|p| if p == [3, 3, 3] { 200.0 } else { 0.0 });
        assert_eq!(Levels::of(&alone, Outside::Low).unwrap().value(1.0), 200.0);
    }

    #[test]
    fn a_range_beyond_all_numbers_has_levels() {
        let ball = |p| if radius(p) < 10.0 { 1.0 } else { -1.0 };
        let huge = Levels::of(&volume(|p| 1.7e308 * ball(p)), Outside::Low).unwrap();
        assert_eq!(huge.all(), Levels::of(&volume(ball), Outside::Low).unwrap().all());
        assert_eq!([0.0, 0.5, 1.0].map(|share| huge.value(share)), [-1.7e308, 0.0, 1.7e308]);
        assert_eq!((huge.share(0.0), huge.difference(0.25), huge.difference(1.0)), (0.5, 0.85e308, f64::MAX));
    }
}
