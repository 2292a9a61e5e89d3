//! Eight rays side by side: the pictures that are asked for most, unshaded and Phong, to the same bits sooner.
//!
//! What [`cast`](super::cast) does sample by sample is done here plane by plane for neighbouring rays, in vectors of the
//! widest registers that the processor has. Each lane takes the steps of its ray alone, in their order, with +, −, ×, ÷ and √
//! only, which are the same in a vector; what branches or looks things up is done lane by lane. Rays visit the samples
//! that they would visit alone, so the counts are the same too.

mod correct;

use self::correct::correct;
use super::cast::Cast;
use super::lattice::IndexRay;
use super::layers::Sums;
use super::need::Needs;
use super::opacity::Correction;
use super::prepared::{Prepared, Side};
use super::sample::Look;
use super::skip::Boxes;
use crate::field::lanes::{LANES, LaneReader, Packed};
use crate::number::{Arithmetic, Vec3};
use crate::shading::{Exponent, Phong};
use drypoint_scene::counts::Counts;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::tables::Outside;
use drypoint_scene::volume::Voxels;
use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, f64x8, mask64x8};

/// The registers that lanes are for; none on processors without them, which cast rays one by one.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
fn wide() -> Option<impl Simd> {
    Level::new().as_avx2()
}

/// The same where there is no such processor.
#[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
fn wide() -> Option<impl Simd> {
    None::<fearless_simd::Fallback>
}

/// Whether a scene's rays can be cast in lanes.
pub(super) fn serve(prepared: &Prepared<'_, f64>) -> bool {
    let shaded = match prepared.needs {
        Needs::Value => false,
        Needs::Normal => true,
        Needs::Anything => return false,
    };
    wide().is_some()
        && prepared.layers == [LayerKind::Beauty]
        && prepared.volume.mask().is_none()
        && prepared.surface.is_none()
        && prepared.field.fits_lanes(shaded)
        && matches!(prepared.volume.voxels(), Voxels::U8(_) | Voxels::I8(_) | Voxels::U16(_) | Voxels::I16(_))
}

/// Casts the rays through points of the picture, in pixels from the top left corner, and appends what comes out of each. For
/// scenes that lanes [`serve`].
pub(super) fn cast_all(
    prepared: &Prepared<'_, f64>,
    points: &[[f64; 2]],
    mut boxes: Option<&mut Boxes>,
    counts: &mut Counts,
    casts: &mut Vec<Cast>,
) {
    let mut packet = Packet::new(prepared);
    for points in points.chunks(LANES) {
        packet.aim(points, boxes.as_deref_mut());
        match prepared.volume.voxels() {
            Voxels::U8(data) => packet.run(data, counts),
            Voxels::I8(data) => packet.run(data, counts),
            Voxels::U16(data) => packet.run(data, counts),
            Voxels::I16(data) => packet.run(data, counts),
            _ => unreachable!("lanes serve 8 and 16 bits alone"),
        }
        for lane in 0..points.len() {
            let samples = packet.samples(lane);
            counts.rays += 1;
            counts.rays_skipped += u64::from(samples == 0);
            counts.samples += samples;
            casts.push(Cast { rgba: packet.rgba.map(|c| c[lane]), sums: Sums::new(), samples });
        }
    }
}

/// Numbers of eight rays.
type Column = [f64; LANES];

/// Rays side by side and what comes out of them. Lanes without a ray visit nothing.
struct Packet<'p, 'v> {
    prepared: &'p Prepared<'v, f64>,
    origin: [Column; 3],
    along: [Column; 3],
    depth_step: Column,
    /// Δ/Δ₀.
    ratio: Column,
    v: [Column; 3],
    half: [Column; 3],
    /// What the rays have to visit, one ray after the other: first and last sample of each interval.
    visits: Vec<[i64; 2]>,
    /// Which of them are a ray's.
    of_ray: [[usize; 2]; LANES],
    /// What one ray or another has to visit, in order and without overlap. Where a ray has nothing to visit beside its
    /// neighbours it sees nothing, so it may come along.
    together: Vec<[i64; 2]>,
    /// First and last sample of each ray, and after the walk the one where it ended.
    ends: [Column; 2],
    rgba: [Column; 4],
}

