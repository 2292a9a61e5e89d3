//! The part of the picture that a region reads ([STF-2]).

use drypoint_scene::color::Rgba;
use drypoint_scene::style::SourcePicture;

/// Search radius, in pixels, from a pixel outside the region to its nearest pixel inside. Pixels read for a place of
/// the region have their centres less than two from it on either axis. A centre inside lies within two more, unless the
/// region is thinner than that.
const REACH: usize = 4;

/// The pixels about a region. Only pixels whose centres lie inside the region count, as with the texels of a style
/// ([STF-1]). Every other pixel takes the colour of the nearest counting one, so that no background bleeds into the
/// style.
pub(super) struct Patch {
    /// The picture's own width and height.
    frame: [f64; 2],
    /// Column and row of the patch's first pixel.
    corner: [usize; 2],
    size: [usize; 2],
    /// Colours, row by row; none if no pixel of the region is within reach.
    pixels: Vec<Option<Rgba>>,
}

impl Patch {
    /// The pixels about the box from `low` to `high`, in pixels of the picture. `inside` tells whether a centre lies in
    /// the region. Returns none if no centre does.
    pub(super) fn new(
        source: &SourcePicture,
        low: [f64; 2],
        high: [f64; 2],
        inside: impl Fn(f64, f64) -> bool,
    ) -> Option<Self> {
        let frame = [source.width(), source.height()];
        // The filter needs two pixels on each side; the third covers rounding.
        let corner = [0, 1].map(|c| (low[c] - 3.0).clamp(0.0, frame[c] as f64) as usize);
        let end = [0, 1].map(|c| (high[c] + 3.0).ceil().clamp(0.0, frame[c] as f64) as usize);
        let size = [0, 1].map(|c| end[c].saturating_sub(corner[c]));
        let own: Vec<Option<Rgba>> = (0..size[0] * size[1])
            .map(|t| [corner[0] + t % size[0], corner[1] + t / size[0]])
            .map(|[i, j]| inside(i as f64 + 0.5, j as f64 + 0.5).then(|| source.pixel(i, j)))
            .collect();
        own.iter().any(Option::is_some).then(|| {
            let pixels = (0..own.len()).map(|t| own[t].or_else(|| nearest(&own, size, t))).collect();
            Self { frame: frame.map(|n| n as f64), corner, size, pixels }
        })
    }

    /// Linear premultiplied light at a place of the picture, whose pixels have their centres at i + ½, j + ½. The
    /// interpolation is cubic (Catmull–Rom), x then y. Each channel is clamped to the range of the sixteen pixels. The
    /// outermost pixels extend to the edge and beyond. Returns none outside the picture, and away from the region.
    pub(super) fn sample(&self, x: f64, y: f64) -> Option<Rgba> {
        if !(0.0..=self.frame[0]).contains(&x) || !(0.0..=self.frame[1]).contains(&y) {
            return None;
        }
        let (columns, wx) = self.taps(0, x)?;
        let (rows, wy) = self.taps(1, y)?;
        let (mut least, mut most) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
        let mut sum = [0.0; 4];
        for (j, wy) in rows.into_iter().zip(wy) {
            let mut row = [0.0; 4];
            for (i, wx) in columns.into_iter().zip(wx) {
                let pixel = self.pixels[j * self.size[0] + i]?;
                for c in 0..4 {
                    row[c] += wx * pixel[c];
                    least[c] = least[c].min(pixel[c]);
                    most[c] = most[c].max(pixel[c]);
                }
            }
            sum = std::array::from_fn(|c| sum[c] + wy * row[c]);
        }
        Some(std::array::from_fn(|c| sum[c].clamp(least[c], most[c])))
    }

    /// The four columns or rows of the patch about a coordinate, and their weights.
    fn taps(&self, axis: usize, x: f64) -> Option<([usize; 4], [f64; 4])> {
        let place = x - 0.5;
        let (first, t) = (place.floor(), place - place.floor());
        let last = self.frame[axis] - 1.0;
        let mut taps = [0; 4];
        for (k, tap) in taps.iter_mut().enumerate() {
            let at = (first + k as f64 - 1.0).clamp(0.0, last) as usize;
            *tap = at.checked_sub(self.corner[axis]).filter(|&at| at < self.size[axis])?;
        }
        let weights = [
            ((2.0 - t) * t - 1.0) * t / 2.0,
            ((3.0 * t - 5.0) * t * t + 2.0) / 2.0,
            ((4.0 - 3.0 * t) * t + 1.0) * t / 2.0,
            (t - 1.0) * t * t / 2.0,
        ];
        Some((taps, weights))
    }
}

