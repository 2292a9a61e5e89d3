//! Watercolour: transparent pigment on paper, laid in glazes.
//!
//! What is imitated are the marks by which watercolour is known (named by Curtis et al., Computer-generated
//! watercolor, SIGGRAPH 1997): a glaze dries darker along its edge, pigment settles in the hollows of the paper and in
//! pools, and glazes multiply. No water is simulated: each mark is a term of the density.

use super::light::{KEY, radius, reflected, smoothstep};
use super::noise::{Draw, fractal, on_form};
use super::paint::{Linear, Paint, linear};
use drypoint::scene::math;
use drypoint_reference::number::Vec3;

/// What white paper looks like under a layer of density D: Beer's law per channel, hex^D.
pub(super) fn under(paper: Linear, pigment: u32, density: f64) -> Linear {
    let mass = linear(pigment);
    std::array::from_fn(|c| paper[c] * math::exp(density * math::ln(mass[c].max(1e-3))))
}

/// Three glazes of one pigment, each from a border of light into the shade.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wash {
    /// Borders N·L of the glazes from light to dark, and their densities.
    pub(super) glazes: [(f64, f64); 3],
    /// How sharp a border is: half its width in N·L.
    pub(super) soft: f64,
    /// How much darker a glaze dries along its border.
    pub(super) edge: f64,
    /// How much pigment the paper's hollows take.
    pub(super) grain: f64,
}

impl Wash {
    /// The density of the pigment.
    pub(super) fn density(&self, n: Vec3<f64>) -> f64 {
        let (x, y) = on_form(n);
        let lit = n.dot(KEY) + 0.11 * fractal(1.7 * x + 3.0, 1.7 * y, 3, Draw::Hand);
        let mut density = 0.0;
        for (at, depth) in self.glazes {
            let inside = at - lit;
            let wet = smoothstep(-self.soft, self.soft, inside);
            density += depth * wet * (1.0 + self.edge * math::exp(-inside.max(0.0) / 0.05));
        }
        let pool = 1.0 + 0.16 * fractal(2.6 * x, 2.6 * y, 2, Draw::Pool);
        let rim = 1.0 + self.edge * smoothstep(0.84, 0.95, radius(n));
        density * pool * rim * (1.0 - 0.4 * reflected(n)) * (1.0 + self.grain * tooth(n))
    }
}

/// The height of the paper, about [−1, 1], in the plane of the picture.
pub(super) fn tooth(n: Vec3<f64>) -> f64 {
    fractal(26.0 * n.x, 26.0 * n.y, 2, Draw::Tooth)
}

/// Bare paper of that colour, its tooth lit from the side.
pub(super) fn paper(n: Vec3<f64>, rgb: u32) -> Linear {
    let relief = tooth(n) - tooth(Vec3::new(n.x + 0.012, n.y - 0.012, n.z));
    linear(rgb).map(|c| (c * (1.0 + 0.03 * relief)).min(1.0))
}

/// Linear light as a colour to paint with.
pub(super) fn as_paint(light: Linear) -> Paint {
    Paint::linear(light.map(|c| c.clamp(0.0, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_of_pigment_multiply() {
        let white = [1.0; 3];
        assert_eq!(under(white, 0x2b4fa6, 0.0), white);
        let (mass, once) = (linear(0x2b4fa6), under(white, 0x2b4fa6, 1.0));
        let (thrice, in_turn) = (under(white, 0x2b4fa6, 3.0), under(under(once, 0x2b4fa6, 0.5), 0x2b4fa6, 1.5));
        for c in 0..3 {
            assert!((once[c] - mass[c]).abs() < 1e-15);
            assert!((thrice[c] - in_turn[c]).abs() < 1e-15 && thrice[c] < once[c]);
        }
    }

    #[test]
    fn a_glaze_begins_at_its_border_and_is_darkest_there() {
        let wash = Wash { glazes: [(0.2, 1.0), (-9.0, 1.0), (-9.0, 1.0)], soft: 0.02, edge: 0.5, grain: 0.0 };
        // Along the great circle through the light towards the lower right; the border may stray by 0.11.
        let down = Vec3::new(0.6 * 0.6, -0.8 * 0.6, 0.8);
        let at = |turn: f64| wash.density(KEY * turn.cos() + down * turn.sin());
        assert!((KEY.dot(down)).abs() < 1e-15);
        assert_eq!(at(0.8), 0.0);
        let densities: Vec<f64> = (0..100).map(|k| at(1.2 + 0.004 * f64::from(k))).collect();
        let darkest = densities.iter().copied().fold(0.0, f64::max);
        assert!(darkest > 1.15 * densities[99] && densities[99] > 0.5, "{darkest}, {}", densities[99]);
    }
}
