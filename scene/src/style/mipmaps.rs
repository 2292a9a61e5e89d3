//! The mip chain of a style (4.3; [STF-10]): of a single style, linear and premultiplied, over its disk only.
//!
//! Level ℓ has ⌈S/2^ℓ⌉ texels a side, also for sides that are no powers of two; the last level has one texel. The
//! texels of a level share the picture equally. Each is the mean, by area, of the part of the disk that it covers. The
//! level belongs to λ = log₂(S/side): ℓ itself for powers of two, and log₂ S for the last level, whose texel is the
//! mean of the disk.

use super::Style;
use super::rim::{extend_rows, is_inside};
use crate::color::Rgba;
use crate::math;
use std::ops::Range;

/// A level of a mip chain above the style itself.
#[derive(Clone, Debug, PartialEq)]
pub struct MipLevel {
    /// λ = log₂(S/side), the level of detail.
    pub lambda: f64,
    /// Texels along its side.
    pub side: usize,
    /// Texels row by row from the top, linear and premultiplied. A texel that covers nothing of the disk is a copy of
    /// the nearest texel that covers some of it, like the outside texels of the style.
    pub texels: Vec<Rgba>,
}

/// r, g, b, α and 1 of the inside texels, summed over a part of the picture by area.
type Sum = [f64; 5];

impl Style {
    /// The levels above the style, which is level 0; none for a style of one texel.
    pub fn mip_levels(&self) -> Vec<MipLevel> {
        let mut levels = Vec::new();
        let mut before = (self.side, Vec::new());
        while before.0 > 1 {
            let side = before.0.div_ceil(2);
            // Where the side before is even two of its texels are one of this level, and so their sums. Where it is
            // odd one of them would have to be cut, as if what it covers were even: then the style itself is asked.
            let sums = if levels.is_empty() || before.0 % 2 == 1 {
                reduced(self.side, side, |i, j| self.sum(i, j))
            } else {
                reduced(before.0, side, |i, j| before.1[j * before.0 + i])
            };
            levels.push(MipLevel {
                lambda: math::log2(self.side as f64 / side as f64),
                side,
                texels: means(side, &sums),
            });
            before = (side, sums);
        }
        levels
    }

    fn sum(&self, i: usize, j: usize) -> Sum {
        if !is_inside(self.side, i, j) {
            return [0.0; 5];
        }
        let [r, g, b, a] = self.texel(i, j);
        [r, g, b, a, 1.0]
    }
}

/// The sums over `side` × `side` equal parts of a picture of `from` × `from` texels.
fn reduced(from: usize, side: usize, sum: impl Fn(usize, usize) -> Sum) -> Vec<Sum> {
    let shares: Vec<_> = (0..side).map(|i| shares(from, side, i)).collect();
    let mut sums = vec![[0.0; 5]; side * side];
    for (row, (rows, weights)) in sums.chunks_exact_mut(side).zip(&shares) {
        for (y, wy) in rows.clone().zip(weights) {
            for (part, (columns, weights)) in row.iter_mut().zip(&shares) {
                for (x, wx) in columns.clone().zip(weights) {
                    let texel = sum(x, y);
                    part.iter_mut().zip(texel).for_each(|(sum, c)| *sum += wx * wy * c);
                }
            }
        }
    }
    sums
}

/// The texels of a row of `from` texels that part i of `side` equal parts reaches, with the share of each in the part.
/// Shares are counted in whole parts of a texel. If parts hold whole texels, each share is exactly 1.
fn shares(from: usize, side: usize, i: usize) -> (Range<usize>, Vec<f64>) {
    let [start, end] = [i * from, (i + 1) * from];
    let texels = start / side..end.div_ceil(side);
    let share = |k: usize| ((k + 1) * side).min(end) - (k * side).max(start);
    let weights = texels.clone().map(|k| share(k) as f64 / side as f64).collect();
    (texels, weights)
}

