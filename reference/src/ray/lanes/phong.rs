//! Regular functions in lanes: colours as they are, and Blinn–Phong ([STF-11]).

use super::normal::Normals;
use super::walk::{Sample, Show, Walk};
use super::{IN_ORDER, Packet, of_rays, vector};
use crate::field::lanes::Reader;
use crate::number::{Arithmetic, Elementary, Vec3};
use crate::shading::{Exponent, Phong};
use drypoint_scene::counts::Counts;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask64x8};

/// The colours of the function.
pub(super) struct Unshaded<'p> {
    pub(super) colors: &'p [[f64; 3]],
}

impl<S: Simd> Show<S> for Unshaded<'_> {
    #[inline(always)]
    fn show<F: Reader<S>>(
        &mut self,
        _: &Walk<'_, '_, S, F>,
        sample: &Sample<S>,
        _: &mut Counts,
    ) -> ([f64x8<S>; 3], f64x8<S>) {
        (sample.place.color(self.colors), sample.place.alpha_u)
    }
}

/// The same, shaded.
pub(super) struct Shaded<'p, S: Simd> {
    simd: S,
    colors: &'p [[f64; 3]],
    phong: &'p Phong<f64>,
    v: Vec3<f64x8<S>>,
    half: Vec3<f64x8<S>>,
    light: Vec3<f64x8<S>>,
}

impl<'p, S: Simd> Shaded<'p, S> {
    #[inline(always)]
    pub(super) fn new(simd: S, packet: &Packet<'_, '_>, colors: &'p [[f64; 3]], phong: &'p Phong<f64>) -> Self {
        let Vec3 { x, y, z } = phong.light;
        let light = Vec3::new(f64x8::splat(simd, x), f64x8::splat(simd, y), f64x8::splat(simd, z));
        let [v_x, v_y, v_z, _] = of_rays(simd, &packet.sights, &IN_ORDER);
        Self { simd, colors, phong, v: Vec3::new(v_x, v_y, v_z), half: vector(simd, packet.half), light }
    }

    /// [`Phong::shade`] where there is a normal.
    #[inline(always)]
    fn shade(&self, c_u: [f64x8<S>; 3], n: Vec3<f64x8<S>>, has: mask64x8<S>) -> [f64x8<S>; 3] {
        let phong = self.phong;
        let n_l = n.dot(self.light);
        let dark = n_l.simd_le(0.0);
        let n_h = n.dot(self.half);
        let n_h = n_h.simd_lt(0.0).select(f64x8::splat(self.simd, 0.0), n_h);
        let power = match phong.shininess {
            Exponent::Whole(s) => n_h.pow_whole(s),
            Exponent::Other(s) => n_h.pow(s),
        };
        let (diffuse, specular) = (n_l * phong.diffuse + phong.ambient, power * phong.specular);
        let mut rgb = c_u;
        for c in &mut rgb {
            *c = has.select(dark.select(*c * phong.ambient, *c * diffuse + specular), *c);
        }
        rgb
    }
}

impl<S: Simd> Show<S> for Shaded<'_, S> {
    #[inline(always)]
    fn show<F: Reader<S>>(
        &mut self,
        walk: &Walk<'_, '_, S, F>,
        sample: &Sample<S>,
        counts: &mut Counts,
    ) -> ([f64x8<S>; 3], f64x8<S>) {
        let place = &sample.place;
        let rgb = place.color(self.colors);
        let g = walk.reader.gradients(&walk.places(sample.k), sample.seen);
        counts.gradients += u64::from(place.visible.count_ones());
        let Normals { n, has, .. } = Normals::new(walk.prepared, self.v, g);
        counts.without_normal += u64::from((place.visible & !has.to_bitmask()).count_ones());
        (self.shade(rgb, n, has), place.alpha_u)
    }
}
