//! Adaptive antialiasing ([RAY-7]): each pixel is that of one ray, of five or of nine, and how it was drawn shows nowhere.

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

/// A colour as it is displayed.
fn displayed([r, g, b, a]: Rgba) -> Rgba {
    let [r, g, b] = [r, g, b].map(|c| linear_to_srgb(c.clamp(0.0, 1.0)));
    [r, g, b, a]
}

fn differ(a: Rgba, b: Rgba, contrast: f64) -> bool {
    (0..4).any(|c| (a[c] - b[c]).abs() > contrast)
}

/// Whether each pixel of a picture of one ray a pixel differs from a neighbour by more than the contrast.
fn at_edges(one: &Shown, contrast: f64) -> Vec<bool> {
    let size = [one.picture.width, one.picture.height];
    let pixels: Vec<Rgba> = one.pixels().into_iter().map(displayed).collect();
    (0..pixels.len()).map(|at| around(at, size).any(|near| differ(pixels[at], pixels[near], contrast))).collect()
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

/// The parts of a pixel of five rays.
const FIVE: [usize; 5] = [0, 2, 4, 6, 8];

/// Each pixel has the bits of one ray or, if it differs from a neighbour, of five or of nine; layers that are no means have those of the middle ray everywhere. No middle ray is cast twice.
#[test]
fn each_pixel_is_that_of_one_ray_of_five_or_of_nine() {
    let [mut refined, mut kept, mut lined] = [0; 3];
    let [mut fives, mut nines] = [0; 2];
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
        // The bits of the beauty tell whether a pixel has nine rays, if these differ at all.
        let [of_auto, of_one, of_nine] = [&auto, &one, &nine].map(|shown| shown.pixels());
        let bits = |color: Rgba| color.map(f64::to_bits);
        let has_nine = |at: usize| bits(of_auto[at]) == bits(of_nine[at]) && bits(of_one[at]) != bits(of_nine[at]);
        for layer in &auto.picture.layers {
            let is_mean = matches!(
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
                    let wanted = match (is_mean && at_edges[at], has_nine(at)) {
                        (false, _) => one[at],
                        (true, true) => nine[at],
                        (true, false) => continue,
                    };
                    let context = format!("seed {seed}, {} of pixel {at}: {:?}", layer.kind, stage.scene);
                    assert_eq!(value.to_bits(), wanted.to_bits(), "{context}");
                }
            }
        }
        let pixels = at_edges.len();
        assert_eq!(auto.counts.refined_pixels, edges as u64, "seed {seed}");
        // Four further rays, or eight.
        let further = auto.counts.rays as usize - pixels;
        assert_eq!(further % 4, 0);
        assert!((4 * edges..=8 * edges).contains(&further), "seed {seed}: {further} of {edges}");
        (fives, nines) = (fives + 2 * edges - further / 4, nines + further / 4 - edges);
        assert_eq!([one.counts.refined_pixels, nine.counts.refined_pixels], [0; 2]);
        // Of each nine rays the middle one's samples were counted before.
        let bounds = [one.counts.samples, nine.counts.samples];
        assert!((bounds[0]..=bounds[1]).contains(&auto.counts.samples), "seed {seed}");
        refined += usize::from(edges > 0);
        kept += usize::from(edges > 0 && edges < pixels);
        lined += usize::from(edges > 0 && lines.is_some());
    }
    println!("{refined} scenes with edges, {kept} of them with other pixels, {lined} with lines; {fives} {nines}");
    assert!(refined > 70 && kept > 50 && lined > 20, "{refined} {kept} {lined}");
    assert!(fives > 500 && nines > 500, "{fives} {nines}");
}

/// The rays of a pixel are pixels of a picture of three times the size: a pixel at an edge is the mean of five of them, or
/// of nine if two of the five differ by more than the contrast.
#[test]
fn five_rays_ask_for_nine() {
    let [mut fives, mut nines] = [0; 2];
    for seed in 12_400..12_440 {
        let mut stage = stage(seed).with(|s| s.picture.layers = vec![LayerKind::Beauty]);
        // A picture behind has a size.
        stage.behind = None;
        let contrast = stage.scene.picture.contrast;
        let of =
            |samples, size| stage.with(|s| (s.picture.samples, s.picture.size) = (samples, size)).render().pixels();
        let [width, height] = stage.scene.picture.size;
        let fine = of(RaysPerPixel::Across(1), [3 * width, 3 * height]);
        let [auto, one] = [RaysPerPixel::Auto, RaysPerPixel::Across(1)].map(|samples| of(samples, [width, height]));
        let pixels: Vec<Rgba> = one.iter().copied().map(displayed).collect();
        for (at, color) in auto.into_iter().enumerate() {
            let ray = |part: usize| fine[(3 * (at / width) + part / 3) * 3 * width + 3 * (at % width) + part % 3];
            let is_edge = around(at, [width, height]).any(|near| differ(pixels[at], pixels[near], contrast));
            let five = FIVE.map(|part| displayed(ray(part)));
            let are_apart = five.iter().any(|a| five.iter().any(|b| differ(*a, *b, contrast)));
            let parts: Vec<usize> = match (is_edge, are_apart) {
                (false, _) => vec![4],
                (true, false) => FIVE.to_vec(),
                (true, true) => (0..9).collect(),
            };
            let mean = |c: usize| parts.iter().map(|&part| ray(part)[c]).sum::<f64>() / parts.len() as f64;
            // A ray through the same point by another way is rounded otherwise.
            assert!((0..4).all(|c| (color[c] - mean(c)).abs() < 1e-9), "seed {seed}, pixel {at}: {color:?} {parts:?}");
            (fives, nines) = (fives + usize::from(parts.len() == 5), nines + usize::from(parts.len() == 9));
        }
    }
    assert!(fives > 100 && nines > 100, "{fives} {nines}");
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
