//! Creases ([HATCH-22]): crest lines of an iso-surface. On them the curvature κ of larger magnitude is extremal along
//! its own principal direction e, and the normal turns fast.
//!
//! There h = e·∇κ is 0 (Ohtake, Belyaev and Seidel, *Ridge-valley lines on meshes via implicit surface fitting*, ACM
//! Transactions on Graphics 23, 2004). κ, e and h are those of the smoothed field at σ = 1 voxel, the finest scale of
//! [HATCH-3]. At a sharp right angle between voxels, the normal of this field turns by 51° over two voxels. At σ = 2 it
//! would turn by 30°, so coarser scales find no creases of 30° that the finest scale does not.
//!
//! e has no sign of its own. In a tetrahedron the signs of its corners are aligned with each other. Near a place, signs
//! are aligned with the direction at the place. The sign of h follows e, and its zeros do not depend on the choice.

use super::super::directions::{DirectionEstimator, PrincipalDirections, Thresholds, principal};
use super::corners::with_corners;
use super::search::{CurveSearch, OutlineStrokes, position};
use super::second_function::SecondFunction;
use super::section::cut_all;
use crate::field::Outside;
use crate::field::curvature::Curvature;
use crate::field::normal::outward;
use crate::field::smoothed::Smoothed;
use crate::number::{Sym3, Vec3};
use crate::surface::IsoSurface;
use drypoint_scene::glam::DVec3;

/// Distance of the two places of a difference from their middle, in voxels. It is the scale of the smoothed field.
const APART: f64 = 1.0;

/// The share of |κ| by which it is smaller, on average, one voxel before and after. A hole of three voxels turns as
/// fast all around as an edge does, and the noise of a scan makes maxima of a few per cent there. On an edge that is
/// rounded by three voxels |κ| falls by 8 %.
const FALL: f64 = 0.05;

/// The share of the least curvature at which a search for a crease begins.
const NEARLY: f64 = 0.7;

/// The share of the least curvature that all corners of a tetrahedron with a crease have. At one voxel from a right
/// angle between two planes, κ is half of its value on the edge.
const BESIDE: f64 = 0.25;

/// Cosine of the largest angle between the directions of a tetrahedron. Directions turn with the surface, by up to 56°
/// over the diagonal of a cell at a right angle. They turn by 90° where the other principal curvature becomes the
/// larger one.
const ALIGNED: f64 = 0.4;

/// Finds the creases of a surface at which the normal turns by `angle` or more over two voxels, in degrees. `noise` is
/// the standard deviation of the values.
pub fn creases(surface: &IsoSurface<'_, '_>, angle: f64, noise: f64) -> CreaseStrokes {
    let field = surface.field();
    let search = CurveSearch::new(surface);
    let rule = DirectionEstimator::Scaled(Thresholds { deviation: noise, ..Thresholds::default() });
    let directions = PrincipalDirections::new(field, rule);
    let Some(smoothed) = directions.finest() else { return CreaseStrokes::default() };
    let crests = Crests { search: &search, directions: &directions, smoothed, least: angle.to_radians() / 2.0 };
    let mut found = search.curves(field, &crests, &surface.bricks());
    // Edges of a larger radius are no creases.
    let reach = search.grid.voxel() / crests.least;
    found.strokes = cut_all(with_corners(surface, found.strokes, reach), surface.clip());
    found.inside = found.strokes.len();
    CreaseStrokes { found, bytes: directions.bytes() }
}

/// The creases of a surface, hidden parts included.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CreaseStrokes {
    /// The strokes, and the numbers of places from which they were made.
    pub found: OutlineStrokes,
    /// Bytes of the smoothed samples.
    pub bytes: u64,
}

/// h = e·∇|κ| at σ = 1 voxel.
struct Crests<'a, 'f, 'v> {
    search: &'a CurveSearch<'a>,
    directions: &'a PrincipalDirections<'f, 'v>,
    smoothed: &'a Smoothed<'f, 'v>,
    /// The least |κ|, times a voxel.
    least: f64,
}

/// A principal direction of a place, with its curvature.
#[derive(Clone, Copy)]
struct Crest {
    normal: DVec3,
    e: DVec3,
    kappa: f64,
}

/// h at a voxel. Its sign follows e.
#[derive(Clone, Copy)]
struct CrestCorner {
    e: DVec3,
    h: f64,
    is_convex: bool,
}

/// The principal direction of larger |κ|, and κ.
fn larger(c: &Curvature<f64>) -> (DVec3, f64) {
    let (e, kappa) = if c.k1.abs() >= c.k2.abs() { (c.e1, c.k1) } else { (c.e2, c.k2) };
    (e.to_glam(), kappa)
}

