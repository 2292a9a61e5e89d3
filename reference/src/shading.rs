//! Blinn–Phong shading of a regular transfer function ([STF-11]).

use crate::number::{Real, Vec3};
use drypoint_scene::glam::DVec3;
use drypoint_scene::tables::{LightDirection, Shading};
use drypoint_scene::view::View;

/// Material and light; the vectors are in eye space.
#[derive(Clone, Copy, Debug)]
pub struct Phong<R> {
    ambient: R,
    diffuse: R,
    specular: R,
    shininess: R,
    /// L: the unit vector towards the light.
    light: Vec3<R>,
}

/// The unit vector towards a light, in eye space. The head light is (0, 0, 1) at every sample, also in perspective.
pub fn towards(light: LightDirection, view: &View) -> DVec3 {
    match light {
        LightDirection::Head => DVec3::Z,
        LightDirection::Eye(d) => d.normalize(),
        LightDirection::World(d) => view.direction_to_eye(d.normalize()),
    }
}

impl<R: Real> Phong<R> {
    /// A shading table under the light of its scene.
    pub fn new(shading: &Shading, scene_light: LightDirection, view: &View) -> Self {
        Self {
            ambient: R::from_f64(shading.ambient),
            diffuse: R::from_f64(shading.diffuse),
            specular: R::from_f64(shading.specular),
            shininess: R::from_f64(shading.shininess),
            light: Vec3::from_glam(towards(shading.light.unwrap_or(scene_light), view)),
        }
    }

    /// c = c_u·(k_a + k_d·max(0, N·L)) + k_s·max(0, N·Ĥ)^s, Ĥ = (L + v)/‖L + v‖ (0 where L = −v), the specular term 0
    /// where N·L ≤ 0; white light, straight colours, no clamp.
    #[inline]
    pub fn shade(&self, c_u: [R; 3], n: Vec3<R>, v: Vec3<R>) -> [R; 3] {
        let n_l = n.dot(self.light);
        if n_l <= R::ZERO {
            return c_u.map(|c| c * self.ambient);
        }
        let half = self.light + v;
        let length = half.length();
        let n_h = if length > R::ZERO { (n.dot(half) / length).max(R::ZERO) } else { R::ZERO };
        let diffuse = self.ambient + self.diffuse * n_l;
        let specular = self.specular * n_h.pow(self.shininess);
        c_u.map(|c| c * diffuse + specular)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn phong(light: DVec3) -> Phong<f64> {
        Phong { ambient: 0.3, diffuse: 0.6, specular: 0.25, shininess: 2.0, light: Vec3::from_glam(light.normalize()) }
    }

    #[test]
    fn hand_worked_material() {
        let z = Vec3::new(0.0, 0.0, 1.0);
        // Everything along z: 0.5·0.9 + 0.25.
        assert!((phong(DVec3::Z).shade([0.5; 3], z, z)[0] - 0.7).abs() < 1e-15);
        // Light at 60°, normal along v: N·L = ½, Ĥ at 30°: N·Ĥ² = ¾.
        let light = DVec3::new(3f64.sqrt(), 0.0, 1.0);
        let got = phong(light).shade([1.0; 3], z, z)[0];
        assert!((got - (0.3 + 0.3 + 0.25 * 0.75)).abs() < 1e-15, "{got}");
    }

    #[test]
    fn the_dark_side_is_ambient_alone_and_light_from_behind_has_no_half_vector() {
        let z = Vec3::new(0.0, 0.0, 1.0);
        assert_eq!(phong(DVec3::Z).shade([1.0; 3], -z, z), [0.3; 3]);
        // L = −v: N·L > 0 only for normals facing away; Ĥ = 0 there.
        assert!((phong(-DVec3::Z).shade([1.0; 3], -z, z)[0] - 0.9).abs() < 1e-15);
    }
}
