//! Lines of curvature with formulas of their own, on formulas.

use super::super::strokes::CurvatureLines;
use super::super::strokes::integrator::{Control, EndCause, HalfCurve, trace};
use super::super::{CurvatureFamily, DirectionEstimator, HatchCounts, HatchParams, NoDirection, StrokeGrower};
use super::*;
use drypoint_scene::philox::uniform;
use std::f64::consts::{PI, TAU};

fn hatching(grid: &Grid, family: CurvatureFamily) -> HatchParams {
    HatchParams { family, rule: DirectionEstimator::Raw, max_angle: 180.0, ..HatchParams::new(grid) }
}

/// One half of a curve, as strokes trace it.
fn half(strokes: &StrokeGrower<'_, '_>, seed: &Seed, control: Control) -> HalfCurve<NoDirection> {
    let mut counts = HatchCounts::default();
    let along = if seed.family == CurvatureFamily::Max { seed.curvature.e1 } else { seed.curvature.e2 };
    let mut lines = CurvatureLines::new(strokes, seed.family, seed.target, &mut counts);
    trace(&mut lines, seed.world, along.to_glam(), &control)
}

fn control(tolerance: f64, length: f64) -> Control {
    Control { tolerance, first: 1.0, min_step: 1e-9, max_step: 1e9, length, cos_max_angle: -1.0, goal: None }
}

/// A torus with R = 1.5 r: a meridian is a circle of radius r. It crosses the two circles on which the mean curvature
/// is 0. Beyond them the other curvature has the larger magnitude, but the meridian has no kink. It is back at its
/// seed after 2πr.
#[test]
fn a_meridian_of_a_torus_comes_back() {
    let (ring, tube) = (12.0, 8.0);
    let ground = exact("torus", cube(48), &[("R", ring), ("r", tube)]);
    let centre = ground.grid.centre();
    let strokes = StrokeGrower::on(&ground, Some(0.0), hatching(&ground.grid, CurvatureFamily::Max));
    for i in 0..12 {
        let (phi, theta) = (0.3 + f64::from(i), 0.2 + 0.7 * f64::from(i));
        let (ex, ez) = (DVec3::new(phi.cos(), phi.sin(), 0.0), DVec3::Z);
        let world = centre + ex * (ring + tube * theta.cos()) + ez * (tube * theta.sin());
        let seed = seed_at(&strokes, world);
        for power in 1..=10 {
            let tolerance = 10f64.powi(-power);
            let half = half(&strokes, &seed, control(tolerance, TAU * tube));
            assert_eq!(half.end, EndCause::Length);
            let last = half.segments[half.segments.len() - 1].ends[1];
            assert!(last.distance(world) <= 5.0 * tolerance, "{:e} at {tolerance:e}", last.distance(world));
            for segment in &half.segments {
                let turn = segment.tangents[0].angle_between(segment.tangents[1]);
                let h = segment.tangents[0].length();
                assert!(turn <= 1.1 * h / tube, "{turn} in {h}");
            }
        }
        // The stroke is closed, whichever half comes round.
        for length in [1.2, 2.5] {
            let how = HatchParams { length: length * TAU * tube, ..hatching(&ground.grid, CurvatureFamily::Max) };
            let strokes = StrokeGrower::on(&ground, Some(1.0), how);
            let mut counts = HatchCounts::default();
            let stroke = strokes.grow(&seed, &mut counts).unwrap();
            assert!(stroke.closed && counts.stops.closed == 1 && counts.cut == 0);
            assert!(stroke.vertices.iter().all(|v| ((v.world - centre).dot(ex.cross(ez))).abs() < 0.02));
            // Chords of a circle leave it by at most 0.1. The overlap c adds at most one vertex.
            let fewest = (PI / f64::acos(1.0 - 0.1 / tube)).ceil();
            let n = stroke.vertices.len() as f64;
            assert!(n >= fewest && n <= 1.3 * fewest + 1.0, "{n} {fewest}");
        }
    }
}

