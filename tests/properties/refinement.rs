//! Adaptive antialiasing ([RAY-7]): each pixel is that of one ray or that of nine, and how it was drawn shows nowhere.

use super::generator::{resized, scene};
use super::planes::{counted, lines};
use crate::common::{Shown, Stage, volume};
use drypoint::reference::ray::Renderer;
use drypoint::scene::color::{Rgba, linear_to_srgb};
use drypoint::scene::fragments::Fragments;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::RaysPerPixel;
use std::sync::Mutex;

/// The places of a pixel and its neighbours, counted row by row.
fn around(at: usize, [width, height]: [usize; 2]) -> impl Iterator<Item = usize> {
    let near = |x: usize, n: usize| (0..n).filter(move |i| i.abs_diff(x) <= 1);
    near(at / width, height).flat_map(move |row| near(at % width, width).map(move |column| row * width + column))
}

/// Whether each pixel of a picture of one ray a pixel differs from a neighbour by more than the contrast.
fn at_edges(one: &Shown, contrast: f64) -> Vec<bool> {
    let size = [one.picture.width, one.picture.height];
    let displayed = |[r, g, b, a]: Rgba| {
        let [r, g, b] = [r, g, b].map(|c| linear_to_srgb(c.clamp(0.0, 1.0)));
        [r, g, b, a]
    };
    let pixels: Vec<[f64; 4]> = one.pixels().into_iter().map(displayed).collect();
    let differ = |a: [f64; 4], b: [f64; 4]| (0..4).any(|c| (a[c] - b[c]).abs() > contrast);
    (0..pixels.len()).map(|at| around(at, size).any(|near| differ(pixels[at], pixels[near]))).collect()
}

/// Lines inside the picture of every third scene.
fn lines_of(stage: &Stage, seed: u64) -> Option<Fragments> {
    seed.is_multiple_of(3).then(|| lines(stage, seed))
}

/// A random scene with edges to refine.
fn stage(seed: u64) -> Stage {
    resized(&scene(seed), [21, 13]).with(|s| {
        // Levels of detail need equally many rays in all pixels.
        s.style_mipmaps = None;
        s.picture.samples = RaysPerPixel::Auto;
        s.picture.contrast = [0.0625, 0.0625, 0.0, 0.3][seed as usize % 4];
    })
}

/// Each pixel has the bits of one ray or, if it differs from a neighbour, those of nine; layers that are no means have those
/// of the middle ray everywhere. No middle ray is cast twice.
#[test]
fn each_pixel_is_that_of_one_ray_or_of_nine() {
    let [mut refined, mut kept, mut lined] = [0; 3];
    for seed in 12_000..12_160 {
        let stage = stage(seed);
        let lines = lines_of(&stage, seed);
        let by = |samples| {
            stage.with(|s| s.picture.samples = samples).render_by(|mut renderer| {
                renderer.merge(lines.clone());
                renderer
            })
        };
        let [auto, one, nine] = [RaysPerPixel::Auto, RaysPerPixel::Across(1), RaysPerPixel::Across(3)].map(by);
        let at_edges = at_edges(&one, stage.scene.picture.contrast);
        let edges = at_edges.iter().filter(|is| **is).count();
        for layer in &auto.picture.layers {
            let has_nine = matches!(
                layer.kind,
                LayerKind::Beauty
                    | LayerKind::Normal
                    | LayerKind::Gradient
                    | LayerKind::Curvature
                    | LayerKind::CurvatureAlongView
                    | LayerKind::Part(_)
            );
            let [one, nine] = [&one, &nine].map(|shown| &shown.picture.layer(layer.kind).unwrap().channels);
            for ((auto, one), nine) in layer.channels.iter().zip(one).zip(nine) {
                for (at, value) in auto.iter().enumerate() {
                    let wanted = if has_nine && at_edges[at] { nine[at] } else { one[at] };
                    let context = format!("seed {seed}, {} of pixel {at}: {:?}", layer.kind, stage.scene);
                    assert_eq!(value.to_bits(), wanted.to_bits(), "{context}");
                }
            }
        }
        let pixels = at_edges.len();
        assert_eq!(auto.counts.refined_pixels, edges as u64, "seed {seed}");
        assert_eq!(auto.counts.rays, (pixels + 8 * edges) as u64, "seed {seed}");
        assert_eq!([one.counts.refined_pixels, nine.counts.refined_pixels], [0; 2]);
        // Of each nine rays the middle one's samples were counted before.
        let bounds = [one.counts.samples, nine.counts.samples];
        assert!((bounds[0]..=bounds[1]).contains(&auto.counts.samples), "seed {seed}");
        refined += usize::from(edges > 0);
        kept += usize::from(edges > 0 && edges < pixels);
        lined += usize::from(edges > 0 && lines.is_some());
    }
    println!("{refined} scenes with edges, {kept} of them with other pixels, {lined} with lines");
    assert!(refined > 70 && kept > 50 && lined > 20, "{refined} {kept} {lined}");
}