/// The colour of the inside pixel whose centre is nearest to that of pixel t. Ties go to the smallest row, then column.
fn nearest(own: &[Option<Rgba>], [width, height]: [usize; 2], t: usize) -> Option<Rgba> {
    let [i, j] = [t % width, t / width];
    let (mut best, mut found) = (REACH * REACH + 1, None);
    for row in j.saturating_sub(REACH)..(j + REACH + 1).min(height) {
        for column in i.saturating_sub(REACH)..(i + REACH + 1).min(width) {
            let distance = column.abs_diff(i).pow(2) + row.abs_diff(j).pow(2);
            if distance < best
                && let Some(color) = own[row * width + column]
            {
                (best, found) = (distance, Some(color));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Opaque; red is 2x + y at the centre of pixel (x, y), in linear light.
    fn slope(width: usize, height: usize) -> SourcePicture {
        let pixels = (0..width * height).map(|t| [(2 * (t % width) + t / width) as f64, 0.0, 0.0, 1.0]).collect();
        SourcePicture::from_straight(width, height, pixels, true).unwrap()
    }

    #[test]
    fn a_slope_is_kept_and_centres_are_exact() {
        let patch = Patch::new(&slope(8, 6), [0.0; 2], [8.0, 6.0], |_, _| true).unwrap();
        for (x, y) in [(2.5, 2.5), (3.25, 2.0), (5.5, 3.5), (5.9, 2.1)] {
            assert!((patch.sample(x, y).unwrap()[0] - (2.0 * (x - 0.5) + y - 0.5)).abs() < 1e-14);
        }
        for (x, y) in [(0.5, 0.5), (7.5, 5.5), (0.5, 3.5)] {
            assert_eq!(patch.sample(x, y).unwrap()[0], 2.0 * (x - 0.5) + y - 0.5);
        }
        // The outermost pixels reach to the edge, and no farther.
        assert!((18.9..=19.0).contains(&patch.sample(8.0, 6.0).unwrap()[0]));
        assert_eq!([patch.sample(8.001, 3.0), patch.sample(3.0, -0.001)], [None; 2]);
    }

    #[test]
    fn edges_do_not_ring() {
        let pixels = (0..64).map(|t| [if t % 8 < 4 { 0.0 } else { 1.0 }, 0.0, 0.0, 1.0]).collect();
        let source = SourcePicture::from_straight(8, 8, pixels, true).unwrap();
        let patch = Patch::new(&source, [0.0; 2], [8.0; 2], |_, _| true).unwrap();
        for k in 0..=80 {
            let [r, _, _, a] = patch.sample(f64::from(k) / 10.0, 4.0).unwrap();
            assert!((0.0..=1.0).contains(&r) && a == 1.0);
        }
    }

    #[test]
    fn what_is_not_in_the_region_is_not_read() {
        // Inside are the columns 2 to 4, with red 4, 6 and 8 in row 0.
        let patch = Patch::new(&slope(12, 1), [2.0, 0.0], [5.0, 1.0], |x, _| (2.0..5.0).contains(&x)).unwrap();
        assert_eq!([2.5, 3.5, 4.5].map(|x| patch.sample(x, 0.5).unwrap()[0]), [4.0, 6.0, 8.0]);
        for x in [2.0, 2.2, 4.8, 5.0] {
            assert!((4.0..=8.0).contains(&patch.sample(x, 0.5).unwrap()[0]), "{x}");
        }
        // Beyond reach there is nothing, although the picture goes on.
        assert_eq!(patch.sample(9.9, 0.5), None);
    }

    #[test]
    fn ties_go_to_the_upper_row() {
        // Rows 0 and 2 are inside, row 1 is not: its pixel takes row 0.
        let patch = Patch::new(&slope(1, 3), [0.0; 2], [1.0, 3.0], |_, y| (y - 1.5).abs() > 0.6).unwrap();
        assert_eq!(patch.sample(0.5, 1.5).unwrap()[0], 0.0);
    }

    #[test]
    fn without_a_centre_there_is_no_patch() {
        assert!(Patch::new(&slope(4, 4), [1.6, 1.6], [1.9, 1.9], |_, _| false).is_none());
        assert!(Patch::new(&slope(4, 4), [-90.0, 1.0], [-80.0, 3.0], |_, _| true).is_none());
    }
}
