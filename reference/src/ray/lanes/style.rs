//! Styles in lanes (Bruckner and Gröller 2007), with the normal of the previous sample on each ray.

use super::normal::shading;
use super::packet::{Packet, RAYS, Row, of_rays};
use super::sample_queue::{Batch, Packets};
use crate::field::curvature;
use crate::field::lanes::{LANES, Reader};
use crate::field::normal::Normal;
use crate::number::lanes::{columns, rows};
use crate::number::{Arithmetic, Vec3};
use crate::ray::sample::Styled;
use crate::style_transfer_functions::{contour, curvature_along_ray, frame, lanes, transparency};
use drypoint_scene::counts::Counts;
use drypoint_scene::shot::{KappaSource, SphereFrame};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, f64x8, mask64x8};

/// The styles of a function.
pub(super) struct StyleShader<'p, S: Simd> {
    simd: S,
    styled: &'p Styled<f64>,
    /// v and Δ_ray of each ray.
    sights: [Row; RAYS],
    /// v in eye space, and the smallest sample beyond `near`.
    eyes: [Row; RAYS],
    /// Rotation from the eye's frame to that of the sphere: w and the scale for each ray; none if the frames are equal.
    turns: Option<[Row; RAYS]>,
    /// From world to eye space.
    axes: [Vec3<f64x8<S>>; 3],
    previous: PreviousNormals,
}

/// The last sample of each ray for which a normal was evaluated.
struct PreviousNormals {
    /// The sample's k; NaN before the first.
    k: [f64; RAYS],
    /// N, and 1 if there is a normal, else 0.
    n: [Row; RAYS],
}

/// Colours and opacities of a batch.
pub(super) struct ShadedLanes<S: Simd> {
    /// Straight colours.
    pub(super) rgb: [f64x8<S>; 3],
    /// Opacities per reference length.
    pub(super) alpha: f64x8<S>,
    /// Δ/Δ₀.
    pub(super) ratio: f64x8<S>,
    pub(super) counted: BatchCounts,
}

/// The work of a batch, by lanes.
pub(super) struct BatchCounts {
    without_normal: u64,
    /// Lanes that also needed the gradient of the previous sample.
    before: u64,
    /// Lanes that needed the Hessian.
    hessians: u64,
    blends: lanes::Blends,
}

impl BatchCounts {
    /// Adds the work of the lanes that are shown to the counts.
    #[inline(always)]
    pub(super) fn add(&self, shown: u64, counts: &mut Counts) {
        counts.gradients += u64::from(shown.count_ones() + (shown & self.before).count_ones());
        counts.hessians += u64::from((shown & self.hessians).count_ones());
        counts.without_normal += u64::from((shown & self.without_normal).count_ones());
        counts.style_lookups += self.blends.lookups(shown);
    }
}

impl<'p, S: Simd> StyleShader<'p, S> {
    #[inline(always)]
    pub(super) fn new(simd: S, packets: &[Packet<'_, '_>], styled: &'p Styled<f64>) -> Self {
        let (mut sights, mut eyes) = ([[0.0; 4]; RAYS], [[0.0; 4]; RAYS]);
        for (i, packet) in packets.iter().enumerate() {
            sights[LANES * i..][..LANES].copy_from_slice(&packet.sights);
            eyes[LANES * i..][..LANES].copy_from_slice(&packet.eyes);
        }
        let turns = (styled.frame == SphereFrame::View).then(|| {
            eyes.map(|[x, y, z, _]| {
                let (w, scale) = frame::rotation(Vec3::new(x, y, z));
                [w.x, w.y, w.z, scale]
            })
        });
        let zero = f64x8::splat(simd, 0.0);
        let mut axes = [Vec3::new(zero, zero, zero); 3];
        for (axis, row) in axes.iter_mut().zip(styled.eye_axes.0) {
            *axis = Vec3::new(f64x8::splat(simd, row.x), f64x8::splat(simd, row.y), f64x8::splat(simd, row.z));
        }
        Self {
            simd,
            styled,
            sights,
            eyes,
            turns,
            axes,
            previous: PreviousNormals { k: [f64::NAN; RAYS], n: [[0.0; 4]; RAYS] },
        }
    }

    /// κ_v from the normals of the previous samples ([STF-5]). Remembers the normals of these samples. Returns also the
    /// lanes whose previous normal was missing.
    #[inline(always)]
    fn kappa<F: Reader<S>>(
        &mut self,
        tile: &Packets<'_, '_, S, F>,
        batch: &Batch<S>,
        v: Vec3<f64x8<S>>,
        step: f64x8<S>,
        n: Vec3<f64x8<S>>,
        has: mask64x8<S>,
    ) -> (f64x8<S>, u64) {
        let simd = self.simd;
        let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
        let asked = mask64x8::from_bitmask(simd, batch.asked);
        let before = batch.k - 1.0;
        let k: [f64; LANES] = batch.k.into();
        let own = rows([n.x, n.y, n.z, has.select(one, zero)]);
        let mut of_before = [f64x4::splat(simd, 0.0); LANES];
        let mut k_before = [f64::NAN; LANES];
        // Lanes are taken in order, because the previous sample may be in the same batch.
        for lane in 0..batch.asked.count_ones() as usize {
            let ray = usize::from(batch.rays[lane]) % RAYS;
            k_before[lane] = self.previous.k[ray];
            of_before[lane] = f64x4::simd_from(simd, self.previous.n[ray]);
            self.previous.k[ray] = k[lane];
            self.previous.n[ray] = own[lane].into();
        }
        let known = f64x8::simd_from(simd, k_before).simd_eq(before);
        let [x, y, z, has_before] = columns(of_before);
        let (mut n_before, mut has_before) = (Vec3::new(x, y, z), known & has_before.simd_eq(1.0));
        let unknown = asked & has & !known;
        let mut fetched = 0;
        if !unknown.all_false() {
            let p = tile.positions_of(&batch.rays, before, unknown.to_bitmask());
            let [_, _, _, beyond] = of_rays(simd, &self.eyes, &batch.rays);
            let asked = unknown & inside(p, tile.prepared.object.ends) & beyond.simd_le(before);
            fetched = asked.to_bitmask();
            if fetched != 0 {
                let g = tile.reader.gradients(&tile.reader.places(p), asked);
                let fetched = shading(tile.prepared, v, g);
                n_before = Vec3::select(asked, fetched.n, n_before);
                has_before |= asked & fetched.has;
            }
        }
        let both = asked & has & has_before;
        (curvature_along_ray::kappa(tile.prepared.object.turn, n, n_before, both, step), fetched)
    }

