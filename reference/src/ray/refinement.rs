//! Adaptive antialiasing ([RAY-7]): one ray for each pixel, then the corners of its 3×3 at edges, then all nine where
//! those five differ.
//!
//! The first picture has one ray for each pixel. It alone determines which pixels are refined, and the five rays of a
//! pixel alone determine whether it gets nine, so neither threads nor tiles change the result. The first ray is the middle
//! one of the nine and is not cast again.

use super::composite::{Cast, Sums, covering_objects};
use super::draw::{BATCH, Casting, Drawn, TilePlace, behind, draw, tiles_across};
use super::pixel_sum::{PixelSum, over};
use super::prepared::Prepared;
use super::progress::FrameProgress;
use super::tile_work::{CastAll, TileWork};
use crate::number::Real;
use drypoint_scene::backdrop::Backdrop;
use drypoint_scene::color::{Rgba, linear_to_srgb};
use drypoint_scene::counts::Counts;
use drypoint_scene::parallel;
use drypoint_scene::picture::{LayerKind, Picture};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Rays across a refined pixel.
pub(super) const ACROSS: usize = 3;

/// Index of the part of a refined pixel whose centre is the pixel's.
const MIDDLE: usize = ACROSS * ACROSS / 2;

/// The corners of a refined pixel's 3×3, and the middles of its sides.
const CORNERS: [usize; 4] = [0, 2, 6, 8];
const SIDES: [usize; 4] = [1, 3, 5, 7];

/// The parts of a refined pixel that are cast, in the order in which they are summed, without and with its sides.
pub(super) const PARTS: [&[usize]; 2] = [&[0, 2, 4, 6, 8], &[0, 1, 2, 3, 4, 5, 6, 7, 8]];

/// The largest number of bytes for each pixel that refinement needs beside the picture.
pub(super) fn bytes_a_pixel(layers: &[LayerKind]) -> usize {
    let beauty = if layers.contains(&LayerKind::Beauty) { 0 } else { size_of::<Rgba>() };
    let sums = if keeps_sums(layers) { size_of::<Option<Box<Sums>>>() + bytes_of_sums(layers) } else { 0 };
    size_of::<bool>() + beauty + sums
}

/// Bytes of the sums of a ray.
fn bytes_of_sums(layers: &[LayerKind]) -> usize {
    size_of::<Sums>() + covering_objects(layers) * size_of::<f64>()
}

/// Draws a picture in tiles of `side` pixels. Pixels are refined where neighbours differ by more than `contrast`.
pub(super) fn draw_refined<R: Real>(
    prepared: &Prepared<'_, R>,
    contrast: f64,
    cast_all: &dyn CastAll,
    background: Backdrop<'_>,
    side: usize,
    progress: FrameProgress<'_>,
) -> (Picture, Counts) {
    // The first picture, half of the progress. It includes a beauty, in which edges are found.
    let mut layers = prepared.layers.clone();
    if !layers.contains(&LayerKind::Beauty) {
        layers.push(LayerKind::Beauty);
    }
    let drawn = Drawn { layers: &layers, keeps_sums: keeps_sums(&layers) };
    let [first_half, second_half] = [[0.0, 0.5], [0.5, 1.0]].map(|half| progress.part(half));
    let (mut picture, sums, mut counts) =
        draw(prepared, &drawn, &Casting::ByTile(cast_all), background, [side, 0], first_half);
    // The pixels at edges.
    let beauty = picture.layer(LayerKind::Beauty).map_or(&[][..], |layer| &layer.channels);
    let refined = pixels_at_edges(beauty, prepared.view.size, contrast);
    let kept = sums.iter().flatten().count() * bytes_of_sums(&layers) + size_of_val(sums.as_slice());
    let own_beauty = if layers.len() > prepared.layers.len() { refined.len() * size_of::<Rgba>() } else { 0 };
    counts.bytes.insert("refinement".into(), (refined.len() + kept + own_beauty) as u64);
    counts.refined_pixels = refined.iter().filter(|&&is| is).count() as u64;
    // The further rays of these pixels, tile by tile.
    layers.retain(|&layer| is_refined(layer));
    let [across, down] = tiles_across(prepared, side);
    let tiles = across * down;
    let done = AtomicUsize::new(0);
    let batch = BATCH / (side * side);
    for from in (0..tiles).step_by(batch) {
        let first = FirstPicture {
            beauty: picture.layer(LayerKind::Beauty).map_or(&[][..], |layer| &layer.channels),
            sums: &sums,
            refined: &refined,
            contrast,
        };
        let refine = |tile: usize| {
            if progress.is_stopped() {
                return RefinedTile::default();
            }
            let refined = first.refine(prepared, &layers, cast_all, background, TilePlace::new(prepared, tile, side));
            second_half.tell((1 + done.fetch_add(1, Ordering::Relaxed)) as f64 / tiles as f64);
            refined
        };
        let refined = parallel::map(tiles.min(from + batch) - from, &|tile| refine(from + tile));
        for tile in refined {
            counts.add(&tile.counts);
            let channels = picture.layers.iter_mut().filter(|layer| is_refined(layer.kind));
            let mut channels: Vec<_> = channels.flat_map(|layer| &mut layer.channels).collect();
            for (at, values) in tile.pixels.into_iter().zip(tile.values.chunks_exact(channels.len())) {
                for (channel, value) in channels.iter_mut().zip(values) {
                    channel[at] = *value;
                }
            }
        }
    }
    picture.layers.truncate(prepared.layers.len());
    (picture, counts)
}

