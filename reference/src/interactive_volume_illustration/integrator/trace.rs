//! Curves along a field of lines: RK4(3) with first-same-as-last, adaptive steps and dense output ([HATCH-4], [HATCH-8];
//! Hairer, Nørsett and Wanner, *Solving Ordinary Differential Equations I*, II.4; Stalling and Hege 1995).
//!
//! A field of lines has directions without sign: v and −v are the same. So the stages of a step are turned to its first one,
//! k₁, and the new direction k₅ to k₄; no orientation of the whole field is needed, and there may be none.

use super::Piece;
use drypoint_scene::glam::DVec3;
use std::cell::Cell;

/// cos 60°: a stage that turns by more belongs to no smooth line.
const SMOOTH: f64 = 0.5;

/// How often a step is tried again to end at a kink: each time it is as near as its own error.
const TRIES_AT_KINK: u32 = 3;

/// Pieces that there is room for from the start.
const PIECES: usize = 16;

/// A field of lines.
pub trait Lines {
    /// Why there may be none.
    type Cause;

    /// The direction at a place, of length 1, with either sign.
    ///
    /// # Errors
    /// There is none here.
    fn at(&mut self, x: DVec3) -> Result<DVec3, Self::Cause>;

    /// The same where a curve comes along `like`, for fields whose lines depend on it.
    ///
    /// # Errors
    /// There is none here.
    fn at_along(&mut self, x: DVec3, _like: DVec3) -> Result<DVec3, Self::Cause> {
        self.at(x)
    }

    /// Where a step ends instead that has come off what the curve is to stay on; none where it is fine.
    fn put_back(&mut self, _x: DVec3) -> Option<DVec3> {
        None
    }

    /// The parameter of a piece, inside it, at which it first comes to where the field has a kink: the step is to end there.
    fn kink(&self, _piece: &Piece) -> Option<f64> {
        None
    }

    /// By which of its formulas the field had its last direction; from one to another it jumps.
    fn formula(&self) -> usize {
        0
    }
}

/// A place that a curve may come to, to end there.
#[derive(Clone, Copy, Debug)]
pub struct Goal {
    /// Where it is.
    pub at: DVec3,
    /// The direction of a curve that comes to it.
    pub along: DVec3,
    /// How near a curve must pass.
    pub within: f64,
    /// How far a curve must have gone before: one that begins at its goal comes back, and is not there at once.
    pub after: f64,
}

/// How far and how exactly a curve is followed; all lengths in the unit of the places.
#[derive(Clone, Copy, Debug)]
pub struct Control {
    /// The most that a step may err by, as it estimates itself: ‖h/6·(k₄ − k₅)‖, and h/6 times the most that a stage differs
    /// from k₁ where the field jumps between them.
    pub tolerance: f64,
    /// The first step.
    pub first: f64,
    /// The least step; a curve that needs a smaller one ends.
    pub min_step: f64,
    /// The largest step.
    pub max_step: f64,
    /// The arc length.
    pub length: f64,
    /// cos of the largest angle to the first direction; −1: any.
    pub cos_max_angle: f64,
    /// Where the curve is closed.
    pub goal: Option<Goal>,
}

/// Why a curve ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End<C> {
    /// It has its length.
    Length,
    /// Its direction is too far from the first.
    Angle,
    /// The field has no direction, whatever the step.
    Field(C),
    /// The lines of the field turn within the smallest step.
    Turns,
    /// The tolerance asks for a smaller step than the smallest.
    Step,
    /// It is at its goal, and its last piece ends there.
    Closed,
}

/// One way from a place.
#[derive(Clone, Debug)]
pub struct Half<C> {
    /// One after another.
    pub pieces: Vec<Piece>,
    /// Its arc length, the sum of the steps.
    pub length: f64,
    /// Why it ends.
    pub end: End<C>,
    /// How often the field was asked.
    pub evaluations: u32,
    /// Steps that were tried again.
    pub rejected: u32,
}

/// What is wrong with a step.
enum Fault<C> {
    Field(C),
    Turns,
    /// The error is too large; the factor for the next try.
    Error(f64),
}

/// Where a step begins.
struct State {
    x: DVec3,
    /// k₁.
    k: DVec3,
    /// By which formula.
    formula: usize,
}

/// A step that is fine.
struct Step {
    piece: Piece,
    /// Where the next one begins, with k₅ for its k₁.
    to: State,
    /// For the next step.
    factor: f64,
}

