//! Eight rays side by side, for the most common pictures: unshaded, Phong and styles. The bits are the same.
//!
//! Neighbouring rays take the samples of [`ray_order`](super::composite::ray_order) plane by plane, in vectors of the
//! widest registers of the processor. Each lane takes the operations of its ray alone, in their order, with +, −, ×, ÷
//! and √ only, which are the same in a vector. Branches and table look-ups are done lane by lane. Rays visit the
//! samples that they would visit alone, so the counts are the same too.
//!
//! A ray also passes through bricks in which only its neighbours can see something. It sees nothing there, and the
//! counts leave these samples out. A kernel of 64 voxels is as fast for one position as for eight, with four voxels of
//! a row in one register. It is therefore evaluated lane by lane, through a trait object, so that the loops are
//! compiled once for all such kernels. With such a kernel styles gain from lanes. Regular functions do not, and are
//! cast ray by ray.
//!
//! Lanes that are set one by one are put into an array of their own. A vector that is indexed does not stay in
//! registers, nor do the other fields of its variable.

mod intervals;
mod normal;
mod phong;
mod ray_lanes;
mod rays;
mod sample_queue;
mod style;

use self::phong::{FlatShader, PhongShader};
use self::ray_lanes::{Asked, RayLanes};
use self::rays::Rays;
use self::sample_queue::cast_waiting;
use super::brick_occupancy::{RayIntervals, merge};
use super::composite::Cast;
use super::lattice::IndexRay;
use super::prepared::Prepared;
use super::sample::SampleShader;
use super::sample::need::Needs;
use super::tile_work::TileWork;
use crate::field::AnySampler;
use crate::field::lanes::{EachReader, LANES, LaneReader, Packed};
use crate::number::Vec3;
use crate::number::lanes::{columns, rows, wide};
use bytemuck::cast_slice;
use drypoint_scene::counts::Counts;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::{KappaSource, SampleQuery};
use drypoint_scene::volume::Voxels;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, f64x8};

/// Whether a scene's rays can be cast in lanes.
pub(super) fn serve(prepared: &Prepared<'_, f64>) -> bool {
    let shaded = match prepared.object.needs {
        Needs::Value => false,
        Needs::Normal => true,
        Needs::Anything if is_in_style(prepared) => true,
        Needs::Anything => return false,
    };
    wide().is_some()
        && prepared.layers == [LayerKind::Beauty]
        && prepared.object.volume.mask().is_none()
        && prepared.surface.is_none()
        && prepared.meshes.is_none()
        && prepared.object.field.fits_lanes(shaded, matches!(prepared.object.shader, SampleShader::Style(_)))
}

/// Whether a scene is one of styles over the value, without mip-maps.
fn is_in_style(prepared: &Prepared<'_, f64>) -> bool {
    let query = SampleQuery { kappa: KappaSource::None, hessian: false, ..prepared.object.query };
    matches!(&prepared.object.shader, SampleShader::Style(styled) if styled.detail.is_none())
        && query == SampleQuery::NORMAL
        && prepared.object.query.hessian == (prepared.object.query.kappa == KappaSource::Exact)
        && prepared.object.first.is_none()
        && prepared.object.over_two.is_none()
        && prepared.object.table.is_none()
        && !prepared.encode
}

