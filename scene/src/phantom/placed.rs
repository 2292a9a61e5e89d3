//! Phantoms in the world, from formulas about their own origin.

use super::Phantom;
use super::jet::{Jet, Scalar};
use glam::DVec3;

/// A field about its own origin, written once for values and for derivatives.
pub(super) trait Formula: Send + Sync {
    /// The field at a point relative to the phantom's centre.
    fn at<S: Scalar>(&self, p: [S; 3]) -> S;

    /// The label at a point relative to the phantom's centre; 0 is none.
    fn label(&self, _p: DVec3) -> u16 {
        0
    }
}

/// The map from a distance to a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Edge {
    /// Width in world units; 0: the distance itself.
    pub(super) w: f64,
    /// The value far inside.
    pub(super) high: f64,
}

impl Edge {
    /// value = high / (1 + e^(−d/w)), or d where w = 0. Its level ½ high is the surface d = 0.
    pub(super) fn at<S: Scalar>(self, d: S) -> S {
        if self.w == 0.0 { d } else { (d * (1.0 / self.w)).logistic() * self.high }
    }
}

/// A formula at a place in the world.
pub(super) struct Placed<F> {
    pub(super) formula: F,
    pub(super) centre: DVec3,
    pub(super) edge: Edge,
}

impl<F: Formula> Phantom for Placed<F> {
    fn value(&self, p: DVec3) -> f64 {
        self.edge.at(self.formula.at((p - self.centre).to_array()))
    }

    fn jet(&self, p: DVec3) -> Jet {
        self.edge.at(self.formula.at(Jet::coordinates(p - self.centre)))
    }

    fn label(&self, p: DVec3) -> u16 {
        self.formula.label(p - self.centre)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_edge_is_half_on_the_surface_and_steep_as_it_should_be() {
        let edge = Edge { w: 2.0, high: 255.0 };
        let at = |d: f64| edge.at(Jet::coordinates(DVec3::new(d, 0.0, 0.0))[0]);
        // v = h σ(d/w), v′ = h σ (1 − σ) / w, v″ = h σ (1 − σ)(1 − 2σ) / w²; e^−ln 3 makes σ = 3/4.
        assert_eq!([at(0.0).value, at(0.0).gradient.x, at(0.0).hessian.x_axis.x], [127.5, 255.0 / 8.0, 0.0]);
        let there = at(2.0 * 3f64.ln());
        assert!((there.value - 191.25).abs() < 1e-13);
        assert!((there.gradient.x - 255.0 * 3.0 / 32.0).abs() < 1e-13);
        assert!((there.hessian.x_axis.x + 255.0 * 3.0 / 128.0).abs() < 1e-13);
        assert_eq!(Edge { w: 0.0, high: 255.0 }.at(-3.25), -3.25);
    }
}
