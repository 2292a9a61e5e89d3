//! Contour rings, measured in pictures: a row of pixels through the middle of a ball.

use super::{Stage, orthographic, style};
use drypoint::scene::style::Style;
use drypoint::scene::tables::Contours;

/// A style whose red and green are the normal that is looked up: (1 + N_x)/2 and (1 + N_y)/2.
pub(crate) fn ramp() -> Style {
    style("ramp", 256, |x, y| [(1.0 + x) / 2.0, (1.0 + y) / 2.0, 0.5, 1.0])
}

/// What is contour at one side of a row: how many pixels from the silhouette inwards, and how many of them do not show
/// it although they lie off the rim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Ring {
    pub(crate) pixels: usize,
    pub(crate) holes: usize,
}

/// Renders one row of `width` pixels of side `pixel`, with and without contours. A pixel belongs to a contour where that
/// changes a bit: off contours nothing is pushed. Returns the ring at the left and the one at the right end of the run
/// of covered pixels from `from` up to, not including, `end`.
pub(crate) fn strip(shot: &Stage, contours: &Contours, pixel: f64, width: usize, [from, end]: [usize; 2]) -> [Ring; 2] {
    let row = shot.with(|s| {
        s.picture.size = [width, 1];
        s.camera.projection = orthographic(Some(pixel)).projection;
    });
    let without = row.render().pixels();
    let with = row.with(|s| s.contours = Some(contours.clone())).render().pixels();
    let covered: Vec<usize> = (from..end).filter(|&i| without[i][3] > 0.0).collect();
    let middle = covered.len() / 2;
    // Past the centres of the outermost texels the lookup is clamped, and a push does not show.
    let rim = |i: usize| (2.0 * without[i][0] - 1.0).hypot(2.0 * without[i][1] - 1.0) > 1.0 - 4.0 / 256.0;
    let ring = |inwards: &[usize]| {
        let changed = |i: &usize| without[*i] != with[*i];
        let pixels = inwards.iter().rposition(changed).map_or(0, |last| last + 1);
        Ring { pixels, holes: inwards[..pixels].iter().filter(|i| !changed(i) && !rim(**i)).count() }
    };
    let (left, mut right) = (covered[..middle].to_vec(), covered[middle..].to_vec());
    right.reverse();
    [ring(&left), ring(&right)]
}