/// Casts the rays of a tile, for scenes that lanes [`serve`].
pub(super) fn cast_all(prepared: &Prepared<'_, f64>, work: TileWork<'_>) {
    let TileWork { points, boxes, counts, casts, .. } = work;
    if boxes.as_ref().is_some_and(|boxes| boxes.is_empty()) {
        counts.rays += points.len() as u64;
        counts.rays_skipped += points.len() as u64;
        casts.extend(points.iter().map(|_| Cast::of_samples([0.0; 4], 0)));
        return;
    }
    let inside = boxes.as_ref().is_some_and(|boxes| boxes.are_inside(prepared.object.ends.map(Vec3::to_glam)));
    let boxes = boxes.as_deref().map(|boxes| (boxes, inside));
    let mut intervals = Default::default();
    let sampler = prepared.object.field.sampler();
    let dear = !matches!(sampler, AnySampler::Trilinear(_));
    let at_once = if matches!(prepared.object.shader, SampleShader::Style(_)) { RAYS } else { LANES };
    let mut packets = Vec::with_capacity(at_once / LANES);
    packets.resize_with(at_once.min(points.len()).div_ceil(LANES), || Packet::new(prepared));
    for points in points.chunks(at_once) {
        let packets = &mut packets[..points.len().div_ceil(LANES)];
        if let Some(simd) = wide() {
            simd.vectorize(
                #[inline(always)]
                || {
                    for (packet, points) in packets.iter_mut().zip(points.chunks(LANES)) {
                        packet.aim(simd, points, boxes, &mut intervals);
                    }
                },
            );
        }
        match &sampler {
            AnySampler::Trilinear(_) => match prepared.object.volume.voxels() {
                Voxels::U8(data) => run(prepared, packets, (data, false), counts),
                Voxels::I8(data) => run::<u8>(prepared, packets, (cast_slice(data), true), counts),
                Voxels::U16(data) => run(prepared, packets, (data, false), counts),
                Voxels::I16(data) => run::<u16>(prepared, packets, (cast_slice(data), true), counts),
                _ => unreachable!("lanes serve trilinear numbers of 8 and 16 bits alone"),
            },
            AnySampler::Any(_) => run_each(prepared, packets, counts),
        }
        for (packet, points) in packets.iter().zip(points.chunks(LANES)) {
            for lane in 0..points.len() {
                let samples = packet.samples(lane, dear);
                counts.rays += 1;
                counts.rays_skipped += u64::from(samples == 0);
                counts.samples += samples;
                casts.push(Cast::of_samples(packet.rgba[lane], samples));
            }
        }
    }
}

/// Casts the rays of packets through integers of 8 or 16 bits. `is_signed` tells whether they have a sign. Each shader
/// is compiled in a function of its own, because the compiler's time grows faster than the size of a function.
fn run<V: Packed>(
    prepared: &Prepared<'_, f64>,
    packets: &mut [Packet<'_, '_>],
    (data, is_signed): (&[V], bool),
    counts: &mut Counts,
) {
    let (true, Some(simd)) = (packets.iter().any(|packet| !packet.visits.is_empty()), wide()) else { return };
    let field = &prepared.object.field;
    match &prepared.object.shader {
        SampleShader::Style(styled) => simd.vectorize(
            #[inline(always)]
            || cast_waiting(simd, packets, styled, LaneReader::new(simd, field, data, is_signed), counts),
        ),
        SampleShader::Regular { colors, phong: Some(phong) } if prepared.object.needs == Needs::Normal => simd
            .vectorize(
                #[inline(always)]
                || {
                    let reader = LaneReader::new(simd, field, data, is_signed);
                    for packet in packets {
                        let mut shader = PhongShader::new(simd, packet, colors, phong);
                        RayLanes::new(simd, packet, reader).run(packet, &mut shader, counts);
                    }
                },
            ),
        SampleShader::Regular { colors, .. } => simd.vectorize(
            #[inline(always)]
            || {
                let reader = LaneReader::new(simd, field, data, is_signed);
                for packet in packets {
                    RayLanes::new(simd, packet, reader).run(packet, &mut FlatShader { colors }, counts);
                }
            },
        ),
        SampleShader::Illustrated(_) => unreachable!("lanes serve regular functions and styles alone"),
    }
}

/// Casts the rays of packets in styles through a field that is evaluated one position at a time.
fn run_each(prepared: &Prepared<'_, f64>, packets: &mut [Packet<'_, '_>], counts: &mut Counts) {
    let SampleShader::Style(styled) = &prepared.object.shader else {
        unreachable!("lanes serve dear kernels in styles alone")
    };
    if let (true, Some(simd)) = (packets.iter().any(|packet| !packet.visits.is_empty()), wide()) {
        simd.vectorize(
            #[inline(always)]
            || cast_waiting(simd, packets, styled, EachReader::new(simd, &prepared.object.field), counts),
        );
    }
}

/// Numbers of eight rays.
type Column = [f64; LANES];
/// Four numbers of one ray.
type Row = [f64; 4];
/// Depths at which each of eight rays is in a visible brick.
type Intervals = [Vec<[f64; 2]>; LANES];

/// Number of rays whose samples wait for each other: those of a tile.
const RAYS: usize = 8 * LANES;

