//! Regular functions in lanes: unshaded colours, and Blinn–Phong ([STF-11]).

use super::normal::shading;
use super::packet::{IN_ORDER, Packet, of_rays, vector};
use super::ray_lanes::{LaneSamples, RayLanes, ShadeLanes};
use crate::field::lanes::Reader;
use crate::field::normal::Normal;
use crate::number::Vec3;
use crate::shading::Phong;
use drypoint_scene::counts::Counts;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8};

/// The colours of the function.
pub(super) struct FlatShader<'p> {
    pub(super) colors: &'p [[f64; 3]],
}

impl<S: Simd> ShadeLanes<S> for FlatShader<'_> {
    #[inline(always)]
    fn show<F: Reader<S>>(
        &mut self,
        _: &RayLanes<'_, '_, S, F>,
        sample: &LaneSamples<S>,
        _: &mut Counts,
    ) -> ([f64x8<S>; 3], f64x8<S>) {
        (sample.place.color(self.colors), sample.place.alpha_u)
    }
}

/// The colours of the function under Blinn–Phong.
pub(super) struct PhongShader<'p, S: Simd> {
    colors: &'p [[f64; 3]],
    phong: &'p Phong<f64>,
    v: Vec3<f64x8<S>>,
    half: Vec3<f64x8<S>>,
}

impl<'p, S: Simd> PhongShader<'p, S> {
    #[inline(always)]
    pub(super) fn new(simd: S, packet: &Packet<'_, '_>, colors: &'p [[f64; 3]], phong: &'p Phong<f64>) -> Self {
        let [v_x, v_y, v_z, _] = of_rays(simd, &packet.sights, &IN_ORDER);
        Self { colors, phong, v: Vec3::new(v_x, v_y, v_z), half: vector(simd, packet.half) }
    }
}

impl<S: Simd> ShadeLanes<S> for PhongShader<'_, S> {
    #[inline(always)]
    fn show<F: Reader<S>>(
        &mut self,
        walk: &RayLanes<'_, '_, S, F>,
        sample: &LaneSamples<S>,
        counts: &mut Counts,
    ) -> ([f64x8<S>; 3], f64x8<S>) {
        let place = &sample.place;
        let rgb = place.color(self.colors);
        let g = walk.reader.gradients(&walk.places(sample.k), sample.seen);
        counts.gradients += u64::from(place.visible.count_ones());
        let Normal { n, has, .. } = shading(walk.prepared, self.v, g);
        counts.without_normal += u64::from((place.visible & !has.to_bitmask()).count_ones());
        let [r, g, b] = self.phong.shade(rgb, n, self.half);
        ([has.select(r, rgb[0]), has.select(g, rgb[1]), has.select(b, rgb[2])], place.alpha_u)
    }
}