impl Crests<'_, '_, '_> {
    /// The outward normal of the smoothed field.
    fn normal(&self, gradient: Vec3<f64>) -> Option<DVec3> {
        outward(gradient, self.search.outside, self.search.no_normal_below).map(Vec3::to_glam)
    }

    /// The direction of larger |κ| from derivatives.
    fn crest(&self, (gradient, hessian): (Vec3<f64>, Sym3<f64>)) -> Option<Crest> {
        let normal = self.normal(gradient)?;
        let (e, kappa) = larger(&principal(gradient, hessian, self.search.outside));
        Some(Crest { normal, e, kappa })
    }

    fn derivatives(&self, at: DVec3) -> (Vec3<f64>, Sym3<f64>) {
        self.smoothed.derivatives(Vec3::from_glam(at))
    }

    /// The curvature at a place in index space along e, projected into the tangent plane.
    fn curvature_along(&self, at: DVec3, e: DVec3) -> Option<f64> {
        let [lo, hi] = self.search.grid.index_box();
        let (gradient, hessian) = self.derivatives(at.clamp(lo, hi));
        let normal = self.normal(gradient)?;
        let t = Vec3::from_glam((e - normal * normal.dot(e)).normalize_or_zero());
        let bends = hessian.form(t, t) / gradient.length();
        Some(if self.search.outside == Outside::Low { -bends } else { bends })
    }

    /// κ before and after a place, one voxel along e and back onto the surface's circle of curvature. Since e is kept,
    /// the derivative of κ along it is that of the eigenvalue.
    fn around(&self, at: DVec3, crest: &Crest) -> Option<[f64; 2]> {
        let grid = self.search.grid;
        let step = APART * grid.voxel();
        let down = crest.normal * (0.5 * crest.kappa * step * step);
        let beside = |s: f64| self.curvature_along(at + grid.inverse_axes() * (crest.e * (s * step) - down), crest.e);
        Some([beside(-1.0)?, beside(1.0)?])
    }

    /// h, times a voxel's square: the change of |κ| along e.
    fn extremality(&self, at: DVec3, crest: &Crest) -> Option<f64> {
        let [behind, before] = self.around(at, crest)?;
        let sign = if crest.kappa > 0.0 { 0.5 } else { -0.5 };
        Some(sign * (before - behind) * self.search.grid.voxel() / APART)
    }
}

impl SecondFunction for Crests<'_, '_, '_> {
    type Corner = Option<CrestCorner>;

    /// Returns none at places that are flat or have no normal.
    fn at_voxel(&self, voxel: [usize; 3]) -> Option<CrestCorner> {
        let crest = self.crest(self.smoothed.at_voxel(voxel, self.search.no_normal_below, None)?)?;
        let bends = crest.kappa.abs() * self.search.grid.voxel();
        let h = if bends >= BESIDE * self.least { self.extremality(position(voxel), &crest)? } else { return None };
        Some(CrestCorner { e: crest.e, h, is_convex: crest.kappa > 0.0 })
    }

    fn may_vanish(&self, corners: &[Option<CrestCorner>; 8]) -> bool {
        corners.iter().flatten().count() >= 4
    }

    fn values(&self, corners: [Option<CrestCorner>; 4]) -> Option<[f64; 4]> {
        let [Some(a), Some(b), Some(c), Some(d)] = corners else { return None };
        let mut all = [a, b, c, d];
        for corner in &mut all {
            if corner.e.dot(a.e) < 0.0 {
                (corner.e, corner.h) = (-corner.e, -corner.h);
            }
        }
        let agree = |p: &CrestCorner, q: &CrestCorner| p.is_convex == q.is_convex && p.e.dot(q.e) > ALIGNED;
        let aligned = (0..4).all(|i| (0..i).all(|j| agree(&all[i], &all[j])));
        aligned.then(|| all.map(|corner| corner.h))
    }

    fn near(&self, start: DVec3) -> Option<impl Fn(DVec3) -> f64> {
        let of = self.crest(self.derivatives(start))?;
        (of.kappa.abs() * self.search.grid.voxel() >= NEARLY * self.least).then_some(())?;
        Some(move |at: DVec3| {
            let (gradient, hessian) = self.derivatives(at);
            let Some(normal) = self.normal(gradient) else { return f64::NAN };
            let c = principal(gradient, hessian, self.search.outside);
            let along = |e: Vec3<f64>| e.to_glam().dot(of.e);
            let (e, kappa) = if along(c.e1).abs() >= along(c.e2).abs() { (c.e1, c.k1) } else { (c.e2, c.k2) };
            let e = e.to_glam() * if along(e) < 0.0 { -1.0 } else { 1.0 };
            self.extremality(at, &Crest { normal, e, kappa }).unwrap_or(f64::NAN)
        })
    }

    /// Whether κ is large enough, |κ| has a maximum there, and the finest scale is certain of the direction.
    fn holds(&self, at: DVec3) -> bool {
        let is_crest = || {
            let crest = self.crest(self.derivatives(at))?;
            let large = crest.kappa.abs();
            (large * self.search.grid.voxel() >= self.least).then_some(())?;
            let [behind, before] = self.around(at, &crest)?;
            let falls = 0.5 * (behind + before) * crest.kappa.signum() <= (1.0 - FALL) * large;
            Some(falls && self.directions.is_certain_at_finest(at))
        };
        is_crest().unwrap_or(false)
    }
}

#[cfg(test)]
mod tests;
