//! The specimen of the embedded scene: a radiolarian of our own making, with smooth edges at every scale.
//!
//! Five bodies, each painted over the ones before it by v ← v + σ(F/w) (level − v), σ the logistic function and F
//! the body's field. With lengths in units of s:
//!
//! | body | level of `high` | of 255 | shape |
//! |---|---|---|---|
//! | veil | ⅕ | 51 | a ball of radius 0.33, drawn out like a tent over the spines, to 0.46 |
//! | knot | ⅖ | 102 | a trefoil tube of radius 0.034, wound about the z axis at radius 0.13 |
//! | marrow | 1 | 255 | a thread of radius 0.012 inside the knot |
//! | core | 1 | 255 | a ball of radius 0.04 |
//! | skeleton | 1 | 255 | a lattice shell of radius 0.265 with 42 pores; 20 spines from its joints to 0.44 |
//!
//! Bodies meant to be seen through have low levels, close together, so nothing opaque lies on the way up to another
//! value. An edge passes every value between its two sides. Solid bodies therefore lie under the veil, to the tips of
//! their spines. None of their edges then passes the veil's own values, 12…40, which would draw a second veil around
//! it. Such an edge does pass the knot's values, 94…110 about its level, but within a fraction of a voxel, where it
//! gathers little opacity. Everything from 165 on is solid.
//!
//! Labels: 1 veil, 2 knot, 3 marrow, 4 core, 5 skeleton.

use super::jet::{Scalar, length_squared};
use super::params::{About, Allowed, HIGH, Param, Preset};
use super::placed::Formula;
use glam::DVec3;

pub(super) const SPECIMEN: About = About {
    name: "specimen",
    doc: "a radiolarian: veil at ⅕ of high, knot at ⅖, marrow, core and lattice shell with spines at 1",
    params: &[
        Param {
            name: "s",
            doc: "side of the cube that holds it",
            default: Preset::Side(1.0),
            allowed: Allowed::Positive,
        },
        Param { name: "w", doc: "edge width in world units", default: Preset::Voxels(0.5), allowed: Allowed::Positive },
        HIGH,
    ],
    build: |args| {
        let [s, w, high] = args.values();
        Ok(args.field(Specimen::new(s, w / s, high)))
    },
};

/// Radius of the veil between the spines, and the distance by which the spines draw the veil outwards.
const VEIL: [f64; 2] = [0.33, 0.13];
/// Ring, winding radius and tube of the knot.
const KNOT: [f64; 3] = [0.13, 0.056, 0.034];
/// Radius of the thread in the knot.
const MARROW: f64 = 0.012;
const CORE: f64 = 0.04;
/// Radius of the lattice's shell and half its thickness.
const LATTICE: [f64; 2] = [0.265, 0.016];
/// sin² of half the angle from a pore's centre to its rim.
const PORE: f64 = 0.0138;
/// Radius of a spine at its start, and distance of its end from the centre.
const SPINE: [f64; 2] = [0.0145, 0.44];
/// Radius of the fillets where bodies of the skeleton meet.
const FILLET: f64 = 0.006;
/// The length below which a distance to a line or a shell is rounded off, which keeps it smooth.
const ROUND: f64 = 0.003;

struct Specimen {
    s: f64,
    /// Edge width in units of s.
    w: f64,
    high: f64,
    pores: Vec<DVec3>,
    spines: Vec<DVec3>,
}

impl Specimen {
    fn new(s: f64, w: f64, high: f64) -> Self {
        // The vertices of an icosahedron: neighbours see each other under a positive cosine (1/√5).
        let golden = 0.5 * (1.0 + 5f64.sqrt());
        let mut vertices = Vec::new();
        for (a, b) in [(1.0, golden), (1.0, -golden), (-1.0, golden), (-1.0, -golden)] {
            vertices.extend([DVec3::new(0.0, a, b), DVec3::new(b, 0.0, a), DVec3::new(a, b, 0.0)]);
        }
        let (mut pores, mut spines) = (vertices.clone(), Vec::new());
        for (i, a) in vertices.iter().enumerate() {
            for (j, b) in vertices.iter().enumerate().skip(i + 1).filter(|(_, b)| a.dot(**b) > 0.0) {
                pores.push(*a + *b);
                let third = vertices.iter().skip(j + 1).filter(|c| a.dot(**c) > 0.0 && b.dot(**c) > 0.0);
                spines.extend(third.map(|c| *a + *b + *c));
            }
        }
        let unit = |v: Vec<DVec3>| v.into_iter().map(DVec3::normalize).collect();
        Self { s, w, high, pores: unit(pores), spines: unit(spines) }
    }

