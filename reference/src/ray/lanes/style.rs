//! Styles in lanes (Bruckner and Gröller 2007), with what a sample has to know of the one before it on its ray.

use super::normal::Normals;
use super::walk::{Sample, Show, Walk};
use super::{Packet, vector};
use crate::field::lanes::{LANES, Packed};
use crate::number::Vec3;
use crate::number::lanes::select;
use crate::ray::prepared::KappaSource;
use crate::ray::sample::Styled;
use crate::style_transfer_functions::{frame, lanes};
use drypoint_scene::counts::Counts;
use drypoint_scene::tables::SphereFrame;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask64x8};

/// The styles of a function.
pub(super) struct InStyle<'p, S: Simd> {
    simd: S,
    styled: &'p Styled<f64>,
    v: Vec3<f64x8<S>>,
    v_eye: Vec3<f64x8<S>>,
    /// From the eye's frame to that of the sphere; none where they are one.
    turn: Option<(Vec3<f64x8<S>>, f64x8<S>)>,
    /// From world to eye space.
    axes: [Vec3<f64x8<S>>; 3],
    /// Δ_ray.
    step: f64x8<S>,
    /// The smallest sample beyond `near`.
    beyond: f64x8<S>,
    previous: Previous<S>,
}

/// The last samples that were asked for a normal.
struct Previous<S: Simd> {
    /// Which ones; NaN where there was none.
    k: f64x8<S>,
    n: Vec3<f64x8<S>>,
    /// Lanes whose sample has a normal.
    has: mask64x8<S>,
}

impl<'p, S: Simd> InStyle<'p, S> {
    #[inline(always)]
    pub(super) fn new(simd: S, packet: &Packet<'_, '_>, styled: &'p Styled<f64>) -> Self {
        let zero = f64x8::splat(simd, 0.0);
        let turn = match styled.frame {
            SphereFrame::Eye => None,
            SphereFrame::View => {
                let (mut w, mut scale) = ([[0.0; LANES]; 3], [0.0; LANES]);
                let [x, y, z] = packet.v_eye;
                for lane in 0..LANES {
                    let (axis, s) = frame::rotation(Vec3::new(x[lane], y[lane], z[lane]));
                    (w[0][lane], w[1][lane], w[2][lane], scale[lane]) = (axis.x, axis.y, axis.z, s);
                }
                Some((vector(simd, w), scale.simd_into(simd)))
            }
        };
        let mut axes = [Vec3::new(zero, zero, zero); 3];
        for (axis, row) in axes.iter_mut().zip(styled.eye_axes.0) {
            *axis = Vec3::new(f64x8::splat(simd, row.x), f64x8::splat(simd, row.y), f64x8::splat(simd, row.z));
        }
        Self {
            simd,
            styled,
            v: vector(simd, packet.v),
            v_eye: vector(simd, packet.v_eye),
            turn,
            axes,
            step: packet.step.simd_into(simd),
            beyond: packet.beyond.simd_into(simd),
            previous: Previous {
                k: f64x8::splat(simd, f64::NAN),
                n: Vec3::new(zero, zero, zero),
                has: mask64x8::splat(simd, false),
            },
        }
    }

    /// κ_v from the normals of the samples before ([STF-5]), and remembers these.
    #[inline(always)]
    fn kappa<V: Packed>(
        &mut self,
        walk: &Walk<'_, '_, S, V>,
        sample: &Sample<S>,
        n: Vec3<f64x8<S>>,
        has: mask64x8<S>,
        counts: &mut Counts,
    ) -> f64x8<S> {
        let before = sample.k - 1.0;
        let known = self.previous.k.simd_eq(before);
        let (mut n_before, mut has_before) = (self.previous.n, known & self.previous.has);
        let unknown = sample.seen & has & !known;
        if !unknown.all_false() {
            let p = walk.positions(before);
            let asked = unknown & inside(p, walk.prepared.ends) & self.beyond.simd_le(before);
            let number = asked.to_bitmask().count_ones();
            if number > 0 {
                let g = walk.reader.gradients(&walk.reader.places(p, asked), asked);
                counts.gradients += u64::from(number);
                let fetched = Normals::new(walk.prepared, self.v, g);
                n_before = select(asked, fetched.n, n_before);
                has_before |= asked & fetched.has;
            }
        }
        let both = (sample.seen & has & has_before).to_bitmask();
        let kappa = lanes::kappa(walk.prepared.turn, n, n_before, both, self.step);
        let seen = sample.seen;
        self.previous.k = seen.select(f64x8::splat(self.simd, sample.k), self.previous.k);
        self.previous.n = select(seen, n, self.previous.n);
        self.previous.has = (seen & has) | (!seen & self.previous.has);
        kappa
    }

