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
use self::style::InStyle;
use self::waiting::Waiting;
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
    let mut packet = Packet::new(prepared);
    packet.inside = boxes.as_ref().is_some_and(|boxes| boxes.are_inside(prepared.ends.map(Vec3::to_glam)));
    for points in points.chunks(LANES) {
        packet.aim(points, boxes.as_deref());
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
            casts.push(Cast { rgba: packet.rgba[lane], sums: None, samples });
        }
    }
}

/// Numbers of eight rays.
type Column = [f64; LANES];
/// Four numbers of one ray.
type Row = [f64; 4];

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
    /// Whether visible bricks are all farther than half a voxel from the end of the volume.
    inside: bool,
    /// Depths at which each ray is in a visible brick.
    intervals: [Vec<[f64; 2]>; LANES],
    waiting: Waiting,
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
            visits: Vec::new(),
            of_ray: [[0; 2]; LANES],
            together: Vec::new(),
            ends: [none; 2],
            rgba: [[0.0; 4]; LANES],
            inside: false,
            intervals: Default::default(),
            waiting: Waiting::new(),
        }
    }

    /// Takes the rays through other points.
    fn aim(&mut self, points: &[[f64; 2]], boxes: Option<&Boxes>) {
        let prepared = self.prepared;
        self.visits.clear();
        self.of_ray = [[0; 2]; LANES];
        self.ends = [[f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]];
        self.rgba = [[0.0; 4]; LANES];
        let aimed = |point: &[f64; 2]| {
            let pixel = prepared.view.ray(point[0], point[1]);
            (pixel, IndexRay::<f64>::new(&pixel, &prepared.view, &prepared.lattice, prepared.volume.grid()))
        };
        let Some(boxes) = boxes else {
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
        let mut intervals = std::mem::take(&mut self.intervals);
        if let Some(simd) = wide() {
            simd.vectorize(
                #[inline(always)]
                || boxes::intervals(simd, boxes.ends(), &lines, &mut intervals),
            );
        }
        for (lane, (ray, intervals)) in rays.iter().zip(&mut intervals).enumerate() {
            if let (Some((pixel, ray)), false) = (ray, intervals.is_empty()) {
                merge(intervals);
                let inside = if self.inside { ray.all_beyond_near() } else { None };
                let range = inside.unwrap_or_else(|| ray.inside(prepared.ends));
                self.visits.extend(ray.parts(range, intervals));
                self.take(lane, pixel, ray);
            }
        }
        self.intervals = intervals;
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
        let walk = Walk::new(simd, self, data);
        match &self.prepared.look {
            Look::Regular { colors, phong: Some(phong) } if self.prepared.needs == Needs::Normal => {
                walk.run(self, &mut Shaded::new(simd, self, colors, phong), counts);
            }
            Look::Regular { colors, .. } => walk.run(self, &mut Unshaded { colors }, counts),
            Look::Illustrated(_) => unreachable!("its needs are anything, which lanes serve for styles alone"),
            Look::Style(styled) => walk.run_waiting(self, &mut InStyle::new(simd, self, styled), counts),
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

/// Rows as columns, from the row of each lane.
#[inline(always)]
fn of_rays<S: Simd>(simd: S, of_ray: &[Row; LANES], rays: &[u8; LANES]) -> [f64x8<S>; 4] {
    let mut rows = [f64x4::splat(simd, 0.0); LANES];
    for lane in 0..LANES {
        rows[lane] = f64x4::simd_from(simd, of_ray[usize::from(rays[lane]) % LANES]);
    }
    columns(rows)
}

/// The rays in their order.
const IN_ORDER: [u8; LANES] = [0, 1, 2, 3, 4, 5, 6, 7];

#[inline(always)]
fn vector<S: Simd>(simd: S, [x, y, z]: [Column; 3]) -> Vec3<f64x8<S>> {
    Vec3::new(x.simd_into(simd), y.simd_into(simd), z.simd_into(simd))
}