impl<'p, 'v> Packet<'p, 'v> {
    fn new(prepared: &'p Prepared<'v, f64>) -> Self {
        let none = [0.0; LANES];
        Self {
            prepared,
            origin: [none; 3],
            along: [none; 3],
            depth_step: none,
            ratio: none,
            v: [none; 3],
            half: [none; 3],
            visits: Vec::new(),
            of_ray: [[0; 2]; LANES],
            together: Vec::new(),
            ends: [none; 2],
            rgba: [none; 4],
        }
    }

    /// Takes the rays through other points.
    fn aim(&mut self, points: &[[f64; 2]], mut boxes: Option<&mut Boxes>) {
        let prepared = self.prepared;
        let view = &prepared.view;
        self.visits.clear();
        self.of_ray = [[0; 2]; LANES];
        self.ends = [[f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]];
        self.rgba = [[0.0; LANES]; 4];
        for (lane, &[i, j]) in points.iter().enumerate() {
            let pixel = view.ray(i, j);
            let ray = IndexRay::<f64>::new(&pixel, view, &prepared.lattice, prepared.volume.grid());
            let first = self.visits.len();
            self.visits.extend(ray.visits(prepared.ends, boxes.as_deref_mut()));
            self.of_ray[lane] = [first, self.visits.len()];
            let (Some([nearest, _]), Some([_, farthest])) = (self.visits.get(first), self.visits.last()) else {
                continue;
            };
            self.ends[0][lane] = *nearest as f64;
            self.ends[1][lane] = *farthest as f64;
            let sight =
                prepared.look.sight(Vec3::from_glam(view.direction_to_world(pixel.v)), Vec3::from_glam(pixel.v));
            put(&mut self.origin, lane, ray.origin);
            put(&mut self.along, lane, ray.along);
            put(&mut self.v, lane, sight.v);
            put(&mut self.half, lane, sight.half);
            self.depth_step[lane] = ray.depth_step;
            self.ratio[lane] = ray.step / prepared.reference_length;
        }
        self.together.clear();
        self.together.extend_from_slice(&self.visits);
        join(&mut self.together);
    }

    /// The samples that a ray visited.
    fn samples(&self, lane: usize) -> u64 {
        let [first, end] = self.of_ray[lane];
        let last = self.ends[1][lane] as i64;
        self.visits[first..end].iter().map(|v| (v[1].min(last) + 1 - v[0]).max(0) as u64).sum()
    }

    fn run<V: Packed>(&mut self, data: &[V], counts: &mut Counts) {
        if let (false, Some(simd)) = (self.visits.is_empty(), wide()) {
            simd.vectorize(
                #[inline(always)]
                || self.walk(simd, data, counts),
            );
        }
    }

    #[inline(always)]
    fn walk<S: Simd, V: Packed>(&mut self, simd: S, data: &[V], counts: &mut Counts) {
        let Look::Regular { colors, phong } = &self.prepared.look else { return };
        let walk = Walk::new(simd, self, data, colors);
        match (self.prepared.needs, phong) {
            (Needs::Normal, Some(phong)) => {
                let shade = Shade::new(simd, self, phong);
                walk.run(self, Some(&shade), counts);
            }
            _ => walk.run(self, None, counts),
        }
    }
}

/// Sorts ranges and joins those that meet.
fn join(ranges: &mut Vec<[i64; 2]>) {
    ranges.sort_unstable();
    let mut kept = 0;
    for i in 1..ranges.len() {
        if ranges[i][0] <= ranges[kept][1] + 1 {
            ranges[kept][1] = ranges[kept][1].max(ranges[i][1]);
        } else {
            kept += 1;
            ranges[kept] = ranges[i];
        }
    }
    ranges.truncate(kept + 1);
}

fn put(columns: &mut [Column; 3], lane: usize, v: Vec3<f64>) {
    columns[0][lane] = v.x;
    columns[1][lane] = v.y;
    columns[2][lane] = v.z;
}

