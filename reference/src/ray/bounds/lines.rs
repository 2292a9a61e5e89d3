//! Lines inside a volume, between the shares of samples that they split ([HATCH-14] d).
//!
//! The order of lines and samples jumps where a line crosses the end of a sample's step, but the picture does not: the
//! share between line and end has length 0 there. A renderer in f32 knows a line's depth to e = 4u(d/Δ + 1) steps, from
//! the rounding of d/Δ and of the differences to it. So each share has an error of 2e steps. A share of length 0 ± e
//! stands on the other side of a line that lies within e of an end.

use super::cast::{Tracer, Visit};
use super::surface::BoundedHit;
use crate::number::{Arithmetic, Bounded, Decision, Real};
use drypoint_scene::fragments::Fragment;

/// Half a unit in the last place of 1.
const ROUNDING: f64 = 0.5 * f32::EPSILON as f64;

/// The error of a line's depth, in steps.
fn error_of(depth_in_steps: f64) -> f64 {
    4.0 * ROUNDING * (depth_in_steps.abs() + 1.0)
}

impl<'p> Tracer<'p, '_> {
    /// The lines of the ray before the end of the ray.
    pub(super) fn lines_before(&mut self, lines: &'p [Fragment], hit: Option<BoundedHit>) -> &'p [Fragment] {
        let Some(hit) = hit else { return lines };
        let step = self.evaluator.ray.depth_step.value();
        let slack = |line: &Fragment| hit.error + error_of(line.depth / step) * step;
        if lines.iter().any(|line| (line.depth - hit.t).abs() <= slack(line)) {
            self.mark(Decision::Surface);
        }
        &lines[..lines.iter().take_while(|line| line.depth < hit.t).count()]
    }

    /// Composites a sample and the lines before its end, which is a depth with an error in steps. Returns whether the
    /// ray is still open.
    #[inline]
    pub(super) fn lay_among_lines(&mut self, visit: Visit, (until, until_error): (f64, f64)) -> bool {
        let step = self.evaluator.ray.depth_step.value();
        let start = visit.k as f64 * step;
        let (mut from, mut is_split) = ((start, 0.0), visit.is_last);
        while let Some(line) = self.lines.first() {
            // The reference splits the sample in whose step it counts the line, wherever the step's end is rounded to.
            is_split |= line.depth > start && (line.depth / step).floor() <= visit.k as f64;
            if line.depth >= until {
                break;
            }
            let error = error_of(line.depth / step);
            let to = line.depth.max(from.0);
            if line.depth > start - error * step && !self.lay_share(&visit, from, (to, error), true) {
                return false;
            }
            if !self.meet_line() {
                return false;
            }
            from = (to, error);
        }
        let is_open = self.lay_share(&visit, from, (until, until_error), is_split);
        self.before = Some((visit, until));
        is_open
    }

    /// Composites the lines that are left. Returns whether the ray is still open.
    #[inline]
    pub(super) fn lay_lines_left(&mut self) -> bool {
        while !self.lines.is_empty() {
            if !self.meet_line() {
                return false;
            }
        }
        true
    }

    /// Composites the share of a sample between two depths, each with an error in steps; the whole one if it is not
    /// split.
    #[inline]
    fn lay_share(&mut self, visit: &Visit, from: (f64, f64), to: (f64, f64), is_split: bool) -> bool {
        let (ray, reference) = (&self.evaluator.ray, self.prepared.object.reference_length);
        let share = (to.0 - from.0) / ray.depth_step.value();
        let error = (from.1 + to.1 + error_of(share)) * ray.step / reference;
        let steps = if is_split { share * ray.step / reference } else { self.steps.value() };
        self.lay(visit, Bounded::new(steps, self.steps.error() + error))
    }

    /// Composites the next line, and behind it a share of length 0 of the sample before it if that ends there. Returns
    /// whether the ray is still open.
    #[inline]
    fn meet_line(&mut self) -> bool {
        let Some((line, left)) = self.lines.split_first() else { return true };
        self.lines = left;
        if !self.lay_line(line) {
            return false;
        }
        let error = error_of(line.depth / self.evaluator.ray.depth_step.value());
        match self.before {
            Some((visit, end)) if line.depth < end + error * self.evaluator.ray.depth_step.value() => {
                self.lay_share(&visit, (end, 0.0), (end, error), true)
            }
            _ => true,
        }
    }

    /// Composites a line. Returns whether the ray is still open.
    #[inline]
    fn lay_line(&mut self, line: &Fragment) -> bool {
        let rgb = self.in_blend_space(line.rgb.map(Bounded::from_f64));
        let alpha = Bounded::from_f64(line.opacity);
        if alpha.value() >= 1.0 {
            self.traced.front.end(rgb);
            return false;
        }
        if alpha.ends()[1] >= 1.0 {
            self.mark(Decision::End);
        }
        self.traced.front.over(rgb, alpha);
        self.of_lines = self.of_lines.laid_before(alpha).1;
        self.is_open()
    }
}
