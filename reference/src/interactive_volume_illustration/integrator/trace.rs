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
mod tests {
    use super::*;
    use drypoint_scene::glam::DQuat;
    use std::f64::consts::{PI, TAU};

    /// A field by a formula, whose sign jumps from place to place as no tracer must notice.
    struct Formula<F>(F);

    impl<F: Fn(DVec3) -> DVec3> Lines for Formula<F> {
        type Cause = ();
        fn at(&mut self, x: DVec3) -> Result<DVec3, ()> {
            let v = (self.0)(x);
            if v.length() < 1e-12 {
                return Err(());
            }
            let flip = ((x.x * 7919.0).floor() + (x.y * 104729.0).floor()) as i64 % 2 == 0;
            Ok(if flip { -v.normalize() } else { v.normalize() })
        }
    }

    fn control(tolerance: f64, length: f64) -> Control {
        Control {
            tolerance,
            first: 1.0,
            min_step: 1e-9,
            max_step: f64::INFINITY,
            length,
            cos_max_angle: -1.0,
            goal: None,
        }
    }

    fn circle(x: DVec3) -> DVec3 {
        DVec3::new(-x.y, x.x, 0.0)
    }

    fn helix(x: DVec3) -> DVec3 {
        DVec3::new(-x.y, x.x, 3.0)
    }

    fn end<C>(half: &Half<C>) -> DVec3 {
        half.pieces[half.pieces.len() - 1].ends[1]
    }

    /// Along x up to 7.3, then aslant; it says which of both it was asked for last, or keeps it to itself.
    struct Bent {
        beyond: bool,
        says: bool,
    }

    const ASLANT: DVec3 = DVec3::new(0.8, 0.6, 0.0);

    impl Lines for Bent {
        type Cause = ();
        fn at(&mut self, x: DVec3) -> Result<DVec3, ()> {
            self.beyond = x.x > 7.3;
            Ok(if self.beyond { ASLANT } else { DVec3::X })
        }
        fn formula(&self) -> usize {
            usize::from(self.beyond && self.says)
        }
    }

    /// A step of h across a jump of size j errs by hj/3 at the most, as k₁ … k₄ weigh ⅙, ⅓, ⅓, ⅙; it is taken where hj/6 is within
    /// the tolerance. Where k₄ and k₅ agree beyond the jump, nothing else would show it.
    #[test]
    fn steps_narrow_down_to_where_the_formula_changes() {
        let end_of = |says: bool, tolerance: f64, first: f64| {
            let control = Control { first, max_step: 2.0, ..control(tolerance, 20.0) };
            let half = trace(&mut Bent { beyond: false, says }, DVec3::ZERO, DVec3::X, &control);
            assert_eq!((half.end, half.length), (End::Length, 20.0));
            end(&half).distance(DVec3::X * 7.3 + ASLANT * 12.7)
        };
        let mut missed = 0;
        for power in 1..=8 {
            for first in [0.9, 1.0, 1.7, 2.0] {
                let tolerance = 10f64.powi(-power);
                let error = end_of(true, tolerance, first);
                assert!(error <= 2.0 * tolerance + 1e-12, "{error:e} at {tolerance:e}");
                missed += u32::from(end_of(false, tolerance, first) > 10.0 * tolerance);
            }
        }
        assert!(missed > 4, "{missed}");
    }

    /// The global error after an arc of 40 on a circle of radius 20 and a helix of radius 10 is at most twice the tolerance,
    /// from 10⁻¹ to 10⁻¹⁰, and falls with the fourth power of the number of steps: slope −3.8 or steeper.
    #[test]
    fn the_error_is_that_of_the_tolerance_and_of_fourth_order() {
        let n = 109f64.sqrt();
        let on_circle = |s: f64| DVec3::new((s / 20.0).cos(), (s / 20.0).sin(), 0.0) * 20.0;
        let on_helix = |s: f64| DVec3::new(10.0 * (s / n).cos(), 10.0 * (s / n).sin(), 3.0 * s / n);
        let helix_at_start = DVec3::new(0.0, 10.0, 3.0) / n;
        let mut measured = [const { Vec::new() }; 2];
        for power in 1..=10 {
            let control = control(10f64.powi(-power), 40.0);
            let halves = [
                (trace(&mut Formula(circle), DVec3::X * 20.0, DVec3::Y, &control), on_circle(40.0)),
                (trace(&mut Formula(helix), DVec3::X * 10.0, helix_at_start, &control), on_helix(40.0)),
            ];
            for ((half, want), measured) in halves.into_iter().zip(&mut measured) {
                let error = end(&half).distance(want);
                assert!(error <= 2.0 * control.tolerance, "{error:e} at {:e}", control.tolerance);
                assert_eq!((half.end, half.length), (End::Length, 40.0));
                assert_eq!(half.evaluations as usize, 4 * half.pieces.len() + 4 * half.rejected as usize);
                measured.push(((half.pieces.len() as f64).ln(), error.ln()));
            }
        }
        for measured in measured {
            let ((n0, e0), (n1, e1)) = (measured[4], measured[9]);
            assert!((e1 - e0) / (n1 - n0) <= -3.8, "{}", (e1 - e0) / (n1 - n0));
        }
    }

