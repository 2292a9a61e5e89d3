//! Dots chosen on the page ([STIP-19]).

use super::{Preprocessed, drawn_from, flat, orthographic, points_of};
use crate::common;
use drypoint::reference::volume_stippling::{FrameDots, Frames, choose_on_page};
use drypoint::scene::glam::{DVec2, DVec3};
use drypoint::scene::marks::{Dot, Page};
use drypoint::scene::tables::{Even, Stipples, Threshold};
use drypoint::scene::volume::Volume;
use std::collections::BTreeSet;

const DIMS: [usize; 3] = [60, 30, 60];

/// Points of a voxel.
const EACH: usize = 16;

/// A plate: two faces nine voxels apart, each of one layer, across the page.
fn plate() -> (Preprocessed, Volume) {
    let value = |p: DVec3| {
        let t = ((4.5 - (p.y - 14.5).abs()) / 3.0).clamp(-1.0, 1.0);
        t * (3.0 - t * t)
    };
    let stipples = Stipples { thin: true, threshold: Threshold::Magnitude(0.5), ..Stipples::default() };
    (points_of(DIMS, value, &stipples, EACH), common::volume(DIMS, value))
}

/// Both faces in a flat tone, so many points a voxel.
fn draw(made: &Preprocessed, volume: &Volume, tone: f64, even: Even) -> (Vec<Dot>, Page) {
    let view = orthographic(volume, 2.0);
    let stipples = Stipples { even, ..Stipples::default() };
    let stipples = flat(stipples, &made.points, volume.grid(), &view, tone);
    let frames = Frames::new(drawn_from(&stipples, &made.points, volume.grid(), &view, 0.05));
    let page = Page::in_pixels(view.size, 0.0, 254.0);
    let mut drawn = FrameDots::default();
    frames.draw(&view, &page, &mut drawn);
    if even == Even::Page {
        choose_on_page(std::slice::from_mut(&mut drawn));
    }
    (drawn.to_vec(), page)
}

/// Mean distance to the nearest other dot, times √density, in the middle of the page where both faces are seen.
fn nearest(dots: &[Dot], page: &Page) -> f64 {
    let middle = page.size / 2.0;
    let inside = |dot: &&Dot| (dot.at - middle).abs().max_element() < 3.0;
    let distance = |p: DVec2| {
        let others = dots.iter().filter(|q| (q.at - p).abs().max_element() < 1.0 && q.at != p);
        others.map(|q| q.at.distance(p)).fold(1.0, f64::min)
    };
    let chosen: Vec<f64> = dots.iter().filter(inside).map(|dot| distance(dot.at)).collect();
    let density = chosen.len() as f64 / 36.0;
    chosen.iter().sum::<f64>() / chosen.len() as f64 * density.sqrt()
}

#[test]
fn faces_that_overlap_are_even_together() {
    let (made, volume) = plate();
    let bits = |p: DVec3| p.to_array().map(f64::to_bits);
    let world = |i: usize, o: &[f32; 3]| volume.grid().to_world(made.points.voxels[i].centre() + super::wide(*o));
    let voxels = 0..made.points.voxels.len();
    let all: BTreeSet<[u64; 3]> =
        voxels.flat_map(|i| made.points.of(i).iter().map(move |o| bits(world(i, o))).collect::<Vec<_>>()).collect();
    for tone in [0.5, 1.0, 2.0, 4.0] {
        let (first, page) = draw(&made, &volume, tone, Even::None);
        let (chosen, _) = draw(&made, &volume, tone, Even::Page);
        let [of_lists, of_page] = [&first, &chosen].map(|dots| nearest(dots, &page));
        println!("tone {tone}: {of_lists:.3} of the lists, {of_page:.3} on the page, {} dots", chosen.len());
        assert!(of_page >= 0.75, "tone {tone}: {of_page}");
        // Two even layers over each other are close to white noise, and the test would see it.
        assert!(of_lists < 0.7, "tone {tone}: {of_lists}");
        // As many as N_i asks for, to the rank of a voxel in the mask; points of the lists, where they were, whole.
        assert!((chosen.len() as f64 / first.len() as f64 - 1.0).abs() < 0.02, "{} {}", chosen.len(), first.len());
        assert!(chosen.iter().all(|dot| all.contains(&bits(dot.world)) && dot.opacity == 1.0));
        // The same on one thread.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        assert_eq!(pool.install(|| draw(&made, &volume, tone, Even::Page)).0, chosen);
    }
}
