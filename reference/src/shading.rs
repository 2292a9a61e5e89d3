//! Blinn–Phong shading of a regular transfer function ([STF-11]).

use crate::number::{Arithmetic, Decision, Elementary, Mask, Real, Vec3};
use drypoint_scene::shot::PhongParams;

/// Material and light; the vectors are in world space.
#[derive(Clone, Copy, Debug)]
pub struct Phong<R> {
    ambient: R,
    diffuse: R,
    specular: R,
    shininess: Exponent<R>,
    /// L: the unit vector towards the light.
    light: Vec3<R>,
}

/// s, with integers up to 64 recognized once and not at every sample ([PREC-4]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Exponent<R> {
    Whole(u32),
    Other(R),
}

impl<R: Real> Phong<R> {
    /// Prepares the reflection of a shot.
    pub fn new(params: &PhongParams) -> Self {
        let s = params.shininess;
        let whole = s.fract() == 0.0 && (0.0..=64.0).contains(&s);
        Self {
            ambient: R::from_f64(params.ambient),
            diffuse: R::from_f64(params.diffuse),
            specular: R::from_f64(params.specular),
            shininess: if whole { Exponent::Whole(s as u32) } else { Exponent::Other(R::from_f64(s)) },
            light: Vec3::from_glam(params.light),
        }
    }

    /// Ĥ for a direction to the eye. Both are constant along a ray.
    #[inline(always)]
    pub fn half_vector<A: Arithmetic<Number = R>>(&self, v: Vec3<A>) -> Vec3<A> {
        half_vector(self.light, v)
    }

    /// c = c_u·(k_a + k_d·max(0, N·L)) + k_s·max(0, N·Ĥ)^s. The specular term is 0 where N·L ≤ 0. Light is white,
    /// colours are straight, and there is no clamp.
    #[inline(always)]
    pub fn shade<A: Elementary<Number = R>>(&self, c_u: [A; 3], n: Vec3<A>, half: Vec3<A>) -> [A; 3] {
        let n_l = n.dot(Vec3::constant(n.x, self.light));
        let ambient = n_l.constant(self.ambient);
        let dark = n_l.deciding(Decision::Light).at_most(n_l.zero());
        if dark.all() {
            return [c_u[0] * ambient, c_u[1] * ambient, c_u[2] * ambient];
        }
        let n_h = n.dot(half).max(n_l.zero());
        let power = match self.shininess {
            Exponent::Whole(s) => n_h.pow_whole(s),
            Exponent::Other(s) => n_h.pow(s),
        };
        let lit = ambient + n_l.constant(self.diffuse) * n_l;
        let highlight = n_l.constant(self.specular) * power;
        let mut rgb = c_u;
        for c in &mut rgb {
            *c = A::select(dark, *c * ambient, *c * lit + highlight);
        }
        rgb
    }
}

/// Ĥ = (L + v)/‖L + v‖, 0 where L = −v.
#[inline(always)]
pub fn half_vector<A: Arithmetic>(light: Vec3<A::Number>, v: Vec3<A>) -> Vec3<A> {
    let half = Vec3::constant(v.x, light) + v;
    let (length, zero) = (half.length(), v.x.zero());
    Vec3::select(zero.below(length), half * (length.one() / length), Vec3::new(zero, zero, zero))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::lanes::LANES;
    use crate::number::lanes::testing::{column, numbers, same, side_by_side, units};
    use drypoint_scene::glam::DVec3;
    use fearless_simd::prelude::*;
    use fearless_simd::{Level, dispatch, f64x8};

    fn shade(light: DVec3, c_u: f64, n: Vec3<f64>) -> f64 {
        let phong = Phong {
            ambient: 0.3,
            diffuse: 0.6,
            specular: 0.25,
            shininess: Exponent::Whole(2),
            light: Vec3::from_glam(light.normalize()),
        };
        let v = Vec3::new(0.0, 0.0, 1.0);
        phong.shade([c_u; 3], n, phong.half_vector(v))[0]
    }

    #[test]
    fn hand_worked_material() {
        let z = Vec3::new(0.0, 0.0, 1.0);
        // Everything along z: 0.5·0.9 + 0.25.
        assert!((shade(DVec3::Z, 0.5, z) - 0.7).abs() < 1e-15);
        // Light at 60°, normal along v: N·L = ½, Ĥ at 30°: N·Ĥ² = ¾.
        let got = shade(DVec3::new(3f64.sqrt(), 0.0, 1.0), 1.0, z);
        assert!((got - (0.3 + 0.3 + 0.25 * 0.75)).abs() < 1e-15, "{got}");
    }

    #[test]
    fn the_dark_side_is_ambient_alone_and_light_from_behind_has_no_half_vector() {
        let z = Vec3::new(0.0, 0.0, 1.0);
        assert_eq!(shade(DVec3::Z, 1.0, -z), 0.3);
        // L = −v: N·L > 0 only for normals facing away; Ĥ = 0 there.
        assert!((shade(-DVec3::Z, 1.0, -z) - 0.9).abs() < 1e-15);
    }

    /// Lit and dark lanes, a whole and a broken exponent, and a light from behind.
    #[test]
    fn lanes_are_those_of_one() {
        let level = Level::new();
        let [mut a, mut b, mut c] = [1, 2, 3].map(numbers);
        for shininess in [Exponent::Whole(10), Exponent::Other(10.25)].into_iter().cycle().take(1000) {
            let (n, mut v, color) = (units(&mut a), units(&mut b), column(&mut c));
            let phong = Phong { ambient: 0.3, diffuse: 0.6, specular: 0.25, shininess, light: -v[3] };
            v[0] = n[0];
            let [got, half]: [[f64; LANES]; 2] = dispatch!(level, simd => {
                let half = phong.half_vector(side_by_side(simd, v));
                let color: f64x8<_> = color.simd_into(simd);
                [phong.shade([color; 3], side_by_side(simd, n), half)[0].into(), half.x.into()]
            });
            same(half, |lane| phong.half_vector(v[lane]).x);
            same(got, |lane| phong.shade([color[lane]; 3], n[lane], phong.half_vector(v[lane]))[0]);
        }
    }
}
