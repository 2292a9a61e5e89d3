//! Integral curves of a field of lines: RK4(3) with first-same-as-last, adaptive steps and dense output ([HATCH-4],
//! [HATCH-8]; Hairer, Nørsett and Wanner, *Solving Ordinary Differential Equations I*, II.4; Stalling and Hege 1995).
//!
//! A field of lines has directions without sign: v and −v are the same. So the stages of a step are turned to its
//! first one, k₁, and the new direction k₅ to k₄. The whole field needs no orientation, and it may have none.

use super::CubicSegment;
use drypoint_scene::glam::DVec3;
use std::cell::Cell;

/// cos 60°: a stage that turns by more does not belong to a smooth line.
const SMOOTH: f64 = 0.5;

/// Number of retries of a step that should end at a kink. Each retry ends as near to the kink as its own error.
const TRIES_AT_KINK: u32 = 3;

/// Initial capacity for segments.
const CAPACITY: usize = 16;

/// A field of lines.
pub trait LineField {
    /// The reason why a place has no direction.
    type Cause;

    /// The direction at a place, of length 1, with either sign.
    ///
    /// # Errors
    /// The place has no direction.
    fn at(&mut self, x: DVec3) -> Result<DVec3, Self::Cause>;

    /// The direction at a place on a curve that arrives along `like`. It differs from [`at`](Self::at) for fields
    /// whose lines depend on the curve.
    ///
    /// # Errors
    /// The place has no direction.
    fn at_along(&mut self, x: DVec3, _like: DVec3) -> Result<DVec3, Self::Cause> {
        self.at(x)
    }

    /// Moves the end of a step back onto the surface or curve on which the curve must stay. Returns none if the end
    /// needs no correction.
    fn put_back(&mut self, _x: DVec3) -> Option<DVec3> {
        None
    }

    /// The parameter inside a segment at which it first meets a kink of the field. The step ends there.
    fn kink(&self, _segment: &CubicSegment) -> Option<f64> {
        None
    }

    /// Index of the formula that gave the last direction. The field jumps from one formula to another.
    fn formula(&self) -> usize {
        0
    }
}

/// A place at which a curve ends if it comes close.
#[derive(Clone, Copy, Debug)]
pub struct Goal {
    /// The place.
    pub at: DVec3,
    /// The direction of a curve that arrives at the place.
    pub along: DVec3,
    /// The largest distance at which a curve counts as arrived.
    pub within: f64,
    /// The least length of the curve. With it, a curve that begins at its goal does not count as arrived at once.
    pub after: f64,
}

/// Length and accuracy of a curve. All lengths are in the unit of the places.
#[derive(Clone, Copy, Debug)]
pub struct Control {
    /// The largest estimated error of a step. The estimate is ‖h/6·(k₄ − k₅)‖. Where the field jumps between stages,
    /// h/6 times the largest difference of a stage from k₁ is added.
    pub tolerance: f64,
    /// Length of the first step.
    pub first: f64,
    /// Length of the smallest step; a curve that needs a smaller one ends.
    pub min_step: f64,
    /// The largest step.
    pub max_step: f64,
    /// The arc length.
    pub length: f64,
    /// Cosine of the largest angle to the first direction; −1 allows any.
    pub cos_max_angle: f64,
    /// The place at which the curve closes.
    pub goal: Option<Goal>,
}

/// The cause of a curve's end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EndCause<C> {
    /// The curve has its full length.
    Length,
    /// The direction differs too much from the first one.
    Angle,
    /// The field has no direction, whatever the step.
    Field(C),
    /// The field's lines turn within the smallest step.
    Turns,
    /// The tolerance requires a step below the smallest one.
    Step,
    /// The curve is at its goal, and its last segment ends there.
    Closed,
}

/// One half of a curve, from a place in one direction.
#[derive(Clone, Debug)]
pub struct HalfCurve<C> {
    /// Consecutive segments.
    pub segments: Vec<CubicSegment>,
    /// The arc length, the sum of the steps.
    pub length: f64,
    /// The cause of the end.
    pub end: EndCause<C>,
    /// Number of evaluations of the field.
    pub evaluations: u32,
    /// Number of rejected steps.
    pub rejected: u32,
}

/// The reason why a step is rejected.
enum StepFault<C> {
    Field(C),
    Turns,
    /// The error is too large. The value is the factor for the next try.
    Error(f64),
}

/// The start of a step.
struct StepStart {
    x: DVec3,
    /// The direction k₁.
    k: DVec3,
    /// Index of the formula that gave k₁.
    formula: usize,
}

/// An accepted step.
struct AcceptedStep {
    segment: CubicSegment,
    /// The start of the next step, with k₅ as its k₁.
    to: StepStart,
    /// Factor for the length of the next step.
    factor: f64,
}