/// The rulings of an oblique cylinder are straight and lie on it.
#[test]
fn a_ruling_of_a_cylinder_is_straight() {
    let axis = DVec3::new(0.3, -0.5, 0.8).normalize();
    let ground = exact("cylinder", cube(64), &[("R", 14.0), ("ax", axis.x), ("ay", axis.y), ("az", axis.z)]);
    let centre = ground.grid.centre();
    let strokes = StrokeGrower::on(&ground, Some(0.0), hatching(&ground.grid, CurvatureFamily::Min));
    let out = axis.any_orthonormal_vector();
    let seed = seed_at(&strokes, centre + out * 14.0);
    let half = half(&strokes, &seed, Control { max_step: 1.0, ..control(1e-8, 20.0) });
    let steps = half.segments.len() as f64;
    for segment in &half.segments {
        let away = segment.ends[1] - seed.world;
        let off = (away - axis * away.dot(axis)).length();
        // A direction is off by a few u, a place by u of itself at each step.
        assert!(off <= 16.0 * f64::EPSILON / 2.0 * 64.0 * steps, "{off:e}");
    }
    assert!(seed.curvature.k2.abs() < 1e-14 && half.end == EndCause::Length);
}

/// The ellipsoid 1 − x²/a² − y²/b² − z²/c² with the half axes 30, 20, 14.
fn ellipsoid() -> Formula<impl Fn(DVec3) -> (f64, DVec3, DMat3) + Sync> {
    let grid = cube(64);
    let (c, w) = (grid.centre(), DVec3::new(1.0 / 900.0, 1.0 / 400.0, 1.0 / 196.0));
    let at = move |x: DVec3| {
        let p = x - c;
        (1.0 - (p * p).dot(w), -2.0 * p * w, DMat3::from_diagonal(-2.0 * w))
    };
    Formula { grid, range: [-1.0, 1.0], at }
}

/// The confocal coordinates of a place, larger first: the roots of Σ x²/(a² + λ) = 1 in the two gaps between the
/// poles. The second number is the rate of change in space, ‖∇λ‖ = 2/√(Σ x²/(a² + λ)²).
fn confocal(p: DVec3) -> [[f64; 2]; 2] {
    let (poles, x) = ([196.0, 400.0, 900.0], [p.z * p.z, p.y * p.y, p.x * p.x]);
    let sum = |l: f64, power: i32| (0..3).map(|i| x[i] / (poles[i] + l).powi(power)).sum::<f64>();
    [0, 1].map(|gap: usize| {
        // The function falls from +∞ at the left pole to −∞ at the right one.
        let (mut lo, mut hi) = (-poles[gap + 1], -poles[gap]);
        for _ in 0..100 {
            let middle = 0.5 * (lo + hi);
            if sum(middle, 1) > 1.0 { lo = middle } else { hi = middle }
        }
        [lo, 2.0 / sum(lo, 2).sqrt()]
    })
}

/// The allowed error of a line after an arc, in tolerances. `radius` is its least radius of curvature. A circle and a
/// helix may err by two tolerances after an arc of two radii ([HATCH-8]), so there is one tolerance per radius.
fn tolerances(arc: f64, radius: f64) -> f64 {
    1.0 + arc / radius
}