/// Tiles, lanes, threads and the order of samples change no bit and no count; layers change none of the picture.
#[test]
fn how_it_was_drawn_shows_nowhere() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    let mut refined = 0;
    for seed in 12_200..12_260 {
        let stage = stage(seed);
        let lines = lines_of(&stage, seed);
        let by = |set: &(dyn Fn(Renderer<'_>) -> Renderer<'_> + Sync)| {
            stage.render_by(|mut renderer| {
                renderer.merge(lines.clone());
                set(renderer)
            })
        };
        let plain = by(&|renderer| renderer);
        let others: [&(dyn Fn(Renderer<'_>) -> Renderer<'_> + Sync); 6] = [
            &|renderer| renderer.with_tiles(1),
            &|renderer| renderer.with_tiles(5),
            &|renderer| renderer.with_tiles(1024),
            &|renderer| renderer.ray_by_ray(),
            &|renderer| renderer.plane_by_plane(),
            &|renderer| renderer.plane_by_plane().with_tiles(3),
        ];
        let three = pool.install(|| by(&|renderer| renderer));
        for other in others.iter().map(|set| by(*set)).chain([three]) {
            assert_eq!(other.bits(), plain.bits(), "seed {seed}: {:?}", stage.scene);
            assert_eq!(counted(&other.counts), counted(&plain.counts), "seed {seed}");
            assert_eq!(other.counts.bytes["refinement"], plain.counts.bytes["refinement"], "seed {seed}");
        }
        // The beauty by which edges are found need not be a layer.
        let means = stage.with(|s| s.picture.layers = vec![LayerKind::Normal]).render_by(|mut renderer| {
            renderer.merge(lines.clone());
            renderer
        });
        assert_eq!(means.picture.layers.len(), 1);
        assert_eq!(means.layer_bits(LayerKind::Normal), plain.layer_bits(LayerKind::Normal), "seed {seed}");
        refined += usize::from(plain.counts.refined_pixels > 0);
    }
    assert!(refined > 25, "{refined}");
}

/// A line of one pixel in the picture behind, at a border of tiles or of batches or next to one: it and its neighbours on
/// both sides are refined.
#[test]
fn edges_at_borders_of_tiles_and_batches_are_seen_from_both_sides() {
    let empty = volume([2; 3], |_| 0.0);
    let [width, height] = [1040, 9];
    let nothing = Stage::regular(empty, &[(1.0, [1.0; 3], 0.0)]).with(|s| {
        s.picture.size = [width, height];
        s.picture.samples = RaysPerPixel::Auto;
    });
    for column in [0, 7, 8, 1023, 1024, 1039] {
        let mut stage = nothing.clone();
        let pixel = |at: usize| if at % width == column { [0.1, 0.1, 0.1, 1.0] } else { [0.0, 0.0, 0.0, 1.0] };
        stage.behind = Some((0..width * height).map(pixel).collect());
        let columns = 3 - usize::from(column == 0 || column == width - 1);
        // Tiles of 1024 pixels each way are a batch each.
        for side in [8, 1024] {
            let shown = stage.render_in_tiles(side);
            assert_eq!(shown.counts.refined_pixels, (columns * height) as u64, "{column} in tiles of {side}");
        }
    }
}

/// Progress never falls, and ends at 1 with edges and without.
#[test]
fn progress_ends_at_one() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for seed in 12_300..12_310 {
        let heard = Mutex::new(Vec::new());
        let stage = stage(seed);
        pool.install(|| {
            stage.render_by(|renderer| {
                renderer.frame(&|share| heard.lock().unwrap().push(share));
                renderer
            })
        });
        let heard = heard.into_inner().unwrap();
        assert!(heard.is_sorted() && heard.first().is_some_and(|&share| share > 0.0), "seed {seed}: {heard:?}");
        assert_eq!(heard.last(), Some(&1.0), "seed {seed}");
    }
}