/// Follows the line from `start` along `along`, the field's direction there with the sign that is wanted; the field was asked
/// for it last.
pub fn trace<L: Lines>(field: &mut L, start: DVec3, along: DVec3, control: &Control) -> Half<L::Cause> {
    let mut half =
        Half { pieces: Vec::with_capacity(PIECES), length: 0.0, end: End::Length, evaluations: 0, rejected: 0 };
    let mut at = State { x: start, k: along, formula: field.formula() };
    let mut h = control.first.min(control.max_step);
    // The step that would have been fine but for a kink, and how often it was shortened.
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
                    && let Some(s) = field.kink(&done.piece)
                {
                    kink = Some((whole, tries + 1));
                    half.rejected += 1;
                    h = s * step;
                    continue;
                }
                kink = None;
                if let Some((piece, share, end)) = ends(&done, along, half.length, step, control) {
                    if share > 0.0 {
                        half.pieces.push(piece);
                        half.length += share * step;
                    }
                    half.end = end;
                    return half;
                }
                half.pieces.push(done.piece);
                half.length = if last { control.length } else { half.length + step };
                at = done.to;
                // One that was cut short at a kink says nothing about the next.
                h = (step * done.factor).max(if tries > 0 { whole } else { 0.0 }).min(control.max_step);
            }
            Err(fault) if step <= control.min_step => {
                half.end = match fault {
                    Fault::Field(cause) => End::Field(cause),
                    Fault::Turns => End::Turns,
                    Fault::Error(_) => End::Step,
                };
                return half;
            }
            Err(fault) => {
                half.rejected += 1;
                kink = None;
                let factor = if let Fault::Error(factor) = fault { factor } else { 0.5 };
                h = (step * factor).max(control.min_step);
            }
        }
    }
}

/// A step of classical RK4 with its error by the third-order solution that has k₅ in place of k₄, and the factor for the
/// next: clamp(0.9·(tol/err)^¼, 0.2, 4).
fn try_step<L: Lines>(
    field: &mut L,
    from: &State,
    h: f64,
    control: &Control,
    evaluations: &mut u32,
) -> Result<Step, Fault<L::Cause>> {
    let (x, k1, tolerance) = (from.x, from.k, control.tolerance);
    let jump = Cell::new(0.0f64);
    let mut stage = |field: &mut L, at: DVec3, like: DVec3| {
        *evaluations += 1;
        let v = field.at_along(at, like).map_err(Fault::Field)?;
        let v = if v.dot(like) < 0.0 { -v } else { v };
        // k₅ has its sign from k₄, and both may have turned away from k₁.
        if v.dot(like) < SMOOTH || v.dot(k1) < SMOOTH {
            return Err(Fault::Turns);
        }
        if field.formula() != from.formula {
            jump.set(jump.get().max((v - k1).length()));
        }
        Ok(v)
    };
    let k2 = stage(field, x + k1 * (0.5 * h), k1)?;
    let k3 = stage(field, x + k2 * (0.5 * h), k1)?;
    let k4 = stage(field, x + k3 * h, k1)?;
    let mut to = x + (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
    let mut k5 = stage(field, to, k4)?;
    let error = (k4 - k5).length() * (h / 6.0);
    // k₄ and k₅ may agree beyond a jump. What it does to the smallest step is no reason to end.
    let across = if h > control.min_step { jump.get() * (h / 6.0) } else { 0.0 };
    if across > tolerance && across > error {
        return Err(Fault::Error((0.9 * (tolerance / across)).clamp(0.2, 0.9)));
    }
    let factor = if error > 0.0 { (0.9 * (tolerance / error).sqrt().sqrt()).clamp(0.2, 4.0) } else { 4.0 };
    if error > tolerance {
        // Another try is a shorter one.
        return Err(Fault::Error(factor.min(0.9)));
    }
    if let Some(back) = field.put_back(to) {
        to = back;
        k5 = stage(field, to, k5)?;
    }
    let next = State { x: to, k: k5, formula: field.formula() };
    Ok(Step { piece: Piece { ends: [x, to], tangents: [k1 * h, k5 * h] }, to: next, factor })
}

/// Whether a step is the last: what of its piece counts, as a piece and as a share, and why it ends there.
fn ends<C>(done: &Step, along: DVec3, before: f64, step: f64, control: &Control) -> Option<(Piece, f64, End<C>)> {
    let piece = &done.piece;
    let any = control.cos_max_angle <= -1.0;
    let turned = if any { None } else { piece.turned(along, control.cos_max_angle) };
    if let Some(goal) = control.goal
        && before >= goal.after
        && goal.at.distance(piece.ends[1]) <= step + goal.within
    {
        let (s, distance) = piece.nearest(goal.at);
        let first = turned.is_none_or(|t| s < t);
        if first && distance <= goal.within && s > 0.0 && piece.tangent(s).dot(goal.along) > SMOOTH * step {
            let mut closed = piece.until(s);
            closed.ends[1] = goal.at;
            closed.tangents[1] = goal.along * (s * step);
            return Some((closed, s, End::Closed));
        }
    }
    turned.map(|s| (piece.until(s), s, End::Angle))
}

#[cfg(test)]
mod tests;