/// Rays side by side and their results. Lanes without a ray visit nothing.
struct Packet<'p, 'v> {
    prepared: &'p Prepared<'v, f64>,
    origin: [Column; 3],
    along: [Column; 3],
    depth_step: Column,
    /// Δ_ray.
    step: Column,
    /// The smallest sample beyond `near`.
    first: i64,
    /// v and Δ_ray of each ray.
    sights: [Row; LANES],
    /// v in eye space, and the smallest sample beyond `near`.
    eyes: [Row; LANES],
    half: [Column; 3],
    /// The visits of the rays, one ray after the other: first and last sample of each interval.
    visits: Vec<[i64; 2]>,
    /// The range of each ray's visits among them.
    of_ray: [[usize; 2]; LANES],
    /// The union of all visits, in order and without overlap. A ray sees nothing between its own visits, so it may
    /// follow those of its neighbours.
    together: Vec<[i64; 2]>,
    /// First and last sample of each ray. After the traversal the last one is where the ray ended.
    ends: [Column; 2],
    /// The planes and lanes for which values were computed, if values are expensive.
    asked: Vec<Asked>,
    rgba: [[f64; 4]; LANES],
}

impl<'p, 'v> Packet<'p, 'v> {
    fn new(prepared: &'p Prepared<'v, f64>) -> Self {
        let none = [0.0; LANES];
        Self {
            prepared,
            origin: [none; 3],
            along: [none; 3],
            depth_step: none,
            step: none,
            first: prepared.lattice.first(&prepared.view),
            sights: [[0.0; 4]; LANES],
            eyes: [[0.0; 4]; LANES],
            half: [none; 3],
            visits: Vec::with_capacity(4 * LANES),
            of_ray: [[0; 2]; LANES],
            together: Vec::with_capacity(4 * LANES),
            ends: [none; 2],
            asked: Vec::new(),
            rgba: [[0.0; 4]; LANES],
        }
    }

    /// Takes the rays through other points, with the boxes of visible bricks. The flag tells whether all boxes lie more
    /// than half a voxel inside the volume.
    #[inline(always)]
    fn aim<S: Simd>(
        &mut self,
        simd: S,
        points: &[[f64; 2]],
        boxes: Option<(&RayIntervals, bool)>,
        intervals: &mut Intervals,
    ) {
        let prepared = self.prepared;
        self.visits.clear();
        self.asked.clear();
        self.of_ray = [[0; 2]; LANES];
        self.ends = [[f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]];
        self.rgba = [[0.0; 4]; LANES];
        let rays = Rays::through(simd, prepared, points);
        (self.origin, self.along) = (stored(rays.origin), stored(rays.along));
        (self.depth_step, self.step, self.half) = (rays.depth_step.into(), rays.step.into(), stored(rays.half));
        let first = f64x8::splat(simd, self.first as f64);
        let sights = rows([rays.v.x, rays.v.y, rays.v.z, rays.step]);
        let eyes = rows([rays.v_eye.x, rays.v_eye.y, rays.v_eye.z, first]);
        for lane in 0..LANES {
            (self.sights[lane], self.eyes[lane]) = (sights[lane].into(), eyes[lane].into());
        }
        if let Some((boxes, _)) = boxes {
            intervals::intervals(simd, boxes, &rays, points.len(), intervals);
        }
        for (lane, intervals) in intervals.iter_mut().enumerate().take(points.len()) {
            let (ray, clip) = (self.ray(lane), &prepared.object.clip.planes);
            let before = self.visits.len();
            match boxes {
                None => self.visits.extend(ray.visits(prepared.object.ends, clip, None)),
                Some(_) if intervals.is_empty() => continue,
                Some((_, inside)) => {
                    merge(intervals);
                    let inside = if inside { ray.all_beyond_near() } else { None };
                    let range = inside.filter(|_| clip.is_empty());
                    let ends = prepared.object.ends;
                    let range = range.unwrap_or_else(|| ray.left_by(clip, ends, ray.inside(ends)));
                    self.visits.extend(ray.parts(range, intervals));
                }
            }
            if let [[nearest, _], ..] = self.visits[before..] {
                self.of_ray[lane] = [before, self.visits.len()];
                self.ends[0][lane] = nearest as f64;
                self.ends[1][lane] = self.visits[self.visits.len() - 1][1] as f64;
            }
        }
        self.join();
    }

