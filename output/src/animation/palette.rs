//! Palettes that reduce the colours of a picture by cutting the colour cube at means. All numbers are integers, so
//! every machine finds the same palette.

use std::cmp::Reverse;

/// A colour of the picture, and the number of its pixels.
type Counted = ([u8; 3], u64);

/// A palette, and the palette's index for every colour of its picture.
pub(super) struct Palette {
    /// The colours.
    pub(super) colors: Vec<[u8; 3]>,
    /// Colours of the picture in ascending order, each with its index in the palette.
    places: Vec<([u8; 3], u8)>,
}

/// A part of the colours, with its spread along its widest axis.
struct ColorBox {
    colors: Vec<Counted>,
    axis: usize,
    /// Sum of the squared distances from the mean along the axis, rounded down.
    spread: u64,
}

impl Palette {
    /// Returns a palette of at most `most` ≤ 256 colours. A picture with no more colours keeps its own. Otherwise the
    /// box of colours with the largest spread is cut at its mean until there are `most` boxes. The palette holds the
    /// boxes' mean colours. A colour of the picture gets the nearest colour of the palette.
    pub(super) fn new(pixels: impl Iterator<Item = [u8; 3]>, most: usize) -> Self {
        let counted = counts(pixels);
        let cut = counted.len() > most;
        let mut boxes: Vec<ColorBox> = if cut {
            vec![ColorBox::new(counted.clone())]
        } else {
            counted.iter().map(|&color| ColorBox::new(vec![color])).collect()
        };
        while cut && boxes.len() < most {
            // Of equal spreads the first box.
            let Some(i) = (0..boxes.len()).max_by_key(|&i| (boxes[i].spread, Reverse(i))) else { break };
            if boxes[i].spread == 0 {
                break;
            }
            let [low, high] = boxes.swap_remove(i).halves();
            boxes.extend([low, high]);
        }
        let colors: Vec<[u8; 3]> = boxes.iter().map(ColorBox::mean).collect();
        let places = counted.iter().map(|&(color, _)| (color, nearest(&colors, color))).collect();
        Self { colors, places }
    }

    /// Returns the palette's index for a colour of the picture; 0 for any other colour.
    pub(super) fn index(&self, color: [u8; 3]) -> u8 {
        self.places.binary_search_by_key(&color, |&(of, _)| of).map_or(0, |at| self.places[at].1)
    }
}

impl ColorBox {
    fn new(colors: Vec<Counted>) -> Self {
        // W·Σwx² − (Σwx)² over W, of which the largest axis wins.
        let spread = |axis: usize| {
            let weight: u128 = colors.iter().map(|&(_, n)| u128::from(n)).sum();
            let moment = |power: u32| -> u128 {
                colors.iter().map(|&(color, n)| u128::from(n) * u128::from(color[axis]).pow(power)).sum()
            };
            let spread = (weight * moment(2) - moment(1).pow(2)) / weight.max(1);
            u64::try_from(spread).unwrap_or(u64::MAX)
        };
        let spreads = [0, 1, 2].map(spread);
        let axis = (0..3).max_by_key(|&axis| (spreads[axis], Reverse(axis))).unwrap_or(0);
        Self { colors, axis, spread: spreads[axis] }
    }

    /// Returns the colours up to the mean along the axis, and those above. Neither half is empty if the spread is above
    /// 0.
    fn halves(self) -> [Self; 2] {
        let (axis, mean) = (self.axis, self.sums()[self.axis] / self.weight());
        let (low, high) = self.colors.into_iter().partition(|&(color, _)| u64::from(color[axis]) <= mean);
        [Self::new(low), Self::new(high)]
    }

    /// Returns the mean colour, rounded.
    fn mean(&self) -> [u8; 3] {
        let weight = self.weight();
        self.sums().map(|sum| ((2 * sum + weight) / (2 * weight)) as u8)
    }

    fn sums(&self) -> [u64; 3] {
        [0, 1, 2].map(|axis| self.colors.iter().map(|&(color, n)| n * u64::from(color[axis])).sum())
    }

    fn weight(&self) -> u64 {
        self.colors.iter().map(|&(_, n)| n).sum::<u64>().max(1)
    }
}

/// Returns the index of the nearest of at most 256 colours. Ties go to the first one.
fn nearest(colors: &[[u8; 3]], color: [u8; 3]) -> u8 {
    let squared =
        |other: &[u8; 3]| -> u32 { other.iter().zip(color).map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum() };
    let place = colors.iter().zip(0..=u8::MAX).min_by_key(|&(other, place)| (squared(other), place));
    place.map_or(0, |(_, place)| place)
}

/// Returns the colours in order, each with the number of its pixels.
fn counts(pixels: impl Iterator<Item = [u8; 3]>) -> Vec<Counted> {
    let mut all: Vec<[u8; 3]> = pixels.collect();
    all.sort_unstable();
    all.chunk_by(|a, b| a == b).map(|equal| (equal[0], equal.len() as u64)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept() {
        let pixels = [[9, 8, 7], [1, 2, 3], [9, 8, 7]];
        let palette = Palette::new(pixels.into_iter(), 2);
        assert_eq!(palette.colors, [[1, 2, 3], [9, 8, 7]]);
        assert_eq!(pixels.map(|color| palette.index(color)), [1, 0, 1]);
        assert!(Palette::new(std::iter::empty(), 2).colors.is_empty());
    }

    /// By hand: of 0, 10, 200, 202 the mean is 103, which parts the pairs; their means are 5 and 201.
    #[test]
    fn a_cut_is_at_the_mean() {
        let greys = [0, 10, 200, 202].map(|g| [g; 3]);
        let palette = Palette::new(greys.into_iter(), 2);
        assert_eq!(palette.colors, [[5; 3], [201; 3]]);
        assert_eq!(greys.map(|color| palette.index(color)), [0, 0, 1, 1]);
        // A third colour goes to the wider pair.
        assert_eq!(Palette::new(greys.into_iter(), 3).colors.len(), 3);
        assert!(Palette::new(greys.into_iter(), 3).colors.contains(&[201; 3]));
    }

    /// A colour of many pixels draws the mean of its box: (97·255 + 3·155)/100 = 252.
    #[test]
    fn pixels_count() {
        let pixels = std::iter::repeat_n([255; 3], 97).chain([[155; 3]; 3]).chain([[0, 90, 0]; 100]);
        assert!(Palette::new(pixels, 2).colors.contains(&[252; 3]));
    }

    /// With n boxes along a line of 256 greys none is wider than twice 256/n, and each grey is near its colour.
    #[test]
    fn a_ramp_is_even() {
        let palette = Palette::new((0..=255).map(|g| [g; 3]), 16);
        assert_eq!(palette.colors.len(), 16);
        for g in 0..=255u8 {
            let found = palette.colors[palette.index([g; 3]) as usize][0].abs_diff(g);
            assert!(found <= 8 && palette.colors.iter().all(|color| found <= color[0].abs_diff(g)), "{g}");
        }
    }
}