    /// N in the frame of the sphere, of which two coordinates are looked up; N = v where there is none ([PREC-3]).
    #[inline(always)]
    fn on_sphere(&self, n: Vec3<f64x8<S>>, has: mask64x8<S>) -> [f64x8<S>; 2] {
        let x = has.select(n.dot(self.axes[0]), self.v_eye.x);
        let y = has.select(n.dot(self.axes[1]), self.v_eye.y);
        match self.turn {
            None => [x, y],
            Some((w, scale)) => {
                let z = has.select(n.dot(self.axes[2]), self.v_eye.z);
                let turned = frame::turned(Vec3::new(x, y, z), w, scale);
                [turned.x, turned.y]
            }
        }
    }
}

/// Whether positions lie in a closed box.
#[inline(always)]
fn inside<S: Simd>(p: Vec3<f64x8<S>>, [lo, hi]: [Vec3<f64>; 2]) -> mask64x8<S> {
    p.x.simd_ge(lo.x)
        & p.x.simd_le(hi.x)
        & p.y.simd_ge(lo.y)
        & p.y.simd_le(hi.y)
        & p.z.simd_ge(lo.z)
        & p.z.simd_le(hi.z)
}

impl<S: Simd> Show<S> for InStyle<'_, S> {
    #[inline(always)]
    fn show<V: Packed>(
        &mut self,
        walk: &Walk<'_, '_, S, V>,
        sample: &Sample<S>,
        counts: &mut Counts,
    ) -> ([f64x8<S>; 3], f64x8<S>) {
        let (prepared, styled, place) = (walk.prepared, self.styled, &sample.place);
        let (zero, one) = (f64x8::splat(self.simd, 0.0), f64x8::splat(self.simd, 1.0));
        let g = walk.reader.gradients(&sample.at, sample.seen);
        counts.gradients += u64::from(place.visible.count_ones());
        let Normals { n, has, length } = Normals::new(prepared, self.v, g);
        counts.without_normal += u64::from((place.visible & !has.to_bitmask()).count_ones());
        let magnitude = match prepared.gradient_range {
            Some((lo, width)) if width > 0.0 => lanes::clamp_01((length - lo) / width),
            _ => zero,
        };
        let [mut x, mut y] = self.on_sphere(n, has);
        let n_dot_v = has.select(n.dot(self.v).abs(), one);
        let mut tau = zero;
        if let Some(contour) = &styled.contour {
            let kappa = match prepared.calls.kappa {
                KappaSource::AlongRay => self.kappa(walk, sample, n, has, counts),
                _ => zero,
            };
            tau = contour.tau_lanes(kappa, magnitude);
            [x, y] = lanes::push([x, y], n_dot_v, tau, sample.seen & has);
        }
        let blends = styled.index.blends(place);
        counts.style_lookups += blends.lookups(place.visible);
        let [r, g, b, alpha_d] = styled.spheres.lookup_lanes(&blends, place, x, y);
        let share = lanes::share(styled.transparency, place, n_dot_v, tau, magnitude);
        let opaque = alpha_d.simd_eq(1.0) | !sample.seen;
        if opaque.all_true() {
            return ([r, g, b], share);
        }
        let clear = alpha_d.simd_eq(0.0);
        let mut rgb = [r, g, b];
        for c in &mut rgb {
            *c = clear.select(zero, *c / alpha_d);
        }
        (rgb, clear.select(zero, alpha_d * share))
    }
}