    /// The ray of a lane.
    #[inline(always)]
    fn ray(&self, lane: usize) -> IndexRay<f64> {
        let vector = |[x, y, z]: &[Column; 3]| Vec3::new(x[lane], y[lane], z[lane]);
        IndexRay {
            origin: vector(&self.origin),
            along: vector(&self.along),
            depth_step: self.depth_step[lane],
            first: self.first,
            step: self.step[lane],
        }
    }

    /// Joins the visits of all rays.
    fn join(&mut self) {
        self.together.clear();
        for [first, end] in self.of_ray {
            let mut from = 0;
            for &range in &self.visits[first..end] {
                from = unite(&mut self.together, range, from);
            }
        }
    }

    /// The number of samples that a ray visited. If values are expensive, it is the number of values that were
    /// computed.
    fn samples(&self, lane: usize, dear: bool) -> u64 {
        let [first, end] = self.of_ray[lane];
        let last = self.ends[1][lane] as i64;
        if dear {
            return self.asked.iter().map(|&(k, lanes)| u64::from(k <= last) & lanes >> lane & 1).sum();
        }
        self.visits[first..end].iter().map(|v| (v[1].min(last) + 1 - v[0]).max(0) as u64).sum()
    }
}

/// Adds a range to disjoint ranges in order, and returns its index. No range before `from` lies behind its beginning.
fn unite(ranges: &mut Vec<[i64; 2]>, [first, last]: [i64; 2], mut from: usize) -> usize {
    while from < ranges.len() && ranges[from][1] + 1 < first {
        from += 1;
    }
    if from == ranges.len() || last + 1 < ranges[from][0] {
        ranges.insert(from, [first, last]);
        return from;
    }
    ranges[from] = [ranges[from][0].min(first), ranges[from][1].max(last)];
    while from + 1 < ranges.len() && ranges[from + 1][0] <= ranges[from][1] + 1 {
        ranges[from][1] = ranges[from][1].max(ranges[from + 1][1]);
        ranges.remove(from + 1);
    }
    from
}

#[inline(always)]
fn stored<S: Simd>(v: Vec3<f64x8<S>>) -> [Column; 3] {
    [v.x.into(), v.y.into(), v.z.into()]
}

/// The rows of the rays of all lanes, as columns.
#[inline(always)]
fn of_rays<S: Simd, const N: usize>(simd: S, of_ray: &[Row; N], rays: &[u8; LANES]) -> [f64x8<S>; 4] {
    let mut rows = [f64x4::splat(simd, 0.0); LANES];
    for lane in 0..LANES {
        rows[lane] = f64x4::simd_from(simd, of_ray[usize::from(rays[lane]) % N]);
    }
    columns(rows)
}

/// The rays in their order.
const IN_ORDER: [u8; LANES] = [0, 1, 2, 3, 4, 5, 6, 7];

#[inline(always)]
fn vector<S: Simd>(simd: S, [x, y, z]: [Column; 3]) -> Vec3<f64x8<S>> {
    Vec3::new(x.simd_into(simd), y.simd_into(simd), z.simd_into(simd))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// United ranges hold what the ranges hold, in whichever order these come. They neither meet nor hold more.
        #[test]
        fn united_ranges_hold_what_they_are_made_of(
            rays in prop::collection::vec(prop::collection::vec((0i64..9, 0i64..9), 0..6), 0..5),
        ) {
            let (mut ranges, mut inside) = (Vec::new(), [false; 128]);
            for ray in rays {
                let (mut next, mut from) = (0, 0);
                for (gap, more) in ray {
                    let range = [next + gap, next + gap + more];
                    next = range[1] + 1;
                    from = unite(&mut ranges, range, from);
                    inside[range[0] as usize..=range[1] as usize].fill(true);
                }
            }
            prop_assert!(ranges.windows(2).all(|w| w[0][1] + 1 < w[1][0]), "{:?}", ranges);
            for (k, inside) in inside.into_iter().enumerate() {
                prop_assert_eq!(ranges.iter().any(|r| r[0] <= k as i64 && k as i64 <= r[1]), inside, "{} {:?}", k, ranges);
            }
        }
    }
}