    /// Between the ends the cubic leaves the circle by h⁴/(384 r³), and as much again for what its ends err.
    #[test]
    fn between_the_steps_it_is_as_exact() {
        let half = trace(&mut Formula(circle), DVec3::X * 20.0, DVec3::Y, &control(1e-6, 40.0));
        for piece in &half.pieces {
            let h = piece.tangents[0].length();
            for i in 0..=10 {
                let off = (piece.point(f64::from(i) / 10.0).length() - 20.0).abs();
                assert!(off <= h.powi(4) / (384.0 * 8000.0) * 1.1 + 1e-6, "{off:e} at {h}");
            }
        }
    }

    /// The other way round the same curve, mirrored: a helix turned by 180° about x is itself.
    #[test]
    fn both_ways_are_the_same() {
        let along = DVec3::new(0.0, 10.0, 3.0) / 109f64.sqrt();
        let [to, fro] = [along, -along].map(|k| trace(&mut Formula(helix), DVec3::X * 10.0, k, &control(1e-4, 40.0)));
        assert_eq!(to.pieces.len(), fro.pieces.len());
        for (a, b) in to.pieces.iter().zip(&fro.pieces) {
            assert_eq!(a.ends[1], b.ends[1] * DVec3::new(1.0, -1.0, -1.0));
        }
    }

    /// A circle is joined where it began, and a spiral that misses its beginning by more than is allowed is not.
    #[test]
    fn a_ring_closes_and_a_spiral_does_not() {
        let goal = |along| Some(Goal { at: DVec3::X * 20.0, along, within: 0.25, after: 1.0 });
        let closing = Control { goal: goal(DVec3::Y), ..control(1e-4, 400.0) };
        let ring = trace(&mut Formula(circle), DVec3::X * 20.0, DVec3::Y, &closing);
        assert_eq!((ring.end, end(&ring)), (End::Closed, DVec3::X * 20.0));
        // Sixteen steps of 10⁻⁴ at the most, and half as much in the length of the last.
        assert!((ring.length - 40.0 * PI).abs() < 2e-3, "{}", ring.length);
        let spiral = |x: DVec3| circle(x) + x * (0.5 / (20.0 * TAU));
        let along = spiral(DVec3::X * 20.0).normalize();
        let closing = Control { goal: goal(along), ..closing };
        assert_eq!(trace(&mut Formula(spiral), DVec3::X * 20.0, along, &closing).end, End::Length);
    }

    /// A goal just ahead is there at once, where the curve need not come back, and one just behind is not.
    #[test]
    fn a_goal_can_be_near() {
        for ahead in [0.3, 0.6, 1.4, 3.0] {
            for sign in [1.0, -1.0] {
                let angle = sign * ahead / 20.0;
                let [at, along] = [DVec3::X * 20.0, DVec3::Y].map(|v| DQuat::from_rotation_z(angle) * v);
                let goal = Some(Goal { at, along, within: 0.15, after: 0.0 });
                let half =
                    trace(&mut Formula(circle), DVec3::X * 20.0, DVec3::Y, &Control { goal, ..control(1e-4, 400.0) });
                let length = if sign > 0.0 { ahead } else { 40.0 * PI - ahead };
                assert_eq!((half.end, end(&half)), (End::Closed, at));
                assert!((half.length - length).abs() < 2e-3, "{ahead} {sign}: {}", half.length);
            }
        }
    }