/// One of the confocal coordinates is constant along a line of curvature of a triaxial ellipsoid. Its deviation is at
/// most the line's error times the largest rate of change. Normal curvatures are at most 30/14².
#[test]
fn a_confocal_coordinate_is_constant_on_an_ellipsoid() {
    let ground = ellipsoid();
    let centre = ground.grid.centre();
    let mut worst: [f64; 10] = [0.0; 10];
    for i in 0..30u32 {
        let r = |a: u32| 2.0 * uniform(2, [i, a, 0], 0) - 1.0;
        let d = DVec3::new(r(0), r(1), r(2)).normalize();
        let world = centre + d * DVec3::new(30.0, 20.0, 14.0);
        for (family, kept) in [(CurvatureFamily::Max, 1), (CurvatureFamily::Min, 0)] {
            let strokes = StrokeGrower::on(&ground, Some(0.0), hatching(&ground.grid, family));
            let seed = seed_at(&strokes, world);
            let [start, speed] = confocal(world - centre)[kept];
            for (power, worst) in (1..).zip(&mut worst) {
                let tolerance = 10f64.powi(-power);
                let half = half(&strokes, &seed, control(tolerance, 40.0));
                assert_eq!(half.end, EndCause::Length);
                let mut fastest = speed;
                for segment in &half.segments {
                    let [at, speed] = confocal(segment.ends[1] - centre)[kept];
                    fastest = fastest.max(speed);
                    *worst = worst.max((at - start).abs() / (fastest * tolerance));
                }
            }
        }
    }
    assert!(worst.iter().all(|worst| *worst <= tolerances(40.0, 196.0 / 30.0)), "{worst:?}");
}

/// A Dupin cyclide: (x² + y² + z² + b² − d²)² = 4(ax − cd)² + 4b²y², b² = a² − c². All its lines of curvature are circles.
#[test]
fn lines_of_curvature_of_a_cyclide_are_circles() {
    let grid = cube(64);
    let (a, c, d) = (14.0f64, 4.0, 8.0);
    let b2 = a * a - c * c;
    let centre = grid.centre();
    let at = move |x: DVec3| {
        let p = x - centre;
        let s = p.length_squared() + b2 - d * d;
        let t = a * p.x - c * d;
        let value = -(s * s - 4.0 * t * t - 4.0 * b2 * p.y * p.y);
        let gradient = -(4.0 * s * p - DVec3::new(8.0 * a * t, 8.0 * b2 * p.y, 0.0));
        let outer = DMat3::from_cols(p * p.x, p * p.y, p * p.z);
        let hessian =
            outer * 8.0 + DMat3::IDENTITY * (4.0 * s) - DMat3::from_diagonal(DVec3::new(8.0 * a * a, 8.0 * b2, 0.0));
        (value, gradient, hessian * -1.0)
    };
    let ground = Formula { grid, range: [-1e5, 1e5], at };
    let mut worst: [f64; 10] = [0.0; 10];
    for i in 0..12 {
        let (u, v) = (0.4 + f64::from(i), 1.1 + 0.8 * f64::from(i));
        // A parametrization (Berger, Geometry II) whose parameter lines are the lines of curvature.
        let place = |u: f64, v: f64| {
            let below = a - c * u.cos() * v.cos();
            let x = d * (c - a * u.cos() * v.cos()) + b2 * u.cos();
            let (y, z) = (b2.sqrt() * u.sin() * (a - d * v.cos()), b2.sqrt() * v.sin() * (c * u.cos() - d));
            centre + DVec3::new(x, y, z) / below
        };
        let world = place(u, v);
        let circles = [[0.0, 2.0, 4.0].map(|t| place(u + t, v)), [0.0, 2.0, 4.0].map(|t| place(u, v + t))];
        for family in [CurvatureFamily::Max, CurvatureFamily::Min] {
            let strokes = StrokeGrower::on(&ground, Some(0.0), hatching(&ground.grid, family));
            let seed = seed_at(&strokes, world);
            // The parameter line in the stroke's initial direction.
            let e = if family == CurvatureFamily::Max { seed.curvature.e1 } else { seed.curvature.e2 }.to_glam();
            let along = [place(u + 1e-3, v) - world, place(u, v + 1e-3) - world].map(|d| d.normalize().dot(e).abs());
            let [p, q, r] = circles[usize::from(along[1] > along[0])];
            let n = (q - p).cross(r - p);
            let to = n.cross(q - p) * (r - p).length_squared() + (r - p).cross(n) * (q - p).length_squared();
            let middle = p + to / (2.0 * n.length_squared());
            let residual = |x: DVec3| {
                let across = (x - middle).dot(n.normalize());
                across.hypot((x - middle).length() - middle.distance(p))
            };
            for (power, worst) in (1..).zip(&mut worst) {
                let tolerance = 10f64.powi(-power);
                let half = half(&strokes, &seed, control(tolerance, 20.0));
                assert_eq!(half.end, EndCause::Length);
                let off = half.segments.iter().map(|segment| residual(segment.ends[1])).fold(0.0, f64::max);
                *worst = worst.max(off / (tolerances(20.0, middle.distance(p)) * tolerance));
            }
        }
    }
    assert!(worst.iter().all(|worst| *worst <= 1.0), "{worst:?}");
}