/// Traces the line from `start`. `along` is the field's direction there, with the wanted sign, and must be the
/// field's last answer.
pub fn trace<L: LineField>(field: &mut L, start: DVec3, along: DVec3, control: &Control) -> HalfCurve<L::Cause> {
    let mut half = HalfCurve {
        segments: Vec::with_capacity(CAPACITY),
        length: 0.0,
        end: EndCause::Length,
        evaluations: 0,
        rejected: 0,
    };
    let mut at = StepStart { x: start, k: along, formula: field.formula() };
    let mut h = control.first.min(control.max_step);
    // The length of the step without the kink, and the number of times it was shortened.
    let mut kink: Option<(f64, u32)> = None;
    loop {
        let left = control.length - half.length;
        if left <= 0.0 {
            return half;
        }
        let last = h >= left;
        let step = if last { left } else { h };
        match try_step(field, &at, step, control, &mut half.evaluations) {
            Ok(done) => {
                let (whole, tries) = kink.unwrap_or((step, 0));
                if tries < TRIES_AT_KINK
                    && let Some(s) = field.kink(&done.segment)
                {
                    // The step is tried again up to the kink, so that no step crosses it.
                    kink = Some((whole, tries + 1));
                    half.rejected += 1;
                    h = s * step;
                    continue;
                }
                kink = None;
                if let Some((segment, share, end)) = ends(&done, along, half.length, step, control) {
                    if share > 0.0 {
                        half.segments.push(segment);
                        half.length += share * step;
                    }
                    half.end = end;
                    return half;
                }
                half.segments.push(done.segment);
                half.length = if last { control.length } else { half.length + step };
                at = done.to;
                // A step that was shortened at a kink does not limit the next one.
                h = (step * done.factor).max(if tries > 0 { whole } else { 0.0 }).min(control.max_step);
            }
            // The smallest step fails: the curve ends.
            Err(fault) if step <= control.min_step => {
                half.end = match fault {
                    StepFault::Field(cause) => EndCause::Field(cause),
                    StepFault::Turns => EndCause::Turns,
                    StepFault::Error(_) => EndCause::Step,
                };
                return half;
            }
            Err(fault) => {
                half.rejected += 1;
                kink = None;
                let factor = if let StepFault::Error(factor) = fault { factor } else { 0.5 };
                h = (step * factor).max(control.min_step);
            }
        }
    }
}

/// One step of the classical RK4. The error estimate comes from the third-order solution that has k₅ in place of k₄.
/// The factor for the next step is clamp(0.9·(tol/err)^¼, 0.2, 4).
fn try_step<L: LineField>(
    field: &mut L,
    from: &StepStart,
    h: f64,
    control: &Control,
    evaluations: &mut u32,
) -> Result<AcceptedStep, StepFault<L::Cause>> {
    let (x, k1, tolerance) = (from.x, from.k, control.tolerance);
    let jump = Cell::new(0.0f64);
    let mut stage = |field: &mut L, at: DVec3, like: DVec3| {
        *evaluations += 1;
        let v = field.at_along(at, like).map_err(StepFault::Field)?;
        let v = if v.dot(like) < 0.0 { -v } else { v };
        // The sign of k₅ comes from k₄, and both may have turned away from k₁.
        if v.dot(like) < SMOOTH || v.dot(k1) < SMOOTH {
            return Err(StepFault::Turns);
        }
        if field.formula() != from.formula {
            jump.set(jump.get().max((v - k1).length()));
        }
        Ok(v)
    };
    // Classical RK4; k₅ is k₁ of the next step. The embedded solution has k₅ for k₄, so they differ by h/6·(k₄ − k₅).
    let k2 = stage(field, x + k1 * (0.5 * h), k1)?;
    let k3 = stage(field, x + k2 * (0.5 * h), k1)?;
    let k4 = stage(field, x + k3 * h, k1)?;
    let mut to = x + (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
    let mut k5 = stage(field, to, k4)?;
    let error = (k4 - k5).length() * (h / 6.0);
    // k₄ and k₅ may agree beyond a jump, so the jump has an estimate of its own. It does not end the smallest step.
    let across = if h > control.min_step { jump.get() * (h / 6.0) } else { 0.0 };
    if across > tolerance && across > error {
        return Err(StepFault::Error((0.9 * (tolerance / across)).clamp(0.2, 0.9)));
    }
    // The error is of fourth order in h, so the next step has the factor (tol/err)^¼ and a margin.
    let factor = if error > 0.0 { (0.9 * (tolerance / error).sqrt().sqrt()).clamp(0.2, 4.0) } else { 4.0 };
    if error > tolerance {
        // A retry is always shorter.
        return Err(StepFault::Error(factor.min(0.9)));
    }
    // A step off its surface ends on the surface, with the direction there.
    if let Some(back) = field.put_back(to) {
        to = back;
        k5 = stage(field, to, k5)?;
    }
    let next = StepStart { x: to, k: k5, formula: field.formula() };
    Ok(AcceptedStep { segment: CubicSegment { ends: [x, to], tangents: [k1 * h, k5 * h] }, to: next, factor })
}

/// Tests whether a step is the last one. Returns the part of its segment that counts, its share, and the cause of the
/// end.
fn ends<C>(
    done: &AcceptedStep,
    along: DVec3,
    before: f64,
    step: f64,
    control: &Control,
) -> Option<(CubicSegment, f64, EndCause<C>)> {
    let segment = &done.segment;
    let any = control.cos_max_angle <= -1.0;
    let turned = if any { None } else { segment.turned(along, control.cos_max_angle) };
    if let Some(goal) = control.goal
        && before >= goal.after
        && goal.at.distance(segment.ends[1]) <= step + goal.within
    {
        let (s, distance) = segment.nearest(goal.at);
        let first = turned.is_none_or(|t| s < t);
        if first && distance <= goal.within && s > 0.0 && segment.tangent(s).dot(goal.along) > SMOOTH * step {
            let mut closed = segment.until(s);
            closed.ends[1] = goal.at;
            closed.tangents[1] = goal.along * (s * step);
            return Some((closed, s, EndCause::Closed));
        }
    }
    turned.map(|s| (segment.until(s), s, EndCause::Angle))
}

#[cfg(test)]
mod tests;
