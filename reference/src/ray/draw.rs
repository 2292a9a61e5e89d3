//! The rays of a picture, tile by tile.

use super::cast::cast;
use super::lattice::IndexRay;
use super::layers::{Sums, pooled};
use super::prepared::Prepared;
use super::render::Backdrop;
use super::skip::{Beam, Boxes};
use crate::field::Sampler;
use crate::number::Real;
use drypoint_scene::color::{self, Rgba};
use drypoint_scene::counts::Counts;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use rayon::prelude::*;

/// Pixels that are drawn before they are gathered, so that a huge picture is not in memory twice.
const BATCH: usize = 1 << 20;

/// The channels of a tile, pixel by pixel.
struct Tile {
    x: usize,
    y: usize,
    width: usize,
    pixels: Vec<f64>,
    counts: Counts,
}

/// Casts all rays of a picture. Each pixel is a function of its place alone, so neither threads nor the order of tiles
/// show ([RAY-3]).
pub(super) fn draw<R: Real, S: Sampler<R>>(
    prepared: &Prepared<'_, R>,
    sampler: &S,
    background: Backdrop<'_>,
    tile: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> (Picture, Counts) {
    let [width, height] = prepared.view.size;
    let (across, down) = (width.div_ceil(tile), height.div_ceil(tile));
    let batch = BATCH / (tile * tile);
    let done = std::sync::atomic::AtomicUsize::new(0);
    let per_pixel: usize = prepared.layers.iter().map(|l| l.channels().len()).sum();
    let mut counts = Counts::default();
    let mut channels = vec![vec![0.0; width * height]; per_pixel];
    for first in (0..across * down).step_by(batch) {
        let tiles: Vec<Tile> = (first..(first + batch).min(across * down))
            .into_par_iter()
            .map(|t| {
                let at = [t % across * tile, t / across * tile];
                let drawn = draw_tile(prepared, sampler, background, at, tile);
                let n = 1 + done.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                progress(n as f64 / (across * down) as f64);
                drawn
            })
            .collect();
        for tile in &tiles {
            counts.add(&tile.counts);
            for (i, pixel) in tile.pixels.chunks_exact(per_pixel).enumerate() {
                let at = (tile.y + i / tile.width) * width + tile.x + i % tile.width;
                for (channel, value) in channels.iter_mut().zip(pixel) {
                    channel[at] = *value;
                }
            }
        }
    }
    let mut channels = channels.into_iter();
    let layers = prepared
        .layers
        .iter()
        .map(|&kind| Layer { kind, channels: channels.by_ref().take(kind.channels().len()).collect() })
        .collect();
    (Picture { width, height, layers }, counts)
}

/// Casts the rays of one tile.
fn draw_tile<R: Real, S: Sampler<R>>(
    prepared: &Prepared<'_, R>,
    sampler: &S,
    background: Backdrop<'_>,
    [x, y]: [usize; 2],
    side: usize,
) -> Tile {
    let [width, height] = prepared.view.size;
    let (right, bottom) = ((x + side).min(width), (y + side).min(height));
    let mut tile = Tile { x, y, width: right - x, pixels: Vec::new(), counts: Counts::default() };
    let mut boxes = prepared.skip.as_ref().map(|skip| {
        let corner = |i: usize, j: usize| {
            let ray = prepared.view.ray(i as f64, j as f64);
            IndexRay::<R>::new(&ray, &prepared.view, &prepared.lattice, prepared.volume.grid()).line()
        };
        let corners = [corner(x, y), corner(right, y), corner(right, bottom), corner(x, bottom)];
        skip.boxes_in(&Beam::new(corners, R::EPSILON.to_f64()))
    });
    for j in y..bottom {
        for i in x..right {
            let behind = match background {
                Backdrop::None => [0.0; 4],
                Backdrop::Color(c) => color::premultiply(c),
                Backdrop::Pixels(pixels) => pixels[j * width + i],
            };
            draw_pixel(prepared, sampler, [i, j], behind, &mut boxes, &mut tile);
        }
    }
    tile
}

/// Casts the n×n rays of one pixel through the centres of its parts and appends its channels ([RAY-6]): of the beauty the
/// mean; of the layers that are means themselves the mean over all samples of the pixel; of the others the first ray's.
fn draw_pixel<R: Real, S: Sampler<R>>(
    prepared: &Prepared<'_, R>,
    sampler: &S,
    [i, j]: [usize; 2],
    behind: Rgba,
    boxes: &mut Option<Boxes>,
    tile: &mut Tile,
) {
    let n = prepared.samples;
    let share = 1.0 / (n * n) as f64;
    let mut beauty = [0.0; 4];
    let (mut first, mut all) = (None, Sums::new());
    for part in 0..n * n {
        let centre = |whole: usize, part: usize| whole as f64 + (part as f64 + 0.5) / n as f64;
        let at = [centre(i, part % n), centre(j, part / n)];
        let cast = cast(prepared, sampler, at, boxes.as_mut(), &mut tile.counts);
        for (mean, c) in beauty.iter_mut().zip(over(cast.rgba, behind, prepared.encode)) {
            *mean += c * share;
        }
        all.pool(&cast.sums);
        first.get_or_insert((cast.sums, cast.samples));
    }
    // A pixel has at least one part.
    let (first, samples) = first.unwrap_or((Sums::new(), 0));
    for &kind in &prepared.layers {
        if kind == LayerKind::Beauty {
            tile.pixels.extend(beauty);
        } else {
            let sums = if pooled(kind) { &all } else { &first };
            sums.channels(kind, samples, prepared.field.scale_exponent(), &mut tile.pixels);
        }
    }
}

/// C + (1 − A)·B, A + (1 − A)·A_B ([IO-6]). With encoded compositing the colour comes in encoded; the background's
/// straight colour is encoded and premultiplied, and the result is decoded ([VAL-3]).
fn over([r, g, b, a]: Rgba, behind: Rgba, encode: bool) -> Rgba {
    let through = 1.0 - a;
    let add = |[br, bg, bb, ba]: Rgba| [r + through * br, g + through * bg, b + through * bb, a + through * ba];
    if !encode {
        return add(behind);
    }
    let map = |[r, g, b, a]: Rgba, f: fn(f64) -> f64| [f(r), f(g), f(b), a];
    let behind = color::premultiply(map(color::unpremultiply(behind), color::linear_to_srgb));
    color::premultiply(map(color::unpremultiply(add(behind)), color::srgb_to_linear))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn over_by_hand() {
        assert_eq!(over([0.25, 0.0, 0.0, 0.5], [1.0; 4], false), [0.75, 0.5, 0.5, 1.0]);
        assert_eq!(over([0.25, 0.0, 0.0, 0.5], [0.0; 4], false), [0.25, 0.0, 0.0, 0.5]);
        // Half black over white, encoded: ½ in sRGB is 0.2140 in linear light.
        let got = over([0.0, 0.0, 0.0, 0.5], [1.0; 4], true);
        assert!((got[0] - 0.214_041_140_5).abs() < 1e-9 && got[3] == 1.0, "{got:?}");
    }
}