    /// Veil, knot, marrow, core, skeleton: a field each that is positive inside and about as steep as a distance.
    fn bodies<S: Scalar>(&self, p: [S; 3]) -> [S; 5] {
        let p = p.map(|x| x * (1.0 / self.s));
        let r = length_squared(p);
        // The field's one singular point is the centre, where nothing but the core matters.
        let r = (r + 1e-12).sqrt();
        let u = p.map(|x| x / r);
        let off_knot = from_knot(p);
        let tube = |radius: f64| S::constant(radius) - rounded_root(off_knot);
        [self.veil(u, r), tube(KNOT[2]), tube(MARROW), S::constant(CORE) - r, self.skeleton(u, r)]
    }

    fn veil<S: Scalar>(&self, u: [S; 3], r: S) -> S {
        let [radius, tent] = VEIL;
        S::constant(radius) + crowding::<S, 64>(&self.spines, u) * tent - r
    }

    fn skeleton<S: Scalar>(&self, u: [S; 3], r: S) -> S {
        let [radius, half] = LATTICE;
        let shell = S::constant(half) - rounded_root((r - radius).squared());
        // sin²(½ angle) to the nearest pore, smoothly: its slope is about sin(rim)/2 per radian.
        let rim = (PORE * (1.0 - PORE)).sqrt();
        let strut = (crowding::<S, 256>(&self.pores, u).ln() * (-1.0 / 256.0) - PORE) * (radius / rim);
        let lattice = -blend(-shell, -strut, FILLET);
        // Spines: the nearest one alone counts; far from all of them the field is far below 0.
        let cosine = self.spines.iter().map(|s| dot(u, *s)).reduce(S::max).unwrap_or(S::constant(-1.0));
        let across = r.squared() * (S::constant(1.0) - cosine.squared());
        let [thick, end] = SPINE;
        let rod = (S::constant(1.0) - (r * (1.0 / end)).powi(8)) * thick - rounded_root(across);
        let spine = -blend(-rod, -(r - radius), FILLET);
        blend(lattice, spine, FILLET)
    }
}

/// √x, rounded off near 0.
fn rounded_root<S: Scalar>(x: S) -> S {
    (x + ROUND * ROUND).sqrt() - ROUND
}

/// a·b with constant b.
fn dot<S: Scalar>(a: [S; 3], b: DVec3) -> S {
    a[0] * b.x + a[1] * b.y + a[2] * b.z
}

/// Σ cos^2N(½ angle) over some directions: about 1 at each, and falling like a Gaussian of variance 2/N.
fn crowding<S: Scalar, const N: u32>(directions: &[DVec3], u: [S; 3]) -> S {
    directions.iter().fold(S::constant(0.0), |sum, d| sum + ((dot(u, *d) + 1.0) * 0.5).powi(N))
}

/// A smooth maximum: k ln(e^(a/k) + e^(b/k)).
fn blend<S: Scalar>(a: S, b: S, k: f64) -> S {
    let (hi, lo) = if a.real() >= b.real() { (a, b) } else { (b, a) };
    hi + (((lo - hi) * (1.0 / k)).exp() + 1.0).ln() * k
}

/// Approximate square of the distance to a trefoil.
///
/// In the half-plane at the angle φ about z, let w = √(x² + y²) − R + i z. The two strands are at ± a e^(3iφ/2), and
/// |w² − a² e^(3iφ)| / 2a is the distance to the nearer one in first order.
fn from_knot<S: Scalar>([x, y, z]: [S; 3]) -> S {
    let [ring, a, _] = KNOT;
    // The small number keeps the axis smooth, where the knot is not.
    let rho = (length_squared([x, y]) + 1e-6).sqrt();
    let (cos, sin) = (x / rho, y / rho);
    let twice = [cos.squared() - sin.squared(), cos * sin * 2.0];
    let thrice = [twice[0] * cos - twice[1] * sin, twice[0] * sin + twice[1] * cos];
    let across = rho - ring;
    let gap = [across.squared() - z.squared() - thrice[0] * (a * a), across * z * 2.0 - thrice[1] * (a * a)];
    length_squared(gap) * (0.25 / (a * a))
}

