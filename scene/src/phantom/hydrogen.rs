//! Real hydrogen orbitals: f = high · |ψ_nlm|² / max |ψ_nlm|².
//!
//! With the Bohr radius a and q = 2p / (n a), ρ = ‖q‖, a real orbital is, up to a constant (Bethe, Salpeter 1957,
//! section 3; Condon and Shortley's sign left out),
//!
//! ψ = e^(−ρ/2) L(ρ) · Q(q_z, ρ²) · Re or Im (q_x + i q_y)^|m|,
//!
//! L the associated Laguerre polynomial of degree n − l − 1 and order 2l + 1, Q ρ^−(l−|m|) the |m|-th derivative of the
//! Legendre polynomial P_l at q_z/ρ; Re for m ≥ 0, Im for m < 0. As a product of a function of ρ and polynomials it
//! is smooth everywhere but at the nucleus, where s orbitals have a cusp. The mean distance of the electron from the
//! nucleus is ⟨r⟩ = a (3n² − l(l + 1)) / 2, and is the parameter R.

use super::jet::{Scalar, length_squared};
use super::params::{About, Allowed, HIGH, Param, Preset};
use super::placed::Formula;
use crate::math;

pub(super) const HYDROGEN: About = About {
    name: "hydrogen",
    doc: "density |ψ_nlm|² of a real hydrogen orbital, scaled to 0…high",
    params: &[
        Param { name: "n", doc: "principal number", default: Preset::Number(4.0), allowed: Allowed::Whole(1.0, 8.0) },
        Param {
            name: "l",
            doc: "azimuthal number, below n",
            default: Preset::Number(3.0),
            allowed: Allowed::Whole(0.0, 7.0),
        },
        Param {
            name: "m",
            doc: "magnetic number, −l…l; below 0 the sine",
            default: Preset::Number(0.0),
            allowed: Allowed::Whole(-7.0, 7.0),
        },
        Param {
            name: "R",
            doc: "mean distance of the electron: Bohr radius a = 2R / (3n² − l(l + 1))",
            default: Preset::Side(0.3),
            allowed: Allowed::Positive,
        },
        HIGH,
    ],
    build: |args| {
        let [n, l, m, mean, high] = args.values();
        if l >= n {
            return Err(format!("l = {l} must be below n = {n}"));
        }
        if m.abs() > l {
            return Err(format!("m = {m} must lie between −l and l = {l}"));
        }
        let bohr = 2.0 * mean / (3.0 * n * n - l * (l + 1.0));
        Ok(args.field(Hydrogen::new(n as u32, l as u32, m as i32, bohr, high)))
    },
};

struct Hydrogen {
    n: u32,
    l: u32,
    m: i32,
    /// 2 / (n a).
    scale: f64,
    /// high / max ψ².
    factor: f64,
}

impl Hydrogen {
    fn new(n: u32, l: u32, m: i32, bohr: f64, high: f64) -> Self {
        let raw = Self { n, l, m, scale: 2.0 / (f64::from(n) * bohr), factor: 1.0 };
        // ψ² is a function of ρ times one of cos θ times cos² or sin² of mφ: its maximum is the product of theirs.
        // Beyond ρ = 4n the orbital only decays.
        let radial = maximum(0.0, f64::from(4 * n), |r| (raw.radial(r) * math::pow_whole(r, 1.0, l)).powi(2));
        let polar =
            maximum(-1.0, 1.0, |t| raw.legendre(t, 1.0).powi(2) * math::pow_whole(1.0 - t * t, 1.0, m.unsigned_abs()));
        Self { factor: high / (radial * polar), ..raw }
    }

    /// e^(−ρ/2) L(ρ), by the recurrence k L_k = (2k − 1 + α − ρ) L_{k−1} − (k − 1 + α) L_{k−2}.
    fn radial<S: Scalar>(&self, rho: S) -> S {
        let alpha = f64::from(2 * self.l + 1);
        let (mut before, mut laguerre) = (S::constant(0.0), S::constant(1.0));
        for k in 1..self.n - self.l {
            let k = f64::from(k);
            let next = (-rho + (2.0 * k - 1.0 + alpha)) * laguerre - before * (k - 1.0 + alpha);
            (before, laguerre) = (laguerre, next * (1.0 / k));
        }
        laguerre * (rho * -0.5).exp()
    }

    /// Q(z, r²), by the recurrence (k − m) Q_k = (2k − 1) z Q_{k−1} − (k + m − 1) r² Q_{k−2} from
    /// Q_m = 1 · 3 ⋯ (2m − 1).
    fn legendre<S: Scalar>(&self, z: S, r_squared: S) -> S {
        let m = self.m.unsigned_abs();
        let start = (1..=m).map(|k| f64::from(2 * k - 1)).product();
        let (mut before, mut q) = (S::constant(0.0), S::constant(start));
        for k in m + 1..=self.l {
            let next = z * q * f64::from(2 * k - 1) - r_squared * before * f64::from(k + m - 1);
            (before, q) = (q, next * (1.0 / f64::from(k - m)));
        }
        q
    }
}

