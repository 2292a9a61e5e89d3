//! Curves whose formulas are known: how far a traced one is from its own.

use drypoint::scene::glam::{DMat3, DVec3};
use drypoint_reference::field::Outside;
use drypoint_reference::interactive_volume_illustration::directions::principal;
use drypoint_reference::interactive_volume_illustration::integrator::{Control, HalfCurve, LineField, trace};
use drypoint_reference::number::{Sym3, Vec3};

/// How far a traced half is from the formula.
type Distance = dyn Fn(&HalfCurve<()>) -> f64;

/// A field of lines with a curve of it, and the error of what was traced of that.
pub(super) struct Curve {
    pub(super) name: &'static str,
    field: Box<dyn Fn(DVec3) -> DVec3>,
    start: DVec3,
    length: f64,
    error: Box<Distance>,
}

struct Formula<'a>(&'a dyn Fn(DVec3) -> DVec3);

impl LineField for Formula<'_> {
    type Cause = ();

    fn at(&mut self, x: DVec3) -> Result<DVec3, ()> {
        (self.0)(x).try_normalize().ok_or(())
    }
}

/// What tracing a curve gave.
pub(super) struct Traced {
    pub(super) error: f64,
    pub(super) steps: usize,
}

impl Curve {
    /// Within a tolerance, with steps of any length.
    pub(super) fn within(&self, tolerance: f64) -> Traced {
        self.trace(tolerance, 1.0, f64::INFINITY)
    }

    /// With steps of one length, whatever they err by.
    pub(super) fn in_steps_of(&self, step: f64) -> Traced {
        self.trace(f64::INFINITY, step, step)
    }

    /// Of its arc.
    pub(super) fn length(&self) -> f64 {
        self.length
    }

    fn trace(&self, tolerance: f64, first: f64, max_step: f64) -> Traced {
        let control = Control {
            tolerance,
            first,
            min_step: 1e-9,
            max_step,
            length: self.length,
            cos_max_angle: -1.0,
            goal: None,
        };
        let mut lines = Formula(&self.field);
        let along = (self.field)(self.start).normalize();
        let half = trace(&mut lines, self.start, along, &control);
        Traced { error: (self.error)(&half), steps: half.segments.len() }
    }
}

fn end(half: &HalfCurve<()>) -> DVec3 {
    half.segments.last().map_or(DVec3::NAN, |segment| segment.ends[1])
}

/// The largest of a number over the ends of all steps.
fn largest(half: &HalfCurve<()>, off: impl Fn(DVec3) -> f64) -> f64 {
    half.segments.iter().map(|segment| off(segment.ends[1])).fold(0.0, f64::max)
}

/// The principal directions of a formula's surfaces, bright inside: the first of the largest κ.
fn curvature(jet: impl Fn(DVec3) -> (DVec3, DMat3), first: bool) -> impl Fn(DVec3) -> DVec3 {
    move |x| {
        let (g, h) = jet(x);
        let hessian =
            Sym3 { xx: h.x_axis.x, xy: h.x_axis.y, xz: h.x_axis.z, yy: h.y_axis.y, yz: h.y_axis.z, zz: h.z_axis.z };
        let c = principal(Vec3::from_glam(g), hessian, Outside::Low);
        if first { c.e1 } else { c.e2 }.to_glam()
    }
}

pub(super) fn curves() -> [Curve; 5] {
    [circle(), helix(), torus(), ellipsoid(), cyclide()]
}

fn circle() -> Curve {
    let at = |s: f64| DVec3::new((s / 20.0).cos(), (s / 20.0).sin(), 0.0) * 20.0;
    Curve {
        name: "circle, r = 20",
        field: Box::new(|x| DVec3::new(-x.y, x.x, 0.0)),
        start: DVec3::X * 20.0,
        length: 40.0,
        error: Box::new(move |half| end(half).distance(at(40.0))),
    }
}

fn helix() -> Curve {
    let n = 109f64.sqrt();
    let want = DVec3::new(10.0 * (40.0 / n).cos(), 10.0 * (40.0 / n).sin(), 120.0 / n);
    Curve {
        name: "helix, r = 10, pitch 6π",
        field: Box::new(|x| DVec3::new(-x.y, x.x, 3.0)),
        start: DVec3::X * 10.0,
        length: 40.0,
        error: Box::new(move |half| end(half).distance(want)),
    }
}

/// A meridian, once round.
fn torus() -> Curve {
    let (ring, tube) = (12.0, 8.0);
    let jet = move |x: DVec3| {
        // r² − (√(x² + y²) − R)² − z².
        let rho = x.x.hypot(x.y);
        let d = DVec3::new(x.x, x.y, 0.0) / rho;
        let across = DMat3::from_cols(d * d.x, d * d.y, DVec3::ZERO);
        let flat = DMat3::from_diagonal(DVec3::new(1.0, 1.0, 0.0));
        let gradient = -2.0 * ((rho - ring) * d + DVec3::new(0.0, 0.0, x.z));
        let z = DMat3::from_diagonal(DVec3::Z);
        (gradient, (across + (flat - across) * ((rho - ring) / rho) + z) * -2.0)
    };
    let start = DVec3::new(ring + tube * 0.6, 0.0, tube * 0.8);
    let closed = move |half: &HalfCurve<()>| end(half).distance(start);
    Curve {
        name: "torus, R = 12, r = 8: a meridian",
        field: Box::new(curvature(jet, true)),
        start,
        length: std::f64::consts::TAU * tube,
        error: Box::new(closed),
    }
}

