//! Picking: the places in the volume that are seen at pixels ([HALO-12]), and probing what is there.

use crate::Failure;
use drypoint_reference::field::{HessianEstimator, Kernel, Reconstruction};
use drypoint_reference::ray::{Picked, Renderer};
use drypoint_scene::memory::{self, NoRoom};
use drypoint_scene::space::Grid;
use drypoint_scene::volume::Volume;

/// Returns the point of the picture, in pixels from the top left corner, for a pixel of a scene. Pixels are numbered
/// from 0, and integers mean centres: pixel [0, 0] is the point [½, ½].
pub(crate) fn point_of_pixel(pixel: [f64; 2]) -> [f64; 2] {
    pixel.map(|n| n + 0.5)
}

/// Returns the first visible structure at the centre of a pixel, column x from the left and row y from the top. Returns
/// none if nothing is visible there, or if the pixel is outside the picture.
pub fn pick_pixel(renderer: &Renderer<'_>, [x, y]: [usize; 2]) -> Option<Picked> {
    renderer.pick(point_of_pixel([x as f64, y as f64]))
}

/// Returns the lengths `inner` and `falloff` of a halo's focus that suit a volume, to two digits: the halo is full within an
/// eighth of the volume's radius, and gone at three eighths.
pub fn focus_lengths(grid: &Grid) -> [f64; 2] {
    let two_digits = |length: f64| format!("{length:.1e}").parse().unwrap_or(length);
    [8.0, 4.0].map(|part| two_digits(grid.radius() / part))
}

/// Checks that there is memory for a field of second derivatives of a volume: for the kernel's coefficients, and for those
/// of the smoothed volume while it is filtered. Such a field is what [`probe`](drypoint_reference::field::probe) needs.
///
/// # Errors
/// There is not.
pub fn room_to_probe(volume: &Volume, how: &Reconstruction) -> Result<(), NoRoom> {
    let prefiltered = matches!(how.kernel, Kernel::Bspline | Kernel::Bspline5);
    let smoothed = matches!(how.hessian, HessianEstimator::Auto | HessianEstimator::Gaussian);
    memory::room_for(volume.grid().len() as u64, 8 * u64::from(prefiltered) + 16 * u64::from(smoothed))
}

/// Checks that a pixel lies in a picture of this size. `place` names the pixel in the failure.
///
/// # Errors
/// The pixel lies outside.
pub fn pixel_inside([x, y]: [i64; 2], size: [usize; 2], place: &str) -> Result<[usize; 2], Failure> {
    let inside = |n: i64, size: usize| usize::try_from(n).ok().filter(|n| *n < size);
    match (inside(x, size[0]), inside(y, size[1])) {
        (Some(x), Some(y)) => Ok([x, y]),
        _ => {
            let what = format!("the pixel {x},{y} lies outside the picture of {} × {} pixels", size[0], size[1]);
            let [right, bottom] = size.map(|n| n.saturating_sub(1));
            let remedy = format!("X goes from 0 at the left to {right}, and Y from 0 at the top to {bottom}");
            Err(Failure::new(what, place, remedy))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An eighth of 0.00987 is 0.00123375, and a quarter is 0.0024675.
    #[test]
    fn foci_have_two_digits() {
        let side = 2.0 * 0.00987 / 3f64.sqrt();
        let grid = Grid::with_spacing([2; 3], [side; 3]).unwrap();
        assert_eq!(focus_lengths(&grid), [0.0012, 0.0025]);
    }

    #[test]
    fn pixels_outside_are_told_with_the_size() {
        assert_eq!(pixel_inside([23, 0], [24, 16], "here"), Ok([23, 0]));
        let what = |pixel| pixel_inside(pixel, [24, 16], "here").unwrap_err().to_string();
        let expected = "error: the pixel 24,-1 lies outside the picture of 24 × 16 pixels\n  at: here\n  try: X goes from 0 at \
            the left to 23, and Y from 0 at the top to 15";
        assert_eq!(what([24, -1]), expected);
        assert!(
            what([i64::MAX, i64::MIN]).starts_with("error: the pixel 9223372036854775807,-9223372036854775808 lies")
        );
    }
}
