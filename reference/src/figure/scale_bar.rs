//! Lengths of scale bars.

use drypoint_scene::view::View;

/// Returns the world units of a pixel across the view axis: everywhere in orthographic views, in perspective at an eye
/// depth.
pub fn world_per_pixel(view: &View, depth: f64) -> f64 {
    if view.perspective { view.pixel * depth } else { view.pixel }
}

/// Returns the largest length of at most `most` that is 1, 2 or 5 times a power of ten. Returns none unless `most` is
/// positive and normal.
pub fn round_length(most: f64) -> Option<f64> {
    if !(most.is_normal() && most > 0.0) {
        return None;
    }
    // Decimal numbers are read, so that each is the double nearest to its text.
    let digits = format!("{most:e}");
    let exponent: i32 = digits.split_once('e')?.1.parse().ok()?;
    let lengths = [5, 2, 1].map(|digit| format!("{digit}e{exponent}").parse::<f64>().ok());
    lengths.into_iter().flatten().find(|length| *length <= most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_round() {
        for (most, length) in [(1.0, 1.0), (0.999, 0.5), (4.99, 2.0), (73.0, 50.0), (0.003, 0.002), (2e-300, 2e-300)] {
            assert_eq!(round_length(most), Some(length), "{most}");
        }
        for most in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(round_length(most), None);
        }
    }
}
