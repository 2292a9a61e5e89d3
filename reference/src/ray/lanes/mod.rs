//! Eight rays side by side: the pictures that are asked for most, unshaded, Phong and styles, to the same bits sooner.
//!
//! What [`cast`](super::cast) does sample by sample is done here plane by plane for neighbouring rays, in vectors of the
//! widest registers that the processor has. Each lane takes the steps of its ray alone, in their order, with +, −, ×, ÷ and √
//! only, which are the same in a vector; what branches or looks things up is done lane by lane. Rays visit the samples
//! that they would visit alone, so the counts are the same too.

mod boxes;
mod correct;
mod normal;
mod phong;
mod style;
mod waiting;
mod walk;

use self::phong::{Shaded, Unshaded};
use self::waiting::cast_waiting;
use self::walk::Walk;
use super::cast::Cast;
use super::lattice::IndexRay;
use super::need::Needs;
use super::prepared::{Calls, KappaSource, Prepared};
use super::sample::{Look, Sight};
use super::skip::{Boxes, merge};
use crate::field::lanes::{LANES, Packed};
use crate::number::Vec3;
use crate::number::lanes::{columns, wide};
use drypoint_scene::counts::Counts;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::view::Ray;
use drypoint_scene::volume::Voxels;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, f64x8};

/// Whether a scene's rays can be cast in lanes.
pub(super) fn serve(prepared: &Prepared<'_, f64>) -> bool {
    let shaded = match prepared.needs {
        Needs::Value => false,
        Needs::Normal => true,
        Needs::Anything if is_in_style(prepared) => true,
        Needs::Anything => return false,
    };
    wide().is_some()
        && prepared.layers == [LayerKind::Beauty]
        && prepared.volume.mask().is_none()
        && prepared.surface.is_none()
        && prepared.field.fits_lanes(shaded)
        && matches!(prepared.volume.voxels(), Voxels::U8(_) | Voxels::I8(_) | Voxels::U16(_) | Voxels::I16(_))
}

/// Whether a scene is one of styles over the value, without mip-maps, and with contours that no Hessian is asked for.
fn is_in_style(prepared: &Prepared<'_, f64>) -> bool {
    let calls = Calls { kappa: KappaSource::None, ..prepared.calls };
    matches!(&prepared.look, Look::Style(styled) if styled.detail.is_none())
        && calls == Calls::NORMAL
        && prepared.calls.kappa != KappaSource::Exact
        && prepared.first.is_none()
        && prepared.over_two.is_none()
        && prepared.table.is_none()
        && !prepared.encode
}

/// Casts the rays through points of the picture, in pixels from the top left corner, and appends what comes out of each. For
/// scenes that lanes [`serve`].
pub(super) fn cast_all(
    prepared: &Prepared<'_, f64>,
    points: &[[f64; 2]],
    boxes: Option<&mut Boxes>,
    counts: &mut Counts,
    casts: &mut Vec<Cast>,
) {
    if boxes.as_ref().is_some_and(|boxes| boxes.is_empty()) {
        counts.rays += points.len() as u64;
        counts.rays_skipped += points.len() as u64;
        casts.extend(points.iter().map(|_| Cast { rgba: [0.0; 4], sums: None, samples: 0 }));
        return;
    }
    let inside = boxes.as_ref().is_some_and(|boxes| boxes.are_inside(prepared.ends.map(Vec3::to_glam)));
    let boxes = boxes.as_deref().map(|boxes| (boxes, inside));
    let mut intervals = Default::default();
    let at_once = if matches!(prepared.look, Look::Style(_)) { RAYS } else { LANES };
    let mut packets = Vec::with_capacity(at_once / LANES);
    packets.resize_with(at_once.min(points.len()).div_ceil(LANES), || Packet::new(prepared));
    for points in points.chunks(at_once) {
        let packets = &mut packets[..points.len().div_ceil(LANES)];
        for (packet, points) in packets.iter_mut().zip(points.chunks(LANES)) {
            packet.aim(points, boxes, &mut intervals);
        }
        match prepared.volume.voxels() {
            Voxels::U8(data) => run(prepared, packets, data, counts),
            Voxels::I8(data) => run(prepared, packets, data, counts),
            Voxels::U16(data) => run(prepared, packets, data, counts),
            Voxels::I16(data) => run(prepared, packets, data, counts),
            _ => unreachable!("lanes serve 8 and 16 bits alone"),
        }
        for (packet, points) in packets.iter().zip(points.chunks(LANES)) {
            for lane in 0..points.len() {
                let samples = packet.samples(lane);
                counts.rays += 1;
                counts.rays_skipped += u64::from(samples == 0);
                counts.samples += samples;
                casts.push(Cast { rgba: packet.rgba[lane], sums: None, samples });
            }
        }
    }
}

/// Casts the rays of packets.
fn run<V: Packed>(prepared: &Prepared<'_, f64>, packets: &mut [Packet<'_, '_>], data: &[V], counts: &mut Counts) {
    if let (true, Some(simd)) = (packets.iter().any(|packet| !packet.visits.is_empty()), wide()) {
        simd.vectorize(
            #[inline(always)]
            || walk(simd, prepared, packets, data, counts),
        );
    }
}