    /// Two coordinates of N in the frame of the sphere, for the look-up. N = v if there is no normal ([PREC-3]).
    #[inline(always)]
    fn on_sphere(&self, rays: &[u8; LANES], n: Vec3<f64x8<S>>, has: mask64x8<S>) -> [f64x8<S>; 2] {
        let (mut x, mut y, mut z) = (n.dot(self.axes[0]), n.dot(self.axes[1]), n.dot(self.axes[2]));
        let mut without = !has.to_bitmask() & u64::from(u8::MAX);
        while without != 0 {
            let lane = without.trailing_zeros() as usize;
            without &= without - 1;
            [x[lane], y[lane], z[lane], _] = self.eyes[usize::from(rays[lane]) % RAYS];
        }
        match &self.turns {
            None => [x, y],
            Some(turns) => {
                let [wx, wy, wz, scale] = of_rays(self.simd, turns, rays);
                let turned = frame::turned(Vec3::new(x, y, z), Vec3::new(wx, wy, wz), scale);
                [turned.x, turned.y]
            }
        }
    }

    /// Shades the samples of a batch. The other lanes hold arbitrary numbers.
    #[inline(always)]
    pub(super) fn show<F: Reader<S>>(&mut self, tile: &Packets<'_, '_, S, F>, batch: &Batch<S>) -> ShadedLanes<S> {
        let (prepared, styled, place) = (tile.prepared, self.styled, &batch.place);
        let (zero, one) = (f64x8::splat(self.simd, 0.0), f64x8::splat(self.simd, 1.0));
        let asked = mask64x8::from_bitmask(self.simd, batch.asked);
        let [x, y, z, step] = of_rays(self.simd, &self.sights, &batch.rays);
        let v = Vec3::new(x, y, z);
        let exact = styled.contour.is_some() && prepared.object.query.kappa == KappaSource::Exact;
        let mut seconds = None;
        let g = if exact && prepared.object.field.has_one_gradient() {
            seconds.insert(tile.reader.seconds(&batch.at, asked)).0
        } else {
            tile.reader.gradients(&batch.at, asked)
        };
        let Normal { n, has, length } = shading(prepared, v, g);
        let magnitude = match prepared.object.gradient_range {
            Some((lo, width)) if width > 0.0 => ((length - lo) / width).clamp_01(),
            _ => zero,
        };
        let [mut x, mut y] = self.on_sphere(&batch.rays, n, has);
        let n_dot_v = has.select(Arithmetic::abs(n.dot(v)), one);
        let (mut tau, mut before, mut hessians) = (zero, 0, 0);
        if let Some(contour) = &styled.contour {
            let mut kappa = zero;
            if prepared.object.query.kappa == KappaSource::AlongRay {
                (kappa, before) = self.kappa(tile, batch, v, step, n, has);
            }
            if exact {
                let with_normal = asked & has;
                hessians = with_normal.to_bitmask();
                let (g, h) = match seconds {
                    Some(seconds) => seconds,
                    None => tile.reader.seconds(&batch.at, with_normal),
                };
                // The Hessian's own field may have no normal where the shading field has one.
                let own = with_normal & g.length().simd_gt(prepared.object.no_normal_below);
                kappa = own.select(curvature::along_view(g, h, v, prepared.object.outside), zero);
            }
            tau = contour.tau(kappa, magnitude);
            // If τ = 0, nothing is pushed.
            (x, y) = contour::push(x, y, n_dot_v, (asked & has).select(tau, zero));
        }
        let blends = styled.index.blends(place, prepared.object.function.last());
        let [r, g, b, alpha_d] = styled.spheres.lookup_lanes(&blends, place, x, y);
        // Lanes without a sample count as α_u = 0, which avoids a power.
        let alpha_u = asked.select(place.alpha_u, zero);
        let share = transparency::share(styled.transparency, alpha_u, n_dot_v, tau, magnitude);
        let counted = BatchCounts { without_normal: !has.to_bitmask(), before, hessians, blends };
        let ratio = step / prepared.object.reference_length;
        let opaque = alpha_d.simd_eq(1.0) | !asked;
        if opaque.all_true() {
            return ShadedLanes { rgb: [r, g, b], alpha: share, ratio, counted };
        }
        let clear = alpha_d.simd_eq(0.0);
        let mut rgb = [r, g, b];
        for c in &mut rgb {
            *c = clear.select(zero, *c / alpha_d);
        }
        ShadedLanes { rgb, alpha: clear.select(zero, alpha_d * share), ratio, counted }
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
