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
mod packet;
mod phong;
mod ray_lanes;
mod rays;
mod sample_queue;
mod style;

use self::packet::{Packet, RAYS};
use self::phong::{FlatShader, PhongShader};
use self::ray_lanes::RayLanes;
use self::sample_queue::cast_waiting;
use super::composite::Cast;
use super::prepared::Prepared;
use super::sample::SampleShader;
use super::sample::need::Needs;
use super::tile_work::TileWork;
use crate::field::AnySampler;
use crate::field::lanes::{EachReader, LANES, LaneReader, Packed};
use crate::number::Vec3;
use crate::number::lanes::wide;
use bytemuck::cast_slice;
use drypoint_scene::counts::Counts;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::{KappaSource, SampleQuery};
use drypoint_scene::volume::Voxels;
use fearless_simd::Simd;

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