#[inline(always)]
fn vector<S: Simd>(simd: S, [x, y, z]: [Column; 3]) -> Vec3<f64x8<S>> {
    Vec3::new(x.simd_into(simd), y.simd_into(simd), z.simd_into(simd))
}

/// Eight rays on their way.
struct Walk<'p, 'v, S: Simd, V> {
    simd: S,
    prepared: &'p Prepared<'v, f64>,
    reader: LaneReader<'p, 'v, S, V>,
    colors: &'p [[f64; 3]],
    origin: Vec3<f64x8<S>>,
    along: Vec3<f64x8<S>>,
    depth_step: f64x8<S>,
    ratio: f64x8<S>,
}

/// What has come together on the rays.
#[derive(Clone, Copy)]
struct Light<S: Simd> {
    rgb: [f64x8<S>; 3],
    opacity: f64x8<S>,
    /// The last opacities that were corrected, and what they became: levels of a function repeat along a ray.
    corrected: [f64x8<S>; 2],
}

impl<S: Simd> Light<S> {
    /// Corrects the opacities of the lanes `fresh`: together, or alone where they are few.
    #[inline(always)]
    fn correct(&mut self, fresh: u64, alpha: f64x8<S>, ratio: f64x8<S>) {
        let lanes = mask64x8::from_bitmask(alpha.simd, fresh);
        if fresh.count_ones() > 2 {
            self.corrected[1] = lanes.select(correct(alpha, ratio), self.corrected[1]);
        } else {
            let mut left = fresh;
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                left &= left - 1;
                self.corrected[1][lane] = Correction::new(ratio[lane]).apply(alpha[lane]);
            }
        }
        self.corrected[0] = lanes.select(alpha, self.corrected[0]);
    }
}

impl<'p, 'v, S: Simd, V: Packed> Walk<'p, 'v, S, V> {
    #[inline(always)]
    fn new(simd: S, packet: &Packet<'p, 'v>, data: &'p [V], colors: &'p [[f64; 3]]) -> Self {
        Self {
            simd,
            prepared: packet.prepared,
            reader: LaneReader::new(simd, &packet.prepared.field, data),
            colors,
            origin: vector(simd, packet.origin),
            along: vector(simd, packet.along),
            depth_step: packet.depth_step.simd_into(simd),
            ratio: packet.ratio.simd_into(simd),
        }
    }

    /// Visits all samples, the nearest plane first.
    #[inline(always)]
    fn run(&self, packet: &mut Packet<'_, '_>, shade: Option<&Shade<'_, S>>, counts: &mut Counts) {
        let zero = f64x8::splat(self.simd, 0.0);
        let mut light = Light { rgb: [zero; 3], opacity: zero, corrected: [zero; 2] };
        let nearest: f64x8<S> = packet.ends[0].simd_into(self.simd);
        let mut farthest: f64x8<S> = packet.ends[1].simd_into(self.simd);
        'rays: for &[first, last] in &packet.together {
            for k in first..=last {
                let k = k as f64;
                let open = farthest.simd_ge(k);
                if open.all_false() {
                    break 'rays;
                }
                let stopped = self.visit(k, open & nearest.simd_le(k), shade, &mut light, counts);
                farthest = stopped.select(f64x8::splat(self.simd, k), farthest);
            }
        }
        packet.ends[1] = farthest.into();
        let [r, g, b] = light.rgb;
        packet.rgba = [r.into(), g.into(), b.into(), light.opacity.into()];
    }

    /// Visits sample k of the active lanes. Returns the lanes whose ray ends there.
    #[inline(always)]
    fn visit(
        &self,
        k: f64,
        active: mask64x8<S>,
        shade: Option<&Shade<'_, S>>,
        light: &mut Light<S>,
        counts: &mut Counts,
    ) -> mask64x8<S> {
        let simd = self.simd;
        let none = mask64x8::splat(simd, false);
        let depth = self.depth_step * (k + 0.5);
        let at = self.reader.places(self.origin + self.along * depth, active);
        let values = self.reader.values(&at);
        let Some(place) = self.prepared.function.locate_lanes(values, active.to_bitmask(), self.colors) else {
            return none;
        };
        let seen = mask64x8::from_bitmask(simd, place.visible);
        let mut rgb = place.color;
        if let Some(shade) = shade {
            let g = self.reader.gradients(&at, seen);
            counts.gradients += u64::from(place.visible.count_ones());
            let (n, has) = shade.normal(g, self.prepared);
            counts.without_normal += u64::from((place.visible & !has.to_bitmask()).count_ones());
            rgb = shade.color(rgb, n, has);
        }
        let fresh = (seen & place.alpha_u.simd_ne(light.corrected[0])).to_bitmask();
        if fresh != 0 {
            light.correct(fresh, place.alpha_u, self.ratio);
        }
        let w = (f64x8::splat(simd, 1.0) - light.opacity) * light.corrected[1];
        for (sum, c) in light.rgb.iter_mut().zip(rgb) {
            *sum = seen.select(*sum + w * c, *sum);
        }
        light.opacity = seen.select(light.opacity + w, light.opacity);
        seen & light.opacity.simd_ge(self.prepared.stop_at)
    }
}