/// Whether refinement changes a layer. Other layers keep the numbers of the middle ray.
fn is_refined(layer: LayerKind) -> bool {
    layer == LayerKind::Beauty || layer.is_mean()
}

/// Whether layers need the sums of the first picture's rays.
fn keeps_sums(layers: &[LayerKind]) -> bool {
    layers.iter().any(|layer| layer.is_mean())
}

/// The picture of one ray a pixel.
struct FirstPicture<'p> {
    /// R, G, B and A.
    beauty: &'p [Vec<f64>],
    /// The sums of each ray, if they are kept.
    sums: &'p [Option<Box<Sums>>],
    /// Which pixels are refined.
    refined: &'p [bool],
    /// The largest difference between rays of which no more are cast.
    contrast: f64,
}

/// The refined pixels of a tile.
#[derive(Default)]
struct RefinedTile {
    /// Their indices in the picture, row by row.
    pixels: Vec<usize>,
    /// The channels of their layers, pixel by pixel.
    values: Vec<f64>,
    counts: Counts,
}

impl FirstPicture<'_> {
    /// Casts the further rays of the refined pixels of a tile. Rays are summed in the order of their parts, so that a pixel
    /// of nine is that of 3×3 rays everywhere, bit for bit.
    fn refine<R: Real>(
        &self,
        prepared: &Prepared<'_, R>,
        layers: &[LayerKind],
        cast_all: &dyn CastAll,
        background: Backdrop<'_>,
        place: TilePlace,
    ) -> RefinedTile {
        let width = prepared.view.size[0];
        let in_picture = |[i, j]: [usize; 2]| [place.at[0] + i, place.at[1] + j];
        let index = |pixel| {
            let [x, y] = in_picture(pixel);
            y * width + x
        };
        let mut tile = RefinedTile { pixels: Vec::new(), values: Vec::new(), counts: Counts::default() };
        let mut pixels = place.pixels();
        pixels.retain(|&pixel| self.refined[index(pixel)]);
        if pixels.is_empty() {
            return tile;
        }
        // The four rays of a pixel follow each other, so that they can be cast side by side.
        let mut boxes = place.boxes(prepared);
        let mut cast = |pixels: &[[usize; 2]], parts: [usize; 4]| {
            let points = pixels.iter().flat_map(|&pixel| parts.map(|part| place.point(pixel, part, ACROSS)));
            let points: Vec<[f64; 2]> = points.collect();
            let mut casts = Vec::with_capacity(points.len());
            let (boxes, counts) = (boxes.as_mut(), &mut tile.counts);
            cast_all(TileWork { points: &points, boxes, counts, casts: &mut casts });
            casts
        };
        let corners = cast(&pixels, CORNERS);
        // The pixels whose five rays differ.
        let behind = behind(background, width);
        let is_apart = |(pixel, corners): (&[usize; 2], &[Cast])| {
            let behind = behind(in_picture(*pixel));
            let colors = corners.iter().map(|cast| over(cast.rgba, behind, prepared.encode));
            are_apart(colors.chain([color_at(self.beauty, index(*pixel))]).map(displayed), self.contrast)
        };
        let are_apart: Vec<bool> = pixels.iter().zip(corners.chunks_exact(CORNERS.len())).map(is_apart).collect();
        let apart: Vec<_> = pixels.iter().zip(&are_apart).filter(|(_, is)| **is).map(|(pixel, _)| *pixel).collect();
        let mut sides = cast(&apart, SIDES).into_iter();
        let mut corners = corners.into_iter();
        for (pixel, &is_apart) in pixels.into_iter().zip(&are_apart) {
            let at = index(pixel);
            let mut sum = PixelSum::default();
            for &part in PARTS[usize::from(is_apart)] {
                if part == MIDDLE {
                    let sums = self.sums.get(at).and_then(|sums| sums.as_deref());
                    sum.add_means(color_at(self.beauty, at), sums);
                } else if let Some(cast) = if CORNERS.contains(&part) { corners.next() } else { sides.next() } {
                    sum.add(prepared, cast, behind(in_picture(pixel)));
                }
            }
            sum.append(prepared, layers, &mut tile.values);
            tile.pixels.push(at);
        }
        tile
    }
}