/// How far a line of curvature comes off the confocal surface that it begins on.
fn ellipsoid() -> Curve {
    let w = DVec3::new(1.0 / 900.0, 1.0 / 400.0, 1.0 / 196.0);
    let start = DVec3::new(0.48, 0.6, 0.64) * DVec3::new(30.0, 20.0, 14.0);
    // The root of Σ x²/(a² + λ) = 1 between −400 and −196, and ‖∇λ‖.
    let confocal = |p: DVec3| {
        let (poles, x) = ([196.0, 400.0, 900.0], [p.z * p.z, p.y * p.y, p.x * p.x]);
        let sum = |l: f64, power: i32| (0..3).map(|i| x[i] / (poles[i] + l).powi(power)).sum::<f64>();
        let (mut lo, mut hi) = (-400.0, -196.0);
        for _ in 0..100 {
            let middle = 0.5 * (lo + hi);
            if sum(middle, 1) > 1.0 { lo = middle } else { hi = middle }
        }
        [lo, 2.0 / sum(lo, 2).sqrt()]
    };
    let [kept, _] = confocal(start);
    let off = move |x: DVec3| {
        let [at, speed] = confocal(x);
        (at - kept).abs() / speed
    };
    Curve {
        name: "ellipsoid 30 : 20 : 14",
        field: Box::new(curvature(move |x| (-2.0 * x * w, DMat3::from_diagonal(-2.0 * w)), false)),
        start,
        length: 40.0,
        error: Box::new(move |half| largest(half, off)),
    }
}

/// (x² + y² + z² + b² − d²)² = 4(ax − cd)² + 4b²y², b² = a² − c²: how far a line of curvature comes off its circle.
fn cyclide() -> Curve {
    let (a, c, d) = (14.0f64, 4.0, 8.0);
    let b2 = a * a - c * c;
    let jet = move |p: DVec3| {
        let s = p.length_squared() + b2 - d * d;
        let t = a * p.x - c * d;
        let gradient = -(4.0 * s * p - DVec3::new(8.0 * a * t, 8.0 * b2 * p.y, 0.0));
        let outer = DMat3::from_cols(p * p.x, p * p.y, p * p.z);
        let bend = DMat3::from_diagonal(DVec3::new(8.0 * a * a, 8.0 * b2, 0.0));
        (gradient, (outer * 8.0 + DMat3::IDENTITY * (4.0 * s) - bend) * -1.0)
    };
    // Lines of curvature are the parameter lines; this one has v fixed or u, whichever the direction is along.
    let place = move |u: f64, v: f64| {
        let below = a - c * u.cos() * v.cos();
        let x = d * (c - a * u.cos() * v.cos()) + b2 * u.cos();
        let (y, z) = (b2.sqrt() * u.sin() * (a - d * v.cos()), b2.sqrt() * v.sin() * (c * u.cos() - d));
        DVec3::new(x, y, z) / below
    };
    let (u, v) = (1.4, 1.9);
    let start = place(u, v);
    let field = curvature(jet, true);
    let e = field(start);
    let along = [place(u + 1e-4, v) - start, place(u, v + 1e-4) - start].map(|way| way.normalize().dot(e).abs());
    let of_u = along[0] > along[1];
    let [p, q, r] = [0.0, 2.0, 4.0].map(|t| if of_u { place(u + t, v) } else { place(u, v + t) });
    let n = (q - p).cross(r - p);
    let to = n.cross(q - p) * (r - p).length_squared() + (r - p).cross(n) * (q - p).length_squared();
    let (middle, n) = (p + to / (2.0 * n.length_squared()), n.normalize());
    let radius = middle.distance(p);
    let off = move |x: DVec3| (x - middle).dot(n).hypot((x - middle).length() - radius);
    Curve {
        name: "Dupin cyclide, a = 14, c = 4, d = 8",
        field: Box::new(field),
        start,
        length: 20.0,
        error: Box::new(move |half| largest(half, off)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The formulas are those of the curves: within twice the tolerance for each radius of arc, and of fourth order in the
    /// limit: slopes that come nearer to 4 as steps get smaller, and the last within a tenth of it.
    #[test]
    fn traced_curves_are_the_formulas() {
        for curve in curves() {
            for tolerance in [1e-3, 1e-6] {
                let Traced { error, steps } = curve.within(tolerance);
                assert!(error <= 8.0 * tolerance && steps > 4, "{}: {error:e}", curve.name);
            }
            let errors = [1.0, 0.5, 0.25, 0.125, 0.0625].map(|step| curve.in_steps_of(step).error);
            let off: Vec<f64> = errors.windows(2).map(|e| ((e[0] / e[1]).log2() - 4.0).abs()).collect();
            assert!(off.is_sorted_by(|a, b| b <= a) && off[3] <= 0.1, "{}: {off:?} off 4", curve.name);
        }
    }
}
