//! The voxels that get points, how many, and where those lie ([STIP-1] … [STIP-4], hard cases).

use super::{orthographic, params, points_of, table, wide};
use crate::common;
use drypoint::reference::volume_stippling::Preprocess;
use drypoint::scene::counts::Counts;
use drypoint::scene::glam::DVec3;
use drypoint::scene::points::Points;
use drypoint::scene::tables::{Camera, Length, Snap, StippleGradient, StippleOrder, Stipples, Threshold};
use drypoint::scene::view::View;
use drypoint::scene::volume::Volume;

fn made(volume: &Volume, stipples: &Stipples, view: &View) -> Points {
    let table = table();
    Preprocess::new(params(stipples, &table, volume.grid(), view), volume, None)
        .unwrap()
        .points(&mut Counts::default(), &|_| {})
        .unwrap()
}

fn all_ways() -> impl Iterator<Item = Stipples> {
    let flags = (0..16).map(|i| [i & 1, i >> 1 & 1, i >> 2 & 1, i >> 3 & 1].map(|bit| bit == 1));
    flags.map(|[thin, snap, voxel, central]| Stipples {
        thin,
        snap: if snap { Snap::Edge } else { Snap::None },
        order: if voxel { StippleOrder::Voxel } else { StippleOrder::Neighbours },
        gradient: if central { StippleGradient::Central } else { StippleGradient::Regression },
        ..Stipples::default()
    })
}

#[test]
fn a_constant_volume_has_no_points() {
    for value in [0.0, 1000.1] {
        for dims in [[5, 6, 7], [1, 1, 1], [4, 1, 3]] {
            let volume = common::volume(dims, |_| value);
            let view = orthographic(&volume, 8.0);
            for stipples in all_ways() {
                assert!(
                    made(&volume, &Stipples { threshold: Threshold::Magnitude(0.0), ..stipples }, &view).is_empty()
                );
            }
        }
    }
}

#[test]
fn one_bright_voxel_has_points_all_around_it() {
    let volume = common::volume([9; 3], |p| f64::from(u8::from(p == DVec3::splat(4.0))));
    let view = orthographic(&volume, 8.0);
    for stipples in all_ways() {
        let points = made(&volume, &stipples, &view);
        assert!(!points.is_empty());
        for (i, voxel) in points.voxels.iter().enumerate() {
            assert!(voxel.cell.iter().all(|&c| (3..=5).contains(&c)) && voxel.cell != [4; 3], "{:?}", voxel.cell);
            // Outwards: bright inside.
            assert!(voxel.normal.dot(voxel.centre() - 4.0) > 0.0);
            assert!(points.of(i).iter().all(|o| wide(*o).is_finite()));
        }
    }
}

#[test]
fn points_lie_in_their_voxels_and_slabs() {
    for (h, slab) in [(0.0, Length::World(0.0)), (0.5, Length::Voxels(0.5)), (1.0, Length::World(1.0))] {
        let volume = common::ball(15, 5.0);
        let points = made(&volume, &Stipples { slab, ..Stipples::default() }, &orthographic(&volume, 6.0));
        for (i, voxel) in points.voxels.iter().enumerate() {
            for o in points.of(i).iter().map(|o| wide(*o)) {
                // f32 rounds three numbers of at most ½.
                assert!(o.abs().max_element() <= 0.5 && voxel.normal.dot(o).abs() <= h + 3.0 * 2f64.powi(-26));
            }
        }
    }
}

/// Neither threads nor the values' scale change a bit.
#[test]
fn points_are_the_same_on_any_number_of_threads_and_at_any_scale() {
    let ball = common::ball(20, 6.0);
    let view = orthographic(&ball, 6.0);
    let stipples = Stipples { snap: Snap::Edge, thin: true, ..Stipples::default() };
    let wanted = made(&ball, &stipples, &view);
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| made(&ball, &stipples, &view)), wanted);
    }
    for k in [-300, -40, 7, 200] {
        let centre = DVec3::splat(9.5);
        let scaled = common::volume([20; 3], |p| (6.0 - (p - centre).length()) * 2f64.powi(k));
        assert_eq!(made(&scaled, &stipples, &view), wanted, "2^{k}");
    }
    let other = made(&ball, &Stipples { seed: 2, ..stipples }, &view);
    assert!(other.voxels == wanted.voxels && other.offsets != wanted.offsets);
}

#[test]
fn voxels_beside_invalid_ones_have_no_points() {
    let hole = DVec3::new(3.0, 7.0, 7.0);
    let centre = DVec3::splat(7.0);
    let volume = common::volume([15; 3], |p| if p == hole { f64::NAN } else { 5.0 - (p - centre).length() });
    let points = made(&volume, &Stipples::default(), &orthographic(&volume, 8.0));
    assert!(points.voxels.iter().all(|voxel| (voxel.centre() - hole).abs().max_element() > 1.0));
    assert!(points.voxels.iter().any(|voxel| (voxel.centre() - hole).abs().max_element() == 2.0));
}