#[inline(always)]
fn walk<S: Simd, V: Packed>(
    simd: S,
    prepared: &Prepared<'_, f64>,
    packets: &mut [Packet<'_, '_>],
    data: &[V],
    counts: &mut Counts,
) {
    if let Look::Style(styled) = &prepared.look {
        return cast_waiting(simd, packets, styled, data, counts);
    }
    for packet in packets {
        let walk = Walk::new(simd, packet, data);
        match &prepared.look {
            Look::Regular { colors, phong: Some(phong) } if prepared.needs == Needs::Normal => {
                walk.run(packet, &mut Shaded::new(simd, packet, colors, phong), counts);
            }
            Look::Regular { colors, .. } => walk.run(packet, &mut Unshaded { colors }, counts),
            Look::Style(_) | Look::Illustrated(_) => unreachable!("lanes serve regular functions and styles alone"),
        }
    }
}

/// Numbers of eight rays.
type Column = [f64; LANES];
/// Four numbers of one ray.
type Row = [f64; 4];
/// Depths at which each of eight rays is in a visible brick.
type Intervals = [Vec<[f64; 2]>; LANES];

/// Rays whose samples wait for each other: those of a tile.
const RAYS: usize = 8 * LANES;

/// Rays side by side and what comes out of them. Lanes without a ray visit nothing.
struct Packet<'p, 'v> {
    prepared: &'p Prepared<'v, f64>,
    origin: [Column; 3],
    along: [Column; 3],
    depth_step: Column,
    /// v and Δ_ray of each ray.
    sights: [Row; LANES],
    /// v in eye space, and the smallest sample beyond `near`.
    eyes: [Row; LANES],
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
            sights: [[0.0; 4]; LANES],
            eyes: [[0.0; 4]; LANES],
            half: [none; 3],
            visits: Vec::with_capacity(4 * LANES),
            of_ray: [[0; 2]; LANES],
            together: Vec::with_capacity(4 * LANES),
            ends: [none; 2],
            rgba: [[0.0; 4]; LANES],
        }
    }

    /// Takes the rays through other points, past the boxes of visible bricks, with whether all of these are farther than half
    /// a voxel from the end of the volume.
    fn aim(&mut self, points: &[[f64; 2]], boxes: Option<(&Boxes, bool)>, intervals: &mut Intervals) {
        let prepared = self.prepared;
        self.visits.clear();
        self.of_ray = [[0; 2]; LANES];
        self.ends = [[f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]];
        self.rgba = [[0.0; 4]; LANES];
        let aimed = |point: &[f64; 2]| {
            let pixel = prepared.view.ray(point[0], point[1]);
            (pixel, IndexRay::<f64>::new(&pixel, &prepared.view, &prepared.lattice, prepared.volume.grid()))
        };
        let Some((boxes, inside)) = boxes else {
            for (lane, (pixel, ray)) in points.iter().map(aimed).enumerate() {
                self.visits.extend(ray.visits(prepared.ends, None));
                self.take(lane, &pixel, &ray);
            }
            return self.join();
        };
        let mut rays = [None; LANES];
        let mut lines = [None; LANES];
        for (lane, (pixel, ray)) in points.iter().map(aimed).enumerate() {
            rays[lane] = Some((pixel, ray));
            lines[lane] = Some(boxes.line(ray.line(), f64::EPSILON));
        }
        if let Some(simd) = wide() {
            simd.vectorize(
                #[inline(always)]
                || boxes::intervals(simd, boxes.ends(), &lines, intervals),
            );
        }
        for (lane, (ray, intervals)) in rays.iter().zip(intervals).enumerate() {
            if let (Some((pixel, ray)), false) = (ray, intervals.is_empty()) {
                merge(intervals);
                let inside = if inside { ray.all_beyond_near() } else { None };
                let range = inside.unwrap_or_else(|| ray.inside(prepared.ends));
                self.visits.extend(ray.parts(range, intervals));
                self.take(lane, pixel, ray);
            }
        }
        self.join();
    }

    /// Takes a ray, whose visits are the last ones in the list.
    fn take(&mut self, lane: usize, pixel: &Ray, ray: &IndexRay<f64>) {
        let first = self.of_ray[..lane].iter().map(|visits| visits[1]).max().unwrap_or(0);
        self.of_ray[lane] = [first, self.visits.len()];
        let (Some([nearest, _]), Some([_, farthest])) = (self.visits.get(first), self.visits.last()) else {
            return;
        };
        self.ends[0][lane] = *nearest as f64;
        self.ends[1][lane] = *farthest as f64;
        let direction = Vec3::from_glam(self.prepared.view.direction_to_world(pixel.v));
        let Sight { v, v_eye, half } = self.prepared.look.sight(direction, Vec3::from_glam(pixel.v));
        put(&mut self.origin, lane, ray.origin);
        put(&mut self.along, lane, ray.along);
        self.sights[lane] = [v.x, v.y, v.z, ray.step];
        self.eyes[lane] = [v_eye.x, v_eye.y, v_eye.z, ray.first as f64];
        put(&mut self.half, lane, half);
        self.depth_step[lane] = ray.depth_step;
    }

    /// Joins the visits of all rays.
    fn join(&mut self) {
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

/// Rows as columns, from the row of each lane.
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
