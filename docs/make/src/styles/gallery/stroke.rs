//! Lines that follow the form: parallels of an axis, as engravers shade a ball.

use super::light::smoothstep;
use super::noise::{Draw, fractal, on_form};
use drypoint::scene::math;
use drypoint_reference::number::Vec3;
use std::f64::consts::PI;

/// A set of parallels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hatching {
    /// The axis that they run around, of length 1.
    pub(super) axis: Vec3<f64>,
    /// Lines from pole to pole.
    pub(super) lines: f64,
    /// How far the hand strays, in lines.
    pub(super) stray: f64,
    /// Half the width of a line's soft side, in lines.
    pub(super) soft: f64,
}

impl Hatching {
    /// What share of a place is covered by lines of that width, in shares of their distance: the width is the tone.
    pub(super) fn coverage(&self, n: Vec3<f64>, width: f64) -> f64 {
        let along = n.dot(self.axis).clamp(-1.0, 1.0);
        let latitude = math::atan2(along, (1.0 - along * along).sqrt());
        let (x, y) = on_form(n);
        let phase = latitude * self.lines / PI + self.stray * fractal(2.3 * x, 2.3 * y, 2, Draw::Hand);
        let off = (2.0 * (phase - phase.floor()) - 1.0).abs();
        let soft = 2.0 * self.soft;
        // A line thinner than its soft sides is a paler one of that width.
        let width = width.clamp(0.0, 1.0 + soft);
        let pale = (width / soft).min(1.0);
        pale * smoothstep(width + soft, width - soft, off)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_cover_what_their_width_says() {
        let hatching = Hatching { axis: Vec3::new(0.0, 1.0, 0.0), lines: 20.0, stray: 0.0, soft: 0.1 };
        assert_eq!(hatching.coverage(Vec3::new(0.3, 0.2, 0.93), 0.0), 0.0);
        for width in [0.3, 0.5, 0.7] {
            // Over whole lines in equal steps of latitude the mean is the width.
            let at = |k: i32| {
                let latitude = f64::from(k) / 1000.0 * PI / 5.0;
                hatching.coverage(Vec3::new(0.0, latitude.sin(), latitude.cos()), width)
            };
            let mean = (0..1000).map(at).sum::<f64>() / 1000.0;
            assert!((mean - width).abs() < 2e-3, "{width}: {mean}");
        }
    }

    #[test]
    fn lines_run_around_their_axis() {
        let hatching = Hatching { axis: Vec3::new(0.0, 1.0, 0.0), lines: 20.0, stray: 0.0, soft: 0.1 };
        for y in [-0.7, 0.11, 0.5] {
            let at = |turn: f64| {
                let r = (1.0f64 - y * y).sqrt();
                hatching.coverage(Vec3::new(r * turn.sin(), y, r * turn.cos()), 0.4)
            };
            assert!((0..20).all(|k| (at(0.1 * f64::from(k) - 1.0) - at(0.0)).abs() < 1e-9));
        }
    }
}