impl Formula for Hydrogen {
    fn at<S: Scalar>(&self, p: [S; 3]) -> S {
        let q = p.map(|x| x * self.scale);
        let r_squared = length_squared(q);
        let mut round = [S::constant(1.0), S::constant(0.0)];
        for _ in 0..self.m.unsigned_abs() {
            round = [round[0] * q[0] - round[1] * q[1], round[0] * q[1] + round[1] * q[0]];
        }
        let psi = self.radial(r_squared.sqrt()) * self.legendre(q[2], r_squared) * round[usize::from(self.m < 0)];
        psi.squared() * self.factor
    }
}

/// The maximum of a smooth function on an interval: the best of 4096 equal steps, then a golden-section search between
/// its neighbours. Near a maximum the value converges long before the position does.
fn maximum(lo: f64, hi: f64, f: impl Fn(f64) -> f64) -> f64 {
    const STEPS: u32 = 4096;
    let at = |i: u32| lo + (hi - lo) * f64::from(i) / f64::from(STEPS);
    let best = (0..=STEPS).fold(0, |best, i| if f(at(i)) > f(at(best)) { i } else { best });
    let (mut a, mut b) = (at(best.saturating_sub(1)), at((best + 1).min(STEPS)));
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    for _ in 0..60 {
        let (x, y) = (b - golden * (b - a), a + golden * (b - a));
        if f(x) > f(y) { b = y } else { a = x }
    }
    f(0.5 * (a + b)).max(f(at(best)))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made};
    use crate::math::exp;
    use glam::DVec3;

    /// The orbital with Bohr radius 1/64 and high = 1.
    fn orbital(n: f64, l: f64, m: f64) -> impl Fn(DVec3) -> f64 {
        let mean = (3.0 * n * n - l * (l + 1.0)) / 128.0;
        let (phantom, centre) = made("hydrogen", &[("n", n), ("l", l), ("m", m), ("R", mean), ("high", 1.0)]);
        move |p| phantom.value(centre + p / 64.0)
    }

    #[test]
    fn densities_of_the_textbook() {
        // Lengths in Bohr radii; each density over its own maximum. 1s: e^−2r.
        let p = DVec3::new(1.2, -0.5, 0.7);
        let (r, z) = (p.length(), p.z);
        assert_near(orbital(1.0, 0.0, 0.0)(p), exp(-2.0 * r), 1e-14);
        // 2p_z: z² e^−r, highest at z = r = 2.
        assert_near(orbital(2.0, 1.0, 0.0)(p), z * z * exp(-r) / (4.0 * exp(-2.0)), 1e-14);
        assert_near(orbital(2.0, 1.0, 1.0)(p), p.x * p.x * exp(-r) / (4.0 * exp(-2.0)), 1e-14);
        assert_near(orbital(2.0, 1.0, -1.0)(p), p.y * p.y * exp(-r) / (4.0 * exp(-2.0)), 1e-14);
        // 3d_z²: (3z² − r²)² e^(−2r/3), highest at z = r = 6.
        let d = |r: f64, z: f64| (3.0 * z * z - r * r).powi(2) * exp(-2.0 * r / 3.0);
        assert_near(orbital(3.0, 2.0, 0.0)(p), d(r, z) / d(6.0, 6.0), 1e-14);
        // 4f_z³: z² (5z² − 3r²)² e^(−r/2), highest at z = r = 12.
        let f = |r: f64, z: f64| (z * (5.0 * z * z - 3.0 * r * r)).powi(2) * exp(-0.5 * r);
        assert_near(orbital(4.0, 3.0, 0.0)(p), f(r, z) / f(12.0, 12.0), 1e-14);
        // 3d_xy: (xy)² e^(−2r/3), highest at r = 6, x = y.
        let xy = (p.x * p.y).powi(2) * exp(-2.0 * r / 3.0);
        assert_near(orbital(3.0, 2.0, -2.0)(p), xy / (324.0 * exp(-4.0)), 1e-14);
    }

    #[test]
    fn nodes_and_maxima() {
        // 3s vanishes where 27 − 18r + 2r² = 0 and is highest at the nucleus.
        let s3 = orbital(3.0, 0.0, 0.0);
        for node in [(9.0 - 27f64.sqrt()) / 2.0, (9.0 + 27f64.sqrt()) / 2.0] {
            assert_near(s3(DVec3::new(0.0, node, 0.0)), 0.0, 1e-28);
        }
        assert_near(s3(DVec3::ZERO), 1.0, 1e-15);
        assert_near(orbital(4.0, 3.0, 0.0)(DVec3::new(0.0, 0.0, 12.0)), 1.0, 1e-14);
        // 7 (l = 4, m = 2): nothing exceeds the maximum.
        let high = orbital(7.0, 4.0, 2.0);
        let top = (0..200_000)
            .map(|i| high(DVec3::new(f64::from(i % 100), 0.0, f64::from(i / 100) * 0.05)))
            .fold(0.0, f64::max);
        assert!(top <= 1.0 + 1e-14 && top > 0.99, "{top}");
    }
}
