use super::*;
use drypoint_scene::glam::DQuat;
use std::f64::consts::{PI, TAU};

/// A field by a formula. Its sign jumps from place to place, which no tracer may notice.
struct Formula<F>(F);

impl<F: Fn(DVec3) -> DVec3> LineField for Formula<F> {
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
    Control { tolerance, first: 1.0, min_step: 1e-9, max_step: f64::INFINITY, length, cos_max_angle: -1.0, goal: None }
}

fn circle(x: DVec3) -> DVec3 {
    DVec3::new(-x.y, x.x, 0.0)
}

fn helix(x: DVec3) -> DVec3 {
    DVec3::new(-x.y, x.x, 3.0)
}

fn end<C>(half: &HalfCurve<C>) -> DVec3 {
    half.segments[half.segments.len() - 1].ends[1]
}

/// A field along x up to 7.3, then aslant. It tells or hides which of both it was asked for last.
struct Bent {
    beyond: bool,
    says: bool,
}

const ASLANT: DVec3 = DVec3::new(0.8, 0.6, 0.0);

impl LineField for Bent {
    type Cause = ();
    fn at(&mut self, x: DVec3) -> Result<DVec3, ()> {
        self.beyond = x.x > 7.3;
        Ok(if self.beyond { ASLANT } else { DVec3::X })
    }
    fn formula(&self) -> usize {
        usize::from(self.beyond && self.says)
    }
}

/// A step of h across a jump of size j errs by at most hj/3, since k₁ … k₄ weigh ⅙, ⅓, ⅓, ⅙. The step is accepted if
/// hj/6 is within the tolerance. If k₄ and k₅ agree beyond the jump, nothing else would show the error.
#[test]
fn steps_narrow_down_to_where_the_formula_changes() {
    let end_of = |says: bool, tolerance: f64, first: f64| {
        let control = Control { first, max_step: 2.0, ..control(tolerance, 20.0) };
        let half = trace(&mut Bent { beyond: false, says }, DVec3::ZERO, DVec3::X, &control);
        assert_eq!((half.end, half.length), (EndCause::Length, 20.0));
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

/// The global error after an arc of 40, on a circle of radius 20 and a helix of radius 10, is at most twice the
/// tolerance. This holds from 10⁻¹ to 10⁻¹⁰. The error falls with the fourth power of the number of steps: slope −3.8
/// or steeper.
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
            assert_eq!((half.end, half.length), (EndCause::Length, 40.0));
            assert_eq!(half.evaluations as usize, 4 * half.segments.len() + 4 * half.rejected as usize);
            measured.push(((half.segments.len() as f64).ln(), error.ln()));
        }
    }
    for measured in measured {
        let ((n0, e0), (n1, e1)) = (measured[4], measured[9]);
        assert!((e1 - e0) / (n1 - n0) <= -3.8, "{}", (e1 - e0) / (n1 - n0));
    }
}

/// The cubic leaves the circle between the ends by h⁴/(384 r³), and as much again for the error of its ends.
#[test]
fn between_the_steps_it_is_as_exact() {
    let half = trace(&mut Formula(circle), DVec3::X * 20.0, DVec3::Y, &control(1e-6, 40.0));
    for segment in &half.segments {
        let h = segment.tangents[0].length();
        for i in 0..=10 {
            let off = (segment.point(f64::from(i) / 10.0).length() - 20.0).abs();
            assert!(off <= h.powi(4) / (384.0 * 8000.0) * 1.1 + 1e-6, "{off:e} at {h}");
        }
    }
}

/// The other half of the curve is its mirror image: a helix turned by 180° about x is itself.
#[test]
fn both_ways_are_the_same() {
    let along = DVec3::new(0.0, 10.0, 3.0) / 109f64.sqrt();
    let [to, fro] = [along, -along].map(|k| trace(&mut Formula(helix), DVec3::X * 10.0, k, &control(1e-4, 40.0)));
    assert_eq!(to.segments.len(), fro.segments.len());
    for (a, b) in to.segments.iter().zip(&fro.segments) {
        assert_eq!(a.ends[1], b.ends[1] * DVec3::new(1.0, -1.0, -1.0));
    }
}

