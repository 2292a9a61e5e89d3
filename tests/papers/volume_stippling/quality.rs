//! How even points are ([STIP-18]), measured on a flat patch. The same measures stand beside white noise and one repeated
//! tile, which they have to tell from it.

use super::spectrum::Spectrum;
use super::{Preprocessed, drawn_from, flat, points_of};
use crate::common;
use drypoint::reference::volume_stippling::{FrameDots, Frames};
use drypoint::scene::glam::{DVec2, DVec3};
use drypoint::scene::marks::Page;
use drypoint::scene::math::ln;
use drypoint::scene::philox;
use drypoint::scene::points::Points;
use drypoint::scene::tables::{Camera, StippleOrder, Stipples, Threshold};
use drypoint::scene::view::View;

/// Half the side of the patch.
const HALF: f64 = 24.0;

/// What is measured of points in a square.
#[derive(Clone, Copy, Debug)]
struct Quality {
    /// Mean distance to the nearest other point, times √density: 0.5 of white noise, at most 1.07.
    nearest: f64,
    /// Mean power over 0 < |f| ≤ ½√(2ρ/√3), in dB of white noise's.
    low: f64,
    /// The highest power of a single frequency up to twice that or to two cycles a voxel, in dB.
    peak: f64,
}

impl Quality {
    /// The measures for points of the patch; others tell how far the nearest is. `points` ascend in x.
    fn new(points: &[DVec2]) -> Self {
        let inside = |p: &DVec2| p.abs().max_element() <= HALF;
        let chosen: Vec<DVec2> = points.iter().copied().filter(inside).collect();
        let density = chosen.len() as f64 / (4.0 * HALF * HALF);
        let distances = (0..points.len()).filter(|&i| inside(&points[i])).map(|i| nearest(points, i));
        let nearest = distances.sum::<f64>() / chosen.len() as f64 * density.sqrt();
        let (low, peak) = power(&chosen, density);
        Self { nearest, low, peak }
    }

    fn is_even(&self, k: usize) -> bool {
        self.nearest >= 0.75 && self.low <= -8.0 && (k < 2 || self.peak <= 20.0)
    }
}

/// The distance to the nearest other point, 0 where two coincide; `points` ascend in x.
fn nearest(points: &[DVec2], i: usize) -> f64 {
    let (p, mut best) = (points[i], f64::INFINITY);
    let mut look = |q: &DVec2| {
        best = best.min(q.distance(p));
        (q.x - p.x).abs() < best
    };
    points[i + 1..].iter().all(&mut look);
    points[..i].iter().rev().all(&mut look);
    best
}

/// Mean of the low and highest of all frequencies' power: whole waves in the square, so that its outline adds none.
fn power(points: &[DVec2], density: f64) -> (f64, f64) {
    let side = 2.0 * HALF;
    let cut = 0.5 * (2.0 * density / 3f64.sqrt()).sqrt();
    let top = (2.0 * cut).max(2.0);
    let (mut sum, mut count, mut peak) = (0.0, 0.0, 0.0f64);
    for (f, power) in Spectrum::new(points, HALF, (top * side) as usize).each() {
        let f = f.length() / side;
        if f <= top {
            peak = peak.max(power);
        }
        if f <= cut {
            (sum, count) = (sum + power, count + 1.0);
        }
    }
    let decibels = |x: f64| 10.0 * ln(x) / ln(10.0);
    (decibels(sum / count), decibels(peak))
}

/// Points in the coordinates of a plane through `centre`, ascending in x.
fn on_plane(points: impl Iterator<Item = DVec3>, centre: DVec3, n: DVec3) -> Vec<DVec2> {
    let u = n.any_orthonormal_vector();
    let v = n.cross(u);
    let mut flat: Vec<DVec2> = points.map(|p| p - centre).map(|p| DVec2::new(p.dot(u), p.dot(v))).collect();
    flat.sort_by(|a, b| a.x.total_cmp(&b.x));
    flat
}

/// A flat face of one layer of voxels, larger than the patch: an edge that is a cubic step, eight voxels wide, thinned.
fn patch(n: DVec3, order: StippleOrder) -> (Preprocessed, DVec3) {
    face(n, order, true)
}

/// The same, or all of the edge whose slope is above half of the largest: 4√2 voxels.
fn face(n: DVec3, order: StippleOrder, thin: bool) -> (Preprocessed, DVec3) {
    let dims = dims(n);
    let centre = DVec3::from_array(dims.map(|n| (n - 1) as f64 / 2.0));
    // A cubic step is as good: its slope is largest in the middle.
    let value = move |p: DVec3| {
        let t = ((p - centre).dot(n) / 4.0).clamp(-1.0, 1.0);
        t * (3.0 - t * t)
    };
    let stipples = Stipples { thin, threshold: Threshold::Magnitude(0.5), order, ..Stipples::default() };
    (points_of(dims, value, &stipples, 25), centre)
}

/// A corner of an oblique patch is 34 voxels from its middle.
fn dims(n: DVec3) -> [usize; 3] {
    if n == DVec3::Z { [52, 52, 11] } else { [72; 3] }
}

const OBLIQUE: DVec3 = DVec3::new(0.267_261_241_912_424_4, 0.534_522_483_824_848_8, 0.801_783_725_737_273_2);

#[test]
fn prefixes_of_a_flat_patch_are_even() {
    for n in [DVec3::Z, OBLIQUE] {
        let (made, centre) = patch(n, StippleOrder::Neighbours);
        for k in [1, 2, 4, 8, 16] {
            let quality = Quality::new(&on_plane(made.prefix(k), centre, n));
            println!("{n} k = {k}: {quality:.3?}");
            assert!(quality.is_even(k), "{n} k = {k}: {quality:?}");
        }
    }
}