/// R, G, B and A of a pixel.
fn color_at(beauty: &[Vec<f64>], at: usize) -> Rgba {
    std::array::from_fn(|c| beauty[c][at])
}

/// A pixel as it is displayed: R, G and B in [0, 1] and encoded to sRGB, and α. Colours are premultiplied, so a picture
/// without a background is displayed over black.
fn displayed([r, g, b, alpha]: Rgba) -> [f64; 4] {
    let [r, g, b] = [r, g, b].map(|c| linear_to_srgb(c.clamp(0.0, 1.0)));
    [r, g, b, alpha]
}

/// Whether two displayed pixels differ by more than `contrast` in a channel.
fn part(a: &[f64; 4], b: &[f64; 4], contrast: f64) -> bool {
    a.iter().zip(b).any(|(a, b)| (a - b).abs() > contrast)
}

/// Whether two of some displayed rays differ by more than `contrast` in a channel.
fn are_apart(rays: impl Iterator<Item = [f64; 4]>, contrast: f64) -> bool {
    let mut ends = [[f64::INFINITY; 4], [f64::NEG_INFINITY; 4]];
    for ray in rays {
        for (c, value) in ray.into_iter().enumerate() {
            ends[0][c] = ends[0][c].min(value);
            ends[1][c] = ends[1][c].max(value);
        }
    }
    part(&ends[0], &ends[1], contrast)
}

/// Whether each pixel of a picture differs from one of its eight neighbours, row by row.
fn pixels_at_edges(beauty: &[Vec<f64>], [width, height]: [usize; 2], contrast: f64) -> Vec<bool> {
    /// Number of pixels for each task, in whole rows.
    const CHUNK: usize = 1 << 14;
    let rows = (CHUNK / width).max(1);
    let mut at_edges = vec![false; width * height];
    parallel::chunks_mut(&mut at_edges, rows * width, &|chunk, at_edges| {
        // The rows of the chunk, and one more above and below.
        let top = (chunk * rows).saturating_sub(1);
        let bottom = (chunk * rows + rows + 1).min(height);
        let mut last = [[0.0; 4]; 2];
        let pixels = (top * width..bottom * width).map(|at| {
            // Equal pixels, such as those of the background, are converted once.
            let color = color_at(beauty, at);
            if last[0] != color {
                last = [color, displayed(color)];
            }
            last[1]
        });
        let pixels: Vec<[f64; 4]> = pixels.collect();
        for (i, is_at_edge) in at_edges.iter_mut().enumerate() {
            let [x, y] = [i % width, chunk * rows + i / width - top];
            let own = &pixels[y * width + x];
            let columns = x.saturating_sub(1)..(x + 2).min(width);
            let mut near = (y.saturating_sub(1)..(y + 2).min(bottom - top))
                .flat_map(|y| pixels[y * width..][columns.clone()].iter());
            *is_at_edge = near.any(|other| part(own, other, contrast));
        }
    });
    at_edges
}

#[cfg(test)]
mod tests;