impl Formula for Specimen {
    fn at<S: Scalar>(&self, p: [S; 3]) -> S {
        let levels = [0.2, 0.4, 1.0, 1.0, 1.0];
        let paint = |v: S, (body, level): (S, f64)| {
            let cover = (body * (1.0 / self.w)).logistic();
            v + cover * (S::constant(level) - v)
        };
        self.bodies(p).into_iter().zip(levels).fold(S::constant(0.0), paint) * self.high
    }

    fn label(&self, p: DVec3) -> u16 {
        let bodies = self.bodies(p.to_array());
        bodies.iter().rposition(|&field| field >= 0.0).map_or(0, |i| i as u16 + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made, unit_grid};
    use super::super::{sample, sample_labels};
    use super::*;
    use crate::volume::VoxelType;

    #[test]
    fn forty_two_pores_and_twenty_spines_at_their_angles() {
        let it = Specimen::new(1.0, 0.005, 255.0);
        assert_eq!((it.pores.len(), it.spines.len()), (42, 20));
        // A spine stands as far from pores as one can be: 20.9° = the angle from a face's centre to an edge's middle.
        let golden = 0.5 * (1.0 + 5f64.sqrt());
        let to_edge = golden * golden / (3f64.sqrt() * golden);
        for spine in &it.spines {
            let nearest = it.pores.iter().map(|pore| pore.dot(*spine)).fold(-1.0, f64::max);
            assert_near(nearest, to_edge, 1e-15);
        }
    }

    #[test]
    fn each_body_has_its_level() {
        // Each place below is at least 7.5 w from the next edge, which leaves 255 e^−7.5 = 0.15 at the most.
        let (specimen, centre) = made("specimen", &[("w", 0.00125)]);
        let spine = DVec3::ONE.normalize();
        let [ring, a, _] = KNOT;
        let strand = DVec3::new(ring + a, 0.0, 0.0);
        let pore = DVec3::X;
        for (p, level, label) in [
            (DVec3::ZERO, 255.0, 4),                                         // core
            (strand, 255.0, 3),                                              // marrow
            (strand + 0.023 * DVec3::Z, 102.0, 2),                           // knot
            (pore * 0.265, 51.0, 1),                                         // a pore of the lattice
            (pore * 0.30, 51.0, 1),                                          // under the veil
            (spine * 0.265, 255.0, 5),                                       // a joint of the lattice
            (spine * 0.38, 255.0, 5),                                        // a spine
            (spine * 0.43 + 0.02 * spine.any_orthonormal_vector(), 51.0, 1), // the veil about its tip
            (DVec3::Z * 0.38, 0.0, 0),                                       // beyond the veil
        ] {
            assert_near(specimen.value(centre + p), level, 0.15);
            assert_eq!(specimen.label(centre + p), label, "{p}");
        }
    }

    /// Skeleton outside the lattice is covered by veil, several edges deep: none of its edges passes the veil's values.
    #[test]
    fn the_veil_covers_the_spines() {
        let w = 0.5 / 159.0;
        let it = Specimen::new(1.0, w, 255.0);
        for spine in &it.spines {
            let side = spine.any_orthonormal_vector();
            for i in 0..200 {
                for across in [0.0, 0.005, 0.01, 0.015] {
                    let p = *spine * (0.25 + 0.00125 * f64::from(i)) + side * across;
                    let [veil, .., skeleton] = it.bodies(p.to_array());
                    assert!(skeleton < 0.0 || veil > 4.0 * w, "{p}: {veil} {skeleton}");
                }
            }
        }
    }

    #[test]
    fn it_fills_its_box_and_its_levels() {
        let grid = unit_grid();
        let (specimen, _) = made("specimen", &[]);
        let volume = sample(specimen.as_ref(), grid.clone(), VoxelType::U8).unwrap();
        assert!(volume.range()[0] == 0.0 && volume.range()[1] > 250.0, "{:?}", volume.range());
        let labels = sample_labels(specimen.as_ref(), grid).unwrap();
        assert_eq!(labels.range(), [0.0, 5.0]);
        // Nothing touches the box.
        let dark = |x: usize, y: usize| {
            let places = [[0, x, y], [64, x, y], [x, 0, y], [x, 64, y], [x, y, 0], [x, y, 64]];
            places.into_iter().all(|place| volume.value(place) < 3.0)
        };
        assert!((0..65 * 65).all(|i| dark(i % 65, i / 65)));
    }
}