/// The mean of each part that holds something of the disk, and the nearest such mean in the others.
fn means(side: usize, sums: &[Sum]) -> Vec<Rgba> {
    let mean = |&[r, g, b, a, n]: &Sum| if n > 0.0 { [r / n, g / n, b / n, a / n] } else { [0.0; 4] };
    let mut texels: Vec<Rgba> = sums.iter().map(mean).collect();
    // A row of parts covers at least one row of texels, which has inside ones about its middle: none is empty.
    let rows: Vec<Range<usize>> = sums
        .chunks_exact(side)
        .map(|row| {
            let left = row.iter().position(|sum| sum[4] > 0.0).unwrap_or(0);
            left..side - left
        })
        .collect();
    extend_rows(&rows, &mut texels);
    texels
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::philox::uniforms;

    /// A style of noise, with `outside` outside the disk.
    fn noise(side: usize, outside: f64) -> Style {
        let texel = |t: usize| {
            let (i, j) = (t % side, t / side);
            if is_inside(side, i, j) { uniforms(7, [i as u32, j as u32, 0], 0) } else { [outside; 4] }
        };
        let texels: Vec<Rgba> = (0..side * side).map(texel).collect();
        Style::from_straight("noise", side, &texels, true).unwrap()
    }

    /// The mean over the disk.
    fn mean(style: &Style) -> Rgba {
        let side = style.side;
        let inside: Vec<Rgba> =
            (0..side * side).filter(|t| is_inside(side, t % side, t / side)).map(|t| style.texels[t]).collect();
        [0, 1, 2, 3].map(|c: usize| inside.iter().map(|texel| texel[c]).sum::<f64>() / inside.len() as f64)
    }

    #[test]
    fn four_texels_by_hand() {
        // 4 × 4: the corners are outside. A quarter is the mean of its three inside texels, premultiplied: of red 1, 1, 0
        // with α = 1, ½, 1 it is (½, ⅚).
        let inside = [[1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.5], [0.0, 0.0, 0.0, 1.0]];
        let mut texels = vec![[0.0, 0.0, 0.0, 1.0]; 16];
        [texels[1], texels[4], texels[5]] = inside;
        texels[0] = [f64::NAN; 4];
        let style = Style::from_straight("s", 4, &texels, true).unwrap();
        let levels = style.mip_levels();
        assert_eq!(levels.iter().map(|l| (l.side, l.lambda)).collect::<Vec<_>>(), [(2, 1.0), (1, 2.0)]);
        assert_eq!(levels[0].texels[0], [0.5, 0.0, 0.0, 2.5 / 3.0]);
        // The disk holds 12 texels: 1.5 of 12 red, 11.5 of α.
        assert_eq!(levels[1].texels, [[0.125, 0.0, 0.0, 11.5 / 12.0]]);
    }

    #[test]
    fn a_side_of_three_is_cut_in_the_middle() {
        // Parts of 1½ texels: one whole and half of the middle one, in both directions. The corners are inside (8 ≤ 9).
        let texels: Vec<Rgba> = (0..9).map(|t| [f64::from(t) / 8.0, 0.0, 0.0, 1.0]).collect();
        let levels = Style::from_straight("s", 3, &texels, true).unwrap().mip_levels();
        assert_eq!(levels.iter().map(|l| l.side).collect::<Vec<_>>(), [2, 1]);
        // (0 + ½·1 + ½·3 + ¼·4)/2.25 = 4/3 of eighths.
        assert!((levels[0].texels[0][0] - 4.0 / 3.0 / 8.0).abs() < 1e-16);
        assert!((levels[1].texels[0][0] - 0.5).abs() < 1e-16);
        assert_eq!(levels[0].lambda, math::log2(1.5));
        assert_eq!(levels[1].lambda, math::log2(3.0));
    }

    /// The mean of a level, each texel weighted by how much of the disk it covers, is the mean of the disk; the last
    /// level is that mean. Sums of up to 40² numbers below 1 round to 40² ε at the most.
    #[test]
    fn every_level_has_the_mean_of_the_disk() {
        for side in 1..=40 {
            let style = noise(side, 0.0);
            let levels = style.mip_levels();
            let of_disk = mean(&style);
            let sides: Vec<usize> = levels.iter().map(|l| l.side).collect();
            assert!(sides.iter().all(|&n| n < side) && sides.last().is_none_or(|&n| n == 1), "{side}: {sides:?}");
            for level in levels {
                let cover = reduced(side, level.side, |i, j| style.sum(i, j));
                let whole: f64 = cover.iter().map(|sum| sum[4]).sum();
                for c in 0..4 {
                    let sum: f64 = level.texels.iter().zip(&cover).map(|(texel, cover)| texel[c] * cover[4]).sum();
                    let close = (sum / whole - of_disk[c]).abs() <= 1600.0 * f64::EPSILON;
                    assert!(close, "{side} level {}: {} {}", level.side, sum / whole, of_disk[c]);
                }
            }
        }
    }

    /// The chain does not depend on which level a level was made from: two texels' sums are the whole's.
    #[test]
    fn each_texel_is_the_mean_of_its_part_of_the_disk() {
        for side in [6, 12, 13, 24, 31, 36] {
            let style = noise(side, 0.0);
            for level in style.mip_levels() {
                let direct = means(level.side, &reduced(side, level.side, |i, j| style.sum(i, j)));
                for (a, b) in level.texels.iter().zip(direct) {
                    assert!((0..4).all(|c| (a[c] - b[c]).abs() <= 1600.0 * f64::EPSILON), "{side} {}", level.side);
                }
            }
        }
    }

    #[test]
    fn what_stands_outside_the_disk_is_in_no_level() {
        for side in [2, 4, 5, 16, 31, 64] {
            let levels = noise(side, 0.0).mip_levels();
            assert_eq!(levels, noise(side, f64::NAN).mip_levels(), "{side}");
            assert!(levels.iter().flat_map(|l| &l.texels).flatten().all(|c| (0.0..=1.0).contains(c)), "{side}");
        }
        // Texels that cover nothing of the disk take the nearest that does: of 64, the corner of the level of 32.
        let levels = noise(64, 0.0).mip_levels();
        let at = |i: usize, j: usize| levels[0].texels[j * 32 + i];
        let rows: Vec<_> = (0..32).map(|i| (0..2).any(|k| (0..2).any(|l| is_inside(64, 2 * i + k, l)))).collect();
        let first = rows.iter().position(|&inside| inside).unwrap();
        assert!(first > 2);
        assert_eq!(at(first - 1, 0), at(first, 0));
    }

    #[test]
    fn one_texel_has_no_level_above() {
        assert_eq!(noise(1, 0.0).mip_levels(), []);
    }
}
