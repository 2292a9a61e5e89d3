//! A smooth field with waves of several lengths, so that no smoothing passes them all alike.

use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::math::{cos, sin};
use drypoint::scene::phantom::{Jet, Phantom};

/// f(p) = √(2/5) Σ sin(u·p + φ) over five wave vectors of the lengths 1, 0.9, 0.8, 0.7 and 0.6. Values have a root mean
/// square of 1; a wave's derivatives fall with its length.
pub(crate) struct Waves {
    waves: [(DVec3, f64); 5],
}

/// √(2/5).
const AMPLITUDE: f64 = 0.632_455_532_033_675_9;

impl Waves {
    pub(crate) fn new() -> Self {
        // No two parallel, none along an axis of a grid.
        let directions = [[6.0, 2.0, 3.0], [-2.0, 6.0, 5.0], [3.0, -4.0, 7.0], [5.0, 5.0, -2.0], [-4.0, 1.0, 2.0]];
        let length = |i: usize| 1.0 - 0.1 * i as f64;
        let wave = |i: usize| (DVec3::from_array(directions[i]).normalize() * length(i), 1.25 * i as f64);
        Self { waves: std::array::from_fn(wave) }
    }
}

impl Phantom for Waves {
    fn value(&self, p: DVec3) -> f64 {
        AMPLITUDE * self.waves.iter().map(|(u, phase)| sin(u.dot(p) + phase)).sum::<f64>()
    }

    fn jet(&self, p: DVec3) -> Jet {
        let (mut gradient, mut hessian) = (DVec3::ZERO, DMat3::ZERO);
        for (u, phase) in &self.waves {
            let angle = u.dot(p) + phase;
            let (s, c) = (AMPLITUDE * sin(angle), AMPLITUDE * cos(angle));
            gradient += *u * c;
            hessian -= DMat3::from_cols(*u * (u.x * s), *u * (u.y * s), *u * (u.z * s));
        }
        Jet { value: self.value(p), gradient, hessian }
    }

    fn label(&self, _: DVec3) -> u16 {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_the_value() {
        let (waves, p, h) = (Waves::new(), DVec3::new(0.3, -1.2, 4.0), 1e-4);
        let jet = waves.jet(p);
        for axis in 0..3 {
            let step = DVec3::AXES[axis] * h;
            let [a, b] = [waves.jet(p - step), waves.jet(p + step)];
            // Central differences are off by h²/6 of a third derivative below 4, and by 10⁻¹⁶/h.
            assert!(((b.value - a.value) / (2.0 * h) - jet.gradient[axis]).abs() < 1e-8);
            assert!(((b.gradient - a.gradient) / (2.0 * h) - jet.hessian.col(axis)).length() < 1e-8);
        }
    }
}
