//! The look of a point of a line inside the volume ([VS-8], [VS-12]).

use super::composite::{RayState, Step};
use super::pixel_sum::over;
use super::prepared::Prepared;
use super::sample::need::Anything;
use crate::number::Real;
use drypoint_scene::color::Rgb;
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragment;

/// A point of an opaque line, as it is seen through what lies before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinePoint {
    /// The colour of its pixel, linear: what lies before the point over the line.
    pub rgb: Rgb,
    /// The share of the line's light that reaches the eye: 1 minus the opacity before the point.
    pub visible: f64,
}

/// Follows the ray through a point of the picture to an opaque line of a colour at an eye depth. The line is not seen
/// outside the picture, or if the ray ends before it.
pub(super) fn line_point<R: Real>(prepared: &Prepared<'_, R>, point: [f64; 2], depth: f64, rgb: Rgb) -> LinePoint {
    let hidden = LinePoint { rgb, visible: 0.0 };
    let is_inside = |axis: usize| (0.0..=prepared.view.size[axis] as f64).contains(&point[axis]);
    if !(is_inside(0) && is_inside(1) && depth.is_finite()) {
        return hidden;
    }
    let line = [Fragment { depth, rgb, opacity: 1.0 }];
    let mut state = RayState::new(prepared, &prepared.object.field, point);
    let mut steps = Vec::new();
    let mut counts = Counts::default();
    state.path_among((point, &line), None, &mut steps, &mut counts);
    for step in &steps {
        let visible = 1.0 - state.opacity().to_f64();
        let is_line = matches!(step, Step::Line { .. });
        let is_open = state.take::<Anything>(step, None, &mut counts);
        if is_line {
            let [r, g, b, _] = over(state.finish(&mut counts).rgba, [0.0; 4], prepared.encode);
            return LinePoint { rgb: [r, g, b], visible };
        }
        if !is_open {
            break;
        }
    }
    hidden
}