/// A circle closes at its beginning. A spiral that misses its beginning by more than the allowed distance does not.
#[test]
fn a_ring_closes_and_a_spiral_does_not() {
    let goal = |along| Some(Goal { at: DVec3::X * 20.0, along, within: 0.25, after: 1.0 });
    let closing = Control { goal: goal(DVec3::Y), ..control(1e-4, 400.0) };
    let ring = trace(&mut Formula(circle), DVec3::X * 20.0, DVec3::Y, &closing);
    assert_eq!((ring.end, end(&ring)), (EndCause::Closed, DVec3::X * 20.0));
    // Sixteen steps of 10⁻⁴ at the most, and half as much in the length of the last.
    assert!((ring.length - 40.0 * PI).abs() < 2e-3, "{}", ring.length);
    let spiral = |x: DVec3| circle(x) + x * (0.5 / (20.0 * TAU));
    let along = spiral(DVec3::X * 20.0).normalize();
    let closing = Control { goal: goal(along), ..closing };
    assert_eq!(trace(&mut Formula(spiral), DVec3::X * 20.0, along, &closing).end, EndCause::Length);
}

/// A goal just ahead is reached at once if the curve need not come back. A goal just behind is not.
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
            assert_eq!((half.end, end(&half)), (EndCause::Closed, at));
            assert!((half.length - length).abs() < 2e-3, "{ahead} {sign}: {}", half.length);
        }
    }
}

#[test]
fn it_ends_at_the_largest_angle() {
    let control = Control { cos_max_angle: (PI / 4.0).cos(), ..control(1e-6, 400.0) };
    let half = trace(&mut Formula(circle), DVec3::X * 20.0, DVec3::Y, &control);
    assert_eq!(half.end, EndCause::Angle);
    // The cubic's direction errs by h³/(96·√3·r³) or so, some 10⁻⁵ here.
    assert!((half.length - 5.0 * PI).abs() < 1e-3, "{}", half.length);
}

/// The angle is tested between the steps, too. On a circle, steps of 32° pass a window of 20°.
#[test]
fn no_step_jumps_over_the_largest_angle() {
    for degrees in [150.0f64, 170.0, 179.0, 179.9] {
        for radius in [2.0, 3.7, 20.0] {
            let angle = degrees.to_radians();
            let goal = Some(Goal { at: DVec3::X * radius, along: DVec3::Y, within: 0.15, after: 0.6 });
            let control = Control { cos_max_angle: angle.cos(), max_step: 2.0, goal, ..control(1e-2, 400.0) };
            let half = trace(&mut Formula(circle), DVec3::X * radius, DVec3::Y, &control);
            assert_eq!(half.end, EndCause::Angle, "{degrees} {radius}");
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
        assert_eq!(half.end, EndCause::Length);
        for segment in &half.segments {
            let turn = segment.tangents[0].angle_between(segment.tangents[1]).to_degrees();
            assert!(turn <= 60.0 + 1e-9, "{first}: {turn}");
        }
    }
}

/// The curve ends where the field ends, the smallest step before it.
#[test]
fn it_goes_up_to_the_border_of_the_field() {
    let inside = |x: DVec3| if x.x < 7.3 { DVec3::X } else { DVec3::ZERO };
    let control = Control { min_step: 1e-3, max_step: 2.0, ..control(1e-3, 40.0) };
    let half = trace(&mut Formula(inside), DVec3::ZERO, DVec3::X, &control);
    assert_eq!(half.end, EndCause::Field(()));
    assert!(end(&half).x < 7.3 && end(&half).x > 7.3 - 2e-3, "{}", end(&half));
    assert!(half.segments.iter().all(|segment| segment.tangents[0].x <= 2.0));
}

/// A kink of less than 60° is passed in small steps; a larger one ends the curve.
#[test]
fn a_kink_ends_it() {
    let kink = |degrees: f64| {
        let (s, c) = degrees.to_radians().sin_cos();
        let field = move |x: DVec3| if x.x < 5.0 { DVec3::X } else { DVec3::new(c, s, 0.0) };
        let control = Control { min_step: 1e-3, ..control(1e-2, 20.0) };
        trace(&mut Formula(field), DVec3::ZERO, DVec3::X, &control)
    };
    assert_eq!(kink(40.0).end, EndCause::Length);
    let turned = kink(70.0);
    assert_eq!(turned.end, EndCause::Turns);
    assert!((end(&turned).x - 5.0).abs() < 2e-3);
}

/// A curve on the unit sphere stays there although its field leads off it. Each step costs one more evaluation.
#[test]
fn a_step_that_comes_off_is_put_back() {
    struct Climbing;
    impl LineField for Climbing {
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
    assert!(half.segments.iter().all(|segment| (segment.ends[1].length() - 1.0).abs() < 1e-15));
    assert_eq!(half.evaluations as usize, 5 * half.segments.len() + 4 * half.rejected as usize);
}