/// The test would find points that are not even: white noise has a nearest-neighbour distance of ½ and no hole in its
/// spectrum; one voxel's points in every voxel have the voxels' frequency.
#[test]
fn white_noise_and_a_repeated_tile_are_not() {
    let (made, centre) = patch(DVec3::Z, StippleOrder::Neighbours);
    for k in [1, 2, 4, 8, 16] {
        let count = (48 * 48 * k) as u32;
        let white = |i| philox::uniforms(9, [i, 0, 0], 0);
        let white = (0..count).map(white).map(|[x, y, ..]| centre + 48.0 * DVec3::new(x - 0.5, y - 0.5, 0.0));
        let quality = Quality::new(&on_plane(white, centre, DVec3::Z));
        assert!((quality.nearest - 0.5).abs() < 0.02 && quality.low > -1.0, "white, k = {k}: {quality:?}");
        assert!(!quality.is_even(k));
        if k > 1 {
            let tile: Vec<DVec3> = made.offsets_of(0).take(k).collect();
            let cells = made.centres().flat_map(|c| tile.iter().map(move |o| c + *o));
            let quality = Quality::new(&on_plane(cells, centre, DVec3::Z));
            assert!(quality.peak > 20.0 && !quality.is_even(k), "a tile, k = {k}: {quality:?}");
        }
    }
}

/// A wide edge is several layers: each is even, and what is seen of them together is nearer to white noise (0.5, 0 dB) than to
/// one layer.
#[test]
fn dots_of_a_wide_edge_are_even_where_it_is_thinned() {
    let [thin, wide] = [true, false].map(|thin| face(OBLIQUE, StippleOrder::Neighbours, thin));
    for k in [1, 2, 4, 8, 16] {
        let [thin, wide] =
            [&thin, &wide].map(|(made, centre)| Quality::new(&on_plane(made.prefix(k), *centre, OBLIQUE)));
        println!("projected, k = {k}: thin {thin:.3?}, not {wide:.3?}");
        assert!(thin.is_even(k) && !wide.is_even(k), "k = {k}: {thin:?} {wide:?}");
        assert!(wide.nearest < 0.5 * (thin.nearest + 0.5) && wide.low > 0.5 * thin.low, "k = {k}: {thin:?} {wide:?}");
    }
}

/// The dots of a flat tone in opaque ink, so many points a voxel.
fn opaque(points: &Points, centre: DVec3, n: DVec3, tone: f64) -> Vec<DVec2> {
    let volume = common::volume(dims(n), |_| 0.0);
    let view = View::new(&Camera::default(), volume.grid(), [1000, 1000]).unwrap();
    let stipples = flat(Stipples::default(), points, volume.grid(), &view, tone);
    let frames = Frames::new(drawn_from(&stipples, points, volume.grid(), &view, 1.0));
    let mut drawn = FrameDots::default();
    frames.draw(&view, &Page::in_pixels(view.size, 0.0, 254.0), &mut drawn);
    on_plane(drawn.dots().map(|dot| dot.world), centre, n)
}

/// Where the mask decides which voxels draw a point, what they draw is even too.
#[test]
fn a_flat_tone_in_opaque_ink_is_even() {
    for n in [DVec3::Z, OBLIQUE] {
        let (made, centre) = patch(n, StippleOrder::Neighbours);
        for tone in [0.1, 0.3, 1.0, 2.5] {
            let quality = Quality::new(&opaque(&made.points, centre, n, tone));
            println!("{n} tone {tone}: {quality:.3?}");
            assert!(quality.nearest >= 0.7, "{n} tone {tone}: {quality:?}");
        }
    }
}

/// A voxel that does not see its neighbours, the paper's, is less even across their faces.
#[test]
fn seeing_the_neighbours_makes_the_difference() {
    let measured = |order| {
        let (made, centre) = patch(DVec3::Z, order);
        Quality::new(&on_plane(made.prefix(4), centre, DVec3::Z)).nearest
    };
    let [voxel, neighbours] = [StippleOrder::Voxel, StippleOrder::Neighbours].map(measured);
    assert!(voxel < neighbours - 0.1, "{voxel} {neighbours}");
}

/// Inside a solid, where every voxel has points, distances are those in space: white noise has 0.554.
#[test]
fn points_of_a_solid_are_even_in_space() {
    let stipples = Stipples { threshold: Threshold::Magnitude(0.5), ..Stipples::default() };
    let made = points_of([16; 3], |p| p.dot(OBLIQUE), &stipples, 25);
    for k in [1, 2, 4, 8, 16] {
        let mut points: Vec<DVec3> = made.prefix(k).collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        let inside = |p: &&DVec3| (**p - 7.5).abs().max_element() < 4.0;
        let near = |p: &DVec3| {
            let other = |q: &&DVec3| (q.x - p.x).abs() < 1.5 && *q != p;
            points.iter().filter(other).map(|q| q.distance(*p)).fold(f64::INFINITY, f64::min)
        };
        let chosen: Vec<&DVec3> = points.iter().filter(inside).collect();
        let mean = chosen.iter().map(|p| near(p)).sum::<f64>() / chosen.len() as f64;
        let ratio = mean * (k as f64).cbrt();
        println!("solid, k = {k}: {ratio:.3}");
        assert!(ratio >= 0.75, "k = {k}: {ratio}");
    }
}