/// Lines turn at an umbilic of the ellipsoid. Strokes that arrive there end within two of their smallest steps and
/// report it.
#[test]
fn strokes_end_at_umbilics() {
    let ground = ellipsoid();
    let centre = ground.grid.centre();
    // x² = a²(a² − b²)/(a² − c²), z² = c²(b² − c²)/(a² − c²), y = 0.
    let umbilic = DVec3::new((900.0f64 * 500.0 / 704.0).sqrt(), 0.0, (196.0f64 * 204.0 / 704.0).sqrt());
    let strokes = StrokeGrower::on(&ground, Some(0.0), hatching(&ground.grid, CurvatureFamily::Larger));
    let seed = strokes.seed([0; 3], centre + umbilic, 0.0, &mut HatchCounts::default());
    // Rounding of the place leaves a difference of curvatures; exactly at the umbilic there is none.
    if let Ok(seed) = seed {
        assert!((seed.curvature.k1 - seed.curvature.k2).abs() < 1e-7);
    }
    // The line y = 0 through the umbilic, from both sides.
    for (step, family) in [
        (-0.3f64, CurvatureFamily::Max),
        (-0.3, CurvatureFamily::Min),
        (0.3, CurvatureFamily::Max),
        (0.3, CurvatureFamily::Min),
    ] {
        let angle = (umbilic.z / 14.0).atan2(umbilic.x / 30.0) + step;
        let world = centre + DVec3::new(30.0 * angle.cos(), 0.0, 14.0 * angle.sin());
        let strokes =
            StrokeGrower::on(&ground, Some(0.5), HatchParams { length: 200.0, ..hatching(&ground.grid, family) });
        let mut counts = HatchCounts::default();
        let stroke = strokes.grow(&seed_at(&strokes, world), &mut counts).unwrap();
        let ends = [stroke.vertices[0].world, stroke.vertices[stroke.vertices.len() - 1].world].map(|x| {
            let p = (x - centre).abs();
            p.distance(umbilic)
        });
        // One family crosses this line and comes round; the other runs along it.
        if (step < 0.0) == (family == CurvatureFamily::Min) {
            assert!(stroke.closed && counts.stops.closed == 1);
        } else {
            assert!(
                counts.stops.turns == 2 && ends.iter().all(|end| *end <= 2.0 * 0.01),
                "{:?} {ends:?}",
                counts.stops
            );
        }
    }
}

/// The apex of a cone has no gradient.
#[test]
fn no_direction_at_an_apex() {
    let grid = cube(32);
    let centre = DVec3::splat(16.0);
    let w = DVec3::new(1.0, 1.0, -1.0);
    let at = move |x: DVec3| {
        let p = x - centre;
        ((p * p).dot(w), 2.0 * p * w, DMat3::from_diagonal(2.0 * w))
    };
    let ground = Formula { grid, range: [-100.0, 100.0], at };
    let strokes = StrokeGrower::on(&ground, Some(0.0), hatching(&ground.grid, CurvatureFamily::Max));
    let mut counts = HatchCounts::default();
    assert_eq!(strokes.seed([0; 3], centre, 0.0, &mut counts), Err(NoDirection::Gradient));
}