    #[test]
    fn it_ends_at_the_largest_angle() {
        let control = Control { cos_max_angle: (PI / 4.0).cos(), ..control(1e-6, 400.0) };
        let half = trace(&mut Formula(circle), DVec3::X * 20.0, DVec3::Y, &control);
        assert_eq!(half.end, End::Angle);
        // The cubic's direction errs by h³/(96·√3·r³) or so, some 10⁻⁵ here.
        assert!((half.length - 5.0 * PI).abs() < 1e-3, "{}", half.length);
    }

    /// The angle is asked between the steps, too: of a circle that goes round, steps of 32° pass a window of 20°.
    #[test]
    fn no_step_jumps_over_the_largest_angle() {
        for degrees in [150.0f64, 170.0, 179.0, 179.9] {
            for radius in [2.0, 3.7, 20.0] {
                let angle = degrees.to_radians();
                let goal = Some(Goal { at: DVec3::X * radius, along: DVec3::Y, within: 0.15, after: 0.6 });
                let control = Control { cos_max_angle: angle.cos(), max_step: 2.0, goal, ..control(1e-2, 400.0) };
                let half = trace(&mut Formula(circle), DVec3::X * radius, DVec3::Y, &control);
                assert_eq!(half.end, End::Angle, "{degrees} {radius}");
                // An arc of the limit, but for a hundredth, what some steps of 10⁻² turn a direction by.
                assert!((half.length / radius - angle).abs() < 0.05, "{degrees} {radius}: {}", half.length / radius);
            }
        }
    }

    /// No step turns by more than 60°, whatever the tolerance: the stages and k₅ are held against k₁.
    #[test]
    fn no_step_turns_by_more_than_sixty_degrees() {
        for first in [0.5, 1.0, 1.5, 2.0, 3.0] {
            let control = Control { first, ..control(1e9, 40.0) };
            let half = trace(&mut Formula(circle), DVec3::X, DVec3::Y, &control);
            assert_eq!(half.end, End::Length);
            for piece in &half.pieces {
                let turn = piece.tangents[0].angle_between(piece.tangents[1]).to_degrees();
                assert!(turn <= 60.0 + 1e-9, "{first}: {turn}");
            }
        }
    }

    /// Where the field ends the curve ends, the smallest step before it.
    #[test]
    fn it_goes_up_to_the_border_of_the_field() {
        let inside = |x: DVec3| if x.x < 7.3 { DVec3::X } else { DVec3::ZERO };
        let control = Control { min_step: 1e-3, max_step: 2.0, ..control(1e-3, 40.0) };
        let half = trace(&mut Formula(inside), DVec3::ZERO, DVec3::X, &control);
        assert_eq!(half.end, End::Field(()));
        assert!(end(&half).x < 7.3 && end(&half).x > 7.3 - 2e-3, "{}", end(&half));
        assert!(half.pieces.iter().all(|piece| piece.tangents[0].x <= 2.0));
    }

    /// A kink by less than 60° is gone round in small steps; one by more ends the curve.
    #[test]
    fn a_kink_ends_it() {
        let kink = |degrees: f64| {
            let (s, c) = degrees.to_radians().sin_cos();
            let field = move |x: DVec3| if x.x < 5.0 { DVec3::X } else { DVec3::new(c, s, 0.0) };
            let control = Control { min_step: 1e-3, ..control(1e-2, 20.0) };
            trace(&mut Formula(field), DVec3::ZERO, DVec3::X, &control)
        };
        assert_eq!(kink(40.0).end, End::Length);
        let turned = kink(70.0);
        assert_eq!(turned.end, End::Turns);
        assert!((end(&turned).x - 5.0).abs() < 2e-3);
    }

    /// A curve on the unit sphere along a field that leads off it stays on it, and asks once more for each step.
    #[test]
    fn a_step_that_comes_off_is_put_back() {
        struct Climbing;
        impl Lines for Climbing {
            type Cause = ();
            fn at(&mut self, x: DVec3) -> Result<DVec3, ()> {
                Ok((circle(x) + x * 0.1).normalize())
            }
            fn put_back(&mut self, x: DVec3) -> Option<DVec3> {
                Some(x.normalize())
            }
        }
        let along = DVec3::new(0.1, 1.0, 0.0).normalize();
        let half = trace(&mut Climbing, DVec3::X, along, &Control { first: 0.1, ..control(1e-3, 5.0) });
        assert!(half.pieces.iter().all(|piece| (piece.ends[1].length() - 1.0).abs() < 1e-15));
        assert_eq!(half.evaluations as usize, 5 * half.pieces.len() + 4 * half.rejected as usize);
    }
}
