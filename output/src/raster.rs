//! Coverage of pixels by polylines drawn with a round pen.

use tiny_skia::{FillRule, LineCap, LineJoin, Mask, Path, PathBuilder, PathStroker, Stroke, Transform};

/// Returns the share of each pixel that polylines cover, in [0, 1], row by row from the top. The pen is round and `pen`
/// pixels across.
///
/// Points are in pixels, y down, and the first pixel's centre is (½, ½). A polyline of two equal points is a dot.
/// Overlapping strokes cover once. Steps are 1/255. The caller checks the memory budget. A picture with a side above
/// 2³² pixels stays blank.
pub fn coverage(width: usize, height: usize, polylines: &[Vec<[f64; 2]>], pen: f64) -> Vec<f64> {
    let Some(mut cover) = CoverageMask::new(width, height) else {
        return vec![0.0; width * height];
    };
    cover.draw(polylines.iter().map(|line| (line.iter().copied(), false)), pen);
    cover.bytes().iter().map(|&covered| f64::from(covered) / 255.0).collect()
}

/// A mask of coverage to draw on, in steps of 1/255.
pub(crate) struct CoverageMask {
    mask: Mask,
}

impl CoverageMask {
    /// Makes an empty mask; none without a pixel, or with more than 2³² on a side.
    pub(crate) fn new(width: usize, height: usize) -> Option<Self> {
        let mask = Mask::new(u32::try_from(width).ok()?, u32::try_from(height).ok()?)?;
        Some(Self { mask })
    }

    /// Draws lines with a round pen. The flag of a line says whether it is closed. Lines of one call cover once where
    /// they cross. Successive calls add as c + d − cd.
    pub(crate) fn draw<L: Iterator<Item = [f64; 2]>>(&mut self, lines: impl Iterator<Item = (L, bool)>, pen: f64) {
        // All strokes are one outline, filled by the nonzero rule, so that crossings do not darken.
        if let Some(outline) = outline(lines, pen) {
            self.mask.fill_path(&outline, FillRule::Winding, true, Transform::identity());
        }
    }

    /// Fills outlines by the nonzero rule. Outlines of the same orientation cover once where they overlap.
    pub(crate) fn fill<L: Iterator<Item = [f64; 2]>>(&mut self, outlines: impl Iterator<Item = L>) {
        let mut all = PathBuilder::new();
        for mut points in outlines {
            let Some([x, y]) = points.next() else { continue };
            all.move_to(x as f32, y as f32);
            points.for_each(|[x, y]| all.line_to(x as f32, y as f32));
            all.close();
        }
        if let Some(path) = all.finish() {
            self.mask.fill_path(&path, FillRule::Winding, true, Transform::identity());
        }
    }

    /// Returns the coverage row by row from the top; 255 is a whole pixel.
    pub(crate) fn bytes(&self) -> &[u8] {
        self.mask.data()
    }
}

/// Returns the outline of lines drawn with a round pen; none for no line.
fn outline<L: Iterator<Item = [f64; 2]>>(lines: impl Iterator<Item = (L, bool)>, pen: f64) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (mut points, closed) in lines {
        let Some([x, y]) = points.next() else { continue };
        path.move_to(x as f32, y as f32);
        let mut rest = false;
        for [x, y] in points {
            path.line_to(x as f32, y as f32);
            rest = true;
        }
        if closed && rest {
            path.close();
        }
    }
    let stroke =
        Stroke { width: pen as f32, line_cap: LineCap::Round, line_join: LineJoin::Round, ..Stroke::default() };
    PathStroker::new().stroke(&path.finish()?, &stroke, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_line_covers_its_area() {
        // A pen of 2 px along y = 4 from x = 3 to 43: 80 px and two half discs. The rasterizer counts four by four
        // places a pixel, of which the ends' outline, 2π px long, may miss half a place: 2π/8; the sides are exact.
        let cover = coverage(48, 8, &[vec![[3.0, 4.0], [43.0, 4.0]]], 2.0);
        let (area, pi) = (cover.iter().sum::<f64>(), std::f64::consts::PI);
        assert!((area - (80.0 + pi)).abs() < pi / 4.0, "{area}");
        assert_eq!([2, 3, 4, 5].map(|y| cover[y * 48 + 20]), [0.0, 1.0, 1.0, 0.0]);
    }

    #[test]
    fn a_dot_is_a_disc_and_crossings_do_not_add() {
        // A disc of radius 2, its outline 4π px long.
        let dot = coverage(8, 8, &[vec![[4.0, 4.0]; 2]], 4.0);
        let (area, pi) = (dot.iter().sum::<f64>(), std::f64::consts::PI);
        assert!((area - 4.0 * pi).abs() < pi / 2.0, "{area}");
        let cross = coverage(9, 9, &[vec![[0.0, 4.5], [9.0, 4.5]], vec![[4.5, 0.0], [4.5, 9.0]]], 1.0);
        assert!(cross.iter().all(|c| (0.0..=1.0).contains(c)));
        assert_eq!(cross[4 * 9 + 4], 1.0);
    }

    #[test]
    fn nothing_is_nothing() {
        assert_eq!(coverage(2, 1, &[], 1.0), [0.0; 2]);
        assert_eq!(coverage(2, 1, &[vec![]], 1.0), [0.0; 2]);
        assert_eq!(coverage(0, 1, &[vec![[0.0, 0.0], [1.0, 1.0]]], 1.0), [0.0; 0]);
    }
}
