//! The membership of a brush, and its composition with a selection ([VS-6]).

use drypoint_scene::glam::DVec3;
use drypoint_scene::math;
use drypoint_scene::tables::{Brush, PaintMode};

/// 1/σ² of the Gaussian for a radius of 1. With σ = 1/3, b is 0.011 at the radius, where the brush ends.
const INVERSE_VARIANCE: f64 = 9.0;

/// b, the membership of a brush at an offset from its centre. Returns none beyond the brush. A brush of radius 0 has
/// its centre alone.
pub fn membership(brush: Brush, offset: DVec3, radius: f64) -> Option<f64> {
    if offset == DVec3::ZERO {
        return Some(1.0);
    }
    let share = offset / radius;
    match brush {
        Brush::Gaussian => {
            let square = share.length_squared();
            (square <= 1.0).then(|| math::exp(-0.5 * INVERSE_VARIANCE * square))
        }
        Brush::Ball => (share.length_squared() <= 1.0).then_some(1.0),
        Brush::Box => (share.abs().max_element() <= 1.0).then_some(1.0),
    }
}

/// The membership f of a selection after a brush of membership b.
pub fn composed(mode: PaintMode, f: f64, b: f64) -> f64 {
    match mode {
        PaintMode::Add => (f + b).min(1.0),
        PaintMode::Subtract => (f - b).max(0.0),
        PaintMode::Maximum => f.max(b),
        PaintMode::Replace => b,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gaussian_has_a_third_of_the_radius_as_sigma() {
        let b = |distance: f64| membership(Brush::Gaussian, DVec3::new(0.0, distance, 0.0), 6.0);
        // At 0, σ, 2σ and 3σ: 1, e^−½, e^−2, e^−4.5.
        for (distance, exponent) in [(0.0, 0.0), (2.0, -0.5), (4.0, -2.0), (6.0, -4.5)] {
            assert!((b(distance).unwrap() - f64::exp(exponent)).abs() < 1e-15);
        }
        assert_eq!(b(6.0f64.next_up()), None);
    }

    #[test]
    fn balls_and_boxes_end_at_the_radius() {
        let at = |brush, x, y| membership(brush, DVec3::new(x, y, 0.0), 5.0);
        assert_eq!([at(Brush::Ball, 3.0, 4.0), at(Brush::Ball, 3.0, 4.01)], [Some(1.0), None]);
        assert_eq!([at(Brush::Box, 5.0, -5.0), at(Brush::Box, 5.01, 0.0)], [Some(1.0), None]);
    }

    #[test]
    fn a_radius_of_zero_is_the_centre() {
        for brush in [Brush::Gaussian, Brush::Ball, Brush::Box] {
            assert_eq!(membership(brush, DVec3::ZERO, 0.0), Some(1.0));
            assert_eq!(membership(brush, DVec3::new(1e-300, 0.0, 0.0), 0.0), None);
            // Radii whose squares leave the range of f64.
            assert_eq!(membership(brush, DVec3::new(1e-200, 0.0, 0.0), 1e-201), None);
            assert_eq!(membership(brush, DVec3::splat(1.0), 1e200), Some(1.0));
        }
    }

    #[test]
    fn modes_stay_in_the_unit_interval() {
        let all = |f, b| {
            [PaintMode::Add, PaintMode::Subtract, PaintMode::Maximum, PaintMode::Replace]
                .map(|mode| composed(mode, f, b))
        };
        assert_eq!(all(0.25, 0.5), [0.75, 0.0, 0.5, 0.5]);
        assert_eq!(all(0.75, 0.5), [1.0, 0.25, 0.75, 0.5]);
        for (f, b) in (0..=10).flat_map(|f| (0..=10).map(move |b| (f64::from(f) / 10.0, f64::from(b) / 10.0))) {
            assert!(all(f, b).iter().all(|f| (0.0..=1.0).contains(f)));
        }
    }
}
