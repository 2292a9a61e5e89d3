//! Shepp and Logan's head in three dimensions: a sum of constants over ten ellipsoids.
//!
//! Geometry: A. C. Kak, M. Slaney: Principles of Computerized Tomographic Imaging, 1988, table 3.1 (page 102), as
//! corrected in the authors' errata. Densities: H. Yu, Y. Ye, G. Wang: Katsevich-type algorithms for variable radius
//! spiral cone-beam CT, SPIE 5535, 2004, whose contrast can be seen (the original's soft tissues differ by 1 %).
//! f = high · Σ density over the ellipsoids that hold the point. Piecewise constant: all derivatives are 0.

use super::jet::Scalar;
use super::params::{About, Allowed, HIGH, Param, Preset};
use super::placed::Formula;
use crate::math;

pub(super) const SHEPP_LOGAN: About = About {
    name: "shepp-logan",
    doc: "Shepp and Logan's head, piecewise constant in 0…high",
    params: &[
        Param {
            name: "s",
            doc: "world length of the table's 1",
            default: Preset::Side(0.5),
            allowed: Allowed::Positive,
        },
        HIGH,
    ],
    build: |args| {
        let [scale, high] = args.values();
        Ok(args.field(SheppLogan { ellipsoids: TABLE.map(|row| Ellipsoid::new(row, scale)), high }))
    },
};

/// Half axes, centre, angle about z in degrees, density.
type Row = ([f64; 3], [f64; 3], f64, f64);

const TABLE: [Row; 10] = [
    ([0.6900, 0.920, 0.900], [0.0, 0.0, 0.0], 0.0, 1.0),
    ([0.6624, 0.874, 0.880], [0.0, 0.0, 0.0], 0.0, -0.8),
    ([0.4100, 0.160, 0.210], [-0.22, 0.0, -0.25], 108.0, -0.2),
    ([0.3100, 0.110, 0.220], [0.22, 0.0, -0.25], 72.0, -0.2),
    ([0.2100, 0.250, 0.500], [0.0, 0.35, -0.25], 0.0, 0.2),
    ([0.0460, 0.046, 0.046], [0.0, 0.1, -0.25], 0.0, 0.2),
    ([0.0460, 0.023, 0.020], [-0.08, -0.65, -0.25], 0.0, 0.1),
    ([0.0460, 0.023, 0.020], [0.06, -0.65, -0.25], 90.0, 0.1),
    ([0.0560, 0.040, 0.100], [0.06, -0.105, 0.625], 90.0, 0.2),
    ([0.0560, 0.056, 0.100], [0.0, 0.1, 0.625], 0.0, -0.2),
];

struct Ellipsoid {
    half_axes: [f64; 3],
    centre: [f64; 3],
    cos_sin: [f64; 2],
    density: f64,
}

impl Ellipsoid {
    fn new((half_axes, centre, degrees, density): Row, scale: f64) -> Self {
        let angle = degrees.to_radians();
        Self {
            half_axes: half_axes.map(|a| a * scale),
            centre: centre.map(|x| x * scale),
            cos_sin: [math::cos(angle), math::sin(angle)],
            density,
        }
    }

    fn holds(&self, p: [f64; 3]) -> bool {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|i| p[i] - self.centre[i]);
        let ([cos, sin], [a, b, c]) = (self.cos_sin, self.half_axes);
        let along = [(x * cos + y * sin) / a, (y * cos - x * sin) / b, z / c];
        along[0] * along[0] + along[1] * along[1] + along[2] * along[2] <= 1.0
    }
}

struct SheppLogan {
    ellipsoids: [Ellipsoid; 10],
    high: f64,
}

impl Formula for SheppLogan {
    fn at<S: Scalar>(&self, p: [S; 3]) -> S {
        let place = p.map(S::real);
        let density: f64 = self.ellipsoids.iter().filter(|e| e.holds(place)).map(|e| e.density).sum();
        S::constant(self.high * density)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made};
    use super::*;
    use glam::DVec3;

    #[test]
    fn densities_by_hand() {
        let (head, centre) = made("shepp-logan", &[("s", 1.0), ("high", 1.0)]);
        for (x, y, z, density) in [
            (0.95, 0.0, 0.0, 0.0),    // outside
            (0.0, 0.9, 0.0, 1.0),     // skull
            (0.0, 0.0, 0.0, 0.2),     // brain
            (-0.22, 0.0, -0.25, 0.0), // ventricles
            (0.22, 0.0, -0.25, 0.0),
            (0.0, 0.35, -0.25, 0.4),  // tumours
            (0.0, -0.65, -0.25, 0.2), // between two of them
            (-0.08, -0.65, -0.25, 0.3),
            (0.06, -0.61, -0.25, 0.3), // within the one that is turned by 90°
            (0.10, -0.65, -0.25, 0.2),
            (0.0, 0.1, 0.625, 0.0),
        ] {
            assert_near(head.value(centre + DVec3::new(x, y, z)), density, 1e-15);
        }
    }

    #[test]
    fn mass_is_the_sum_of_the_ellipsoids() {
        // ∫ f = Σ density · 4/3 π a b c. A midpoint sum over 64³ cells of a set with smooth boundary of area A errs
        // by about A^½ h^2.5 when boundary cells are independent; the skull has A ≈ 9 and h = 1/32: 5·10⁻⁴.
        let head = SheppLogan { ellipsoids: TABLE.map(|row| Ellipsoid::new(row, 1.0)), high: 1.0 };
        let at = |i: usize| (i as f64 + 0.5) / 32.0 - 1.0;
        let sum: f64 = (0..1 << 18).map(|i| head.at([at(i & 63), at(i >> 6 & 63), at(i >> 12)])).sum();
        let volume = |[a, b, c]: [f64; 3]| 4.0 / 3.0 * std::f64::consts::PI * a * b * c;
        let want: f64 = TABLE.iter().map(|(axes, _, _, density)| density * volume(*axes)).sum();
        assert_near(sum / 32f64.powi(3), want, 2e-3);
    }
}