/// Eq. 1 and 4.2, from a picture whose pixels are known: a voxel of 8×8 pixels has 64·√3-ish points as it is; at 1 pixel
/// boxes of 5³ and more stand in its place.
#[test]
fn small_voxels_become_boxes() {
    let volume = common::ball(60, 20.0);
    let table = table();
    let made = |pixels, box_side| {
        let view = orthographic(&volume, pixels);
        let stipples = Stipples { box_side, ..Stipples::default() };
        let preprocess = Preprocess::new(params(&stipples, &table, volume.grid(), &view), &volume, None).unwrap();
        (preprocess.area, preprocess.box_side, preprocess.each)
    };
    let at = |pixels| made(pixels, None);
    for pixels in [0.01, 0.5, 1.0, 2.0, 5.0, 8.0] {
        let (area, m, each) = at(pixels);
        // The box is 59 units long and seen obliquely.
        assert!(area > (59.0 * pixels).powi(2) && area < 3f64.sqrt() * (59.0 * pixels).powi(2));
        let voxel = |m: f64| m * m * area / 3600.0;
        assert!((m == 60 || voxel(m as f64) >= 25.0) && (m == 1 || voxel(m as f64 - 1.0) < 25.0), "{pixels}: {m}");
        let boxes = (60.0 / m as f64).ceil();
        assert_eq!(each, ((area / (boxes * boxes) + 0.5).floor() as usize).max(1), "{pixels}");
        // Or as a scene says, with eq. 1 for what that makes.
        for side in [1, 3, m as u64] {
            let boxes = (60.0 / side as f64).ceil();
            let each = ((area / (boxes * boxes) + 0.5).floor() as usize).max(1);
            assert_eq!(made(pixels, Some(side)), (area, side as usize, each), "{pixels}");
        }
    }
}

#[test]
fn ten_thousand_points_in_a_voxel_and_one() {
    for (dims, each) in [([2, 2, 1], 10_000), ([12, 12, 12], 1)] {
        let made = points_of(dims, |p| p.x + 0.5 * p.y, &Stipples::default(), each);
        let points = &made.points;
        assert_eq!((points.len(), points.each), (points.voxels.len() * each, each));
        for i in 0..points.voxels.len() {
            let mut bits: Vec<[u32; 3]> = points.of(i).iter().map(|o| o.map(f32::to_bits)).collect();
            bits.sort_unstable();
            bits.dedup();
            assert_eq!(bits.len(), each, "two points are one");
        }
    }
}

/// Points in slabs round voxel centres show stairs on an oblique face; snapped they lie on it.
#[test]
fn snapping_puts_points_onto_the_edge() {
    let n = DVec3::new(1.0, 2.0, 3.0).normalize();
    let value = |p: DVec3| {
        let t = ((p - 12.3).dot(n) / 3.0).clamp(-1.0, 1.0);
        t * (3.0 - t * t)
    };
    let farthest = |snap, thin| {
        let stipples = Stipples { snap, thin, threshold: Threshold::Magnitude(0.4), ..Stipples::default() };
        let made = points_of([25; 3], value, &stipples, 9);
        let inner = |p: &DVec3| (*p - 12.0).abs().max_element() < 8.0;
        made.prefix(9).filter(inner).map(|p| (p - 12.3).dot(n).abs()).fold(0.0, f64::max)
    };
    // A layer half a voxel to either side, and slabs of half a voxel about its centres.
    assert!(farthest(Snap::None, true) > 0.7);
    // The gradient is known at voxels and linear between: its top is off by a small part of one.
    assert!(farthest(Snap::Edge, true) < 0.15, "{}", farthest(Snap::Edge, true));
}

/// One layer a face, whatever its width and its direction: as many voxels as the face has unit squares, on the mean over
/// where it lies between the voxels' own layers.
#[test]
fn a_thin_face_has_one_layer_at_every_orientation() {
    const OFFSETS: u32 = 8;
    for i in 0..8u32 {
        let [u, v, ..] = drypoint::scene::philox::uniforms(5, [i, 0, 0], 0);
        let (z, t) = (1.0 - u, std::f64::consts::TAU * v);
        let n = DVec3::new((1.0 - z * z).sqrt() * t.cos(), (1.0 - z * z).sqrt() * t.sin(), z);
        let width = 2.0 + f64::from(i % 3);
        let mut count = 0;
        for k in 0..OFFSETS {
            let middle = DVec3::splat(12.0) + n * (f64::from(k) / f64::from(OFFSETS) - 0.5);
            let value = |p: DVec3| {
                let t = ((p - middle).dot(n) / width).clamp(-1.0, 1.0);
                t * (3.0 - t * t)
            };
            let stipples = Stipples { thin: true, threshold: Threshold::Magnitude(0.5), ..Stipples::default() };
            let made = points_of([25; 3], value, &stipples, 1);
            // In a cylinder about the middle, of radius 7.
            let inside = |c: &DVec3| ((*c - middle) - n * (*c - middle).dot(n)).length() < 7.0;
            count += made.centres().filter(inside).count();
        }
        let layers = count as f64 / f64::from(OFFSETS) / (std::f64::consts::PI * 49.0);
        // Layers of voxels are at most 1 apart, and eight offsets of ⅛ meet each within one: an eighth at most.
        assert!((layers - 1.0).abs() <= 0.125, "{n}, {width}: {layers}");
    }
}

#[test]
fn an_eye_in_the_volume_is_no_error() {
    let volume = common::ball(21, 8.0);
    let camera =
        Camera { eye: Some(DVec3::splat(10.0)), direction: DVec3::X, direction_given: true, ..Camera::default() };
    let view = View::new(&camera, volume.grid(), [64, 48]).unwrap();
    assert!(!made(&volume, &Stipples::default(), &view).is_empty());
}
