//! The picture of an intersection transfer function ([VS-4]): colours over two values.

/// The most pixels along a side.
pub const MOST_SIDE: usize = 4096;

/// A picture over two values. Columns, from the left, stand for the value at p. Rows, from the bottom, stand for the
/// value at T p.
#[derive(Clone, Debug, PartialEq)]
pub struct IntersectionPicture {
    /// Pixels across and down.
    pub size: [usize; 2],
    /// Linear straight colour and opacity, row by row from the top.
    pub pixels: Vec<[f64; 4]>,
    /// Whether the file has opacities, which replace those of the preset.
    pub has_opacity: bool,
}

impl IntersectionPicture {
    /// Colour and opacity at shares of both ranges, clamped to [0, 1], bilinear between pixel centres. The ends of a
    /// range lie at the centres of the first and the last pixel.
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 4] {
        let [width, height] = self.size;
        let place = |share: f64, n: usize| {
            let at = share.clamp(0.0, 1.0) * (n - 1) as f64;
            let first = (at as usize).min(n.saturating_sub(2));
            (first, at - first as f64)
        };
        let ((i, u), (j, v)) = (place(x, width), place(1.0 - y, height));
        let pixel = |i: usize, j: usize| self.pixels[j.min(height - 1) * width + i.min(width - 1)];
        let mix = |a: [f64; 4], b: [f64; 4], w: f64| std::array::from_fn(|c| a[c] + w * (b[c] - a[c]));
        mix(mix(pixel(i, j), pixel(i + 1, j), u), mix(pixel(i, j + 1), pixel(i + 1, j + 1), u), v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two by three pixels, by hand.
    #[test]
    fn ends_lie_at_the_centres_of_pixels() {
        let pixels = (0..6).map(|i| [f64::from(i), 0.0, 1.0, 0.5]).collect();
        let picture = IntersectionPicture { size: [2, 3], pixels, has_opacity: true };
        let red = |x, y| picture.at([x, y])[0];
        assert_eq!([red(0.0, 1.0), red(1.0, 1.0), red(0.0, 0.0), red(1.0, 0.0)], [0.0, 1.0, 4.0, 5.0]);
        assert_eq!([red(0.5, 0.5), red(0.25, 0.75), red(-3.0, 7.0), red(9.0, -9.0)], [2.5, 1.25, 0.0, 5.0]);
        let one = IntersectionPicture { size: [1, 1], pixels: vec![[0.5; 4]], has_opacity: false };
        assert_eq!(one.at([0.3, 0.9]), [0.5; 4]);
    }
}