/// Phong in lanes.
struct Shade<'p, S: Simd> {
    simd: S,
    phong: &'p Phong<f64>,
    v: Vec3<f64x8<S>>,
    half: Vec3<f64x8<S>>,
    light: Vec3<f64x8<S>>,
}

impl<'p, S: Simd> Shade<'p, S> {
    #[inline(always)]
    fn new(simd: S, packet: &Packet<'_, '_>, phong: &'p Phong<f64>) -> Self {
        let Vec3 { x, y, z } = phong.light;
        let light = Vec3::new(f64x8::splat(simd, x), f64x8::splat(simd, y), f64x8::splat(simd, z));
        Self { simd, phong, v: vector(simd, packet.v), half: vector(simd, packet.half), light }
    }

    /// [`outward`](crate::field::normal::outward) and [`Side::turn`], and the lanes that have a normal.
    #[inline(always)]
    fn normal(&self, g: Vec3<f64x8<S>>, prepared: &Prepared<'_, f64>) -> (Vec3<f64x8<S>>, mask64x8<S>) {
        let one = f64x8::splat(self.simd, 1.0);
        let length = g.dot(g).sqrt();
        let scale = one / length;
        let outward = g * match prepared.outside {
            Outside::Low => -scale,
            Outside::High => scale,
        };
        let turned = match prepared.side {
            Side::Outward => outward,
            Side::Facing => outward * outward.dot(self.v).simd_lt(0.0).select(-one, one),
            Side::Inward => outward * -one,
        };
        (turned, length.simd_gt(prepared.no_normal_below))
    }

    /// [`Phong::shade`] where there is a normal.
    #[inline(always)]
    fn color(&self, c_u: [f64x8<S>; 3], n: Vec3<f64x8<S>>, has: mask64x8<S>) -> [f64x8<S>; 3] {
        let phong = self.phong;
        let n_l = n.dot(self.light);
        let dark = n_l.simd_le(0.0);
        let n_h = n.dot(self.half);
        let n_h = n_h.simd_lt(0.0).select(f64x8::splat(self.simd, 0.0), n_h);
        let power = match phong.shininess {
            Exponent::Whole(s) => pow_whole(f64x8::splat(self.simd, 1.0), n_h, s),
            Exponent::Other(s) => f64x8::from_fn(self.simd, |lane| crate::number::Real::pow(n_h[lane], s)),
        };
        let (diffuse, specular) = (n_l * phong.diffuse + phong.ambient, power * phong.specular);
        let mut rgb = c_u;
        for c in &mut rgb {
            *c = has.select(dark.select(*c * phong.ambient, *c * diffuse + specular), *c);
        }
        rgb
    }
}

/// [`Real::pow_whole`](crate::number::Real::pow_whole).
#[inline(always)]
fn pow_whole<A: Arithmetic>(one: A, x: A, mut n: u32) -> A {
    let (mut result, mut square) = (one, x);
    while n > 0 {
        if n & 1 == 1 {
            result = result * square;
        }
        square = square * square;
        n >>= 1;
    }
    result
}
