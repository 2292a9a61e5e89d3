//! The rays of a picture, tile by tile.

use super::brick_occupancy::{Beam, RayIntervals};
use super::composite::{Cast, Sums};
use super::lattice::IndexRay;
use super::pixel_sum::PixelSum;
use super::prepared::Prepared;
use super::progress::FrameProgress;
use super::tile_work::{CastAll, TileRays, TileWork};
use crate::number::Real;
use drypoint_scene::backdrop::Backdrop;
use drypoint_scene::color::{self, Rgba};
use drypoint_scene::counts::Counts;
use drypoint_scene::parallel;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use std::borrow::Cow;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Number of pixels that are drawn before they are copied to the picture, so that a huge picture is not in memory
/// twice.
pub(super) const BATCH: usize = 1 << 20;

/// The channels of a tile, pixel by pixel as [`in_blocks`] orders them.
struct TilePixels {
    x: usize,
    y: usize,
    size: [usize; 2],
    pixels: Vec<f64>,
    /// The sums of each pixel's rays, if they are kept.
    sums: Vec<Option<Box<Sums>>>,
    counts: Counts,
}

/// The layers that are drawn.
pub(super) struct Drawn<'l> {
    pub(super) layers: &'l [LayerKind],
    /// Whether the sums of each pixel's rays are kept.
    pub(super) keeps_sums: bool,
}

/// How the rays of a picture are cast.
pub(super) enum Casting<'c> {
    /// Tile by tile, when a tile is drawn.
    ByTile(&'c dyn CastAll),
    /// Band by band. The function casts the rays of a band and returns the results of each tile.
    ByBand(&'c (dyn Fn(Band) -> Vec<(Vec<Cast>, Counts)> + Sync)),
}

/// Some rows of tiles of a picture.
pub(super) struct Band {
    /// Indices of its tiles in the picture.
    pub(super) tiles: Range<usize>,
    /// Its rays.
    pub(super) region: RayRect,
    /// The shares of the picture's progress at which the band begins and ends.
    pub(super) share: [f64; 2],
}

/// A rectangle of rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct RayRect {
    /// Column and row of its first ray.
    pub(super) first: [usize; 2],
    /// Rays across and down.
    pub(super) size: [usize; 2],
    /// Rays along the side of a tile.
    side: usize,
}

impl RayRect {
    /// The columns and the rows of a tile of the region, as half-open ranges.
    pub(super) fn tile(&self, index: usize) -> [[usize; 2]; 2] {
        let across = self.size[0].div_ceil(self.side);
        let at = [index % across * self.side, index / across * self.side];
        [0, 1].map(|a| [at[a], (at[a] + self.side).min(self.size[a])])
    }
}

/// Rows of tiles in a band of about `band` rays, in a picture of this width with n² rays for each pixel.
fn tile_rows([width, n]: [usize; 2], tile: usize, band: usize) -> usize {
    (band / (width * n * n * tile)).clamp(1, 1 << 20)
}

/// Rays across and down of the largest band of a picture.
pub(super) fn largest_band<R: Real>(prepared: &Prepared<'_, R>, tile: usize, band: usize) -> [usize; 2] {
    let ([width, height], n) = (prepared.view.size, prepared.rays_across);
    [width * n, tile_rows([width, n], tile, band).saturating_mul(tile).min(height) * n]
}

/// Casts all rays of a picture, in tiles of `tile` pixels along the side and in bands of about `band` rays. Each pixel
/// is a function of its place alone, so neither threads nor the order of tiles change it ([RAY-3]). Returns also the
/// kept sums of all pixels, row by row.
pub(super) fn draw<R: Real>(
    prepared: &Prepared<'_, R>,
    drawn: &Drawn<'_>,
    casting: &Casting<'_>,
    background: Backdrop<'_>,
    [tile, band]: [usize; 2],
    progress: FrameProgress<'_>,
) -> (Picture, Vec<Option<Box<Sums>>>, Counts) {
    let [width, height] = prepared.view.size;
    let [across, down] = tiles_across(prepared, tile);
    let n = prepared.rays_across;
    let batch = match casting {
        Casting::ByTile(_) => BATCH / (tile * tile),
        Casting::ByBand(_) => across * tile_rows([width, n], tile, band),
    };
    let done = std::sync::atomic::AtomicUsize::new(0);
    let per_pixel: usize = drawn.layers.iter().map(|l| l.channels().len()).sum();
    let mut counts = Counts::default();
    let mut channels = vec![vec![0.0; width * height]; per_pixel];
    let mut sums = Vec::new();
    sums.resize_with(if drawn.keeps_sums { width * height } else { 0 }, || None);
    let whole = in_blocks([tile; 2]);
    for first in (0..across * down).step_by(batch) {
        if progress.is_stopped() {
            break;
        }
        let batch = first..(first + batch).min(across * down);
        let share = [first, batch.end].map(|tile| tile as f64 / (across * down) as f64);
        let cast_before = match casting {
            Casting::ByTile(_) => Vec::new(),
            Casting::ByBand(cast) => {
                let rows = [first, batch.end].map(|tile_index| (tile_index / across * tile).min(height) * n);
                let region = RayRect { first: [0, rows[0]], size: [width * n, rows[1] - rows[0]], side: tile * n };
                cast(Band { tiles: batch.clone(), region, share })
            }
        };
        let draw = |t: usize, cast_before: Option<(Vec<Cast>, Counts)>| {
            let place = TilePlace::new(prepared, t, tile);
            match (casting, cast_before) {
                (Casting::ByTile(_), None) if progress.is_stopped() => place.not_drawn(),
                (Casting::ByTile(cast_all), None) => {
                    let drawn = draw_tile(prepared, drawn, *cast_all, background, place, &whole);
                    let n = 1 + done.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                    progress.tell(n as f64 / (across * down) as f64);
                    drawn
                }
                (_, before) => {
                    let (casts, counts) = before.unwrap_or_default();
                    let casts = Mutex::new(casts.into_iter());
                    let take = |work: TileWork<'_>| {
                        let mut casts = casts.lock().unwrap_or_else(PoisonError::into_inner);
                        work.casts.extend(casts.by_ref().take(work.points.len()));
                    };
                    let mut drawn = draw_tile(prepared, drawn, &take, background, place, &whole);
                    drawn.counts.add(&counts);
                    drawn
                }
            }
        };
        let tiles: Vec<TilePixels> = if cast_before.is_empty() {
            parallel::map(batch.len(), &|t| draw(first + t, None))
        } else {
            parallel::map_of(cast_before, &|t, casts| draw(first + t, Some(casts)))
        };
        // The buffers of a band are reused for the next one.
        let mut of_batch = Counts::default();
        tiles.iter().for_each(|tile| of_batch.add(&tile.counts));
        counts.add_frame(&of_batch);
        for mut tile in tiles {
            let blocks = blocks_of(tile.size, &whole);
            for ([i, j], kept) in blocks.iter().zip(tile.sums.drain(..)) {
                sums[(tile.y + j) * width + tile.x + i] = kept;
            }
            for ([i, j], pixel) in blocks.iter().zip(tile.pixels.chunks_exact(per_pixel)) {
                let at = (tile.y + j) * width + tile.x + i;
                for (channel, value) in channels.iter_mut().zip(pixel) {
                    channel[at] = *value;
                }
            }
        }
    }
    let mut channels = channels.into_iter();
    let layers = drawn
        .layers
        .iter()
        .map(|&kind| Layer { kind, channels: channels.by_ref().take(kind.channels().len()).collect() })
        .collect();
    (Picture { width, height, layers }, sums, counts)
}

/// Casts the rays of one tile.
fn draw_tile<R: Real>(
    prepared: &Prepared<'_, R>,
    drawn: &Drawn<'_>,
    cast_all: &dyn CastAll,
    background: Backdrop<'_>,
    place: TilePlace,
    whole: &[[usize; 2]],
) -> TilePixels {
    let (TilePlace { at: [x, y], size }, mut tile) = (place, place.not_drawn());
    let mut boxes = place.boxes(prepared);
    let blocks = blocks_of(size, whole);
    let behind = behind(background, prepared.view.size[0]);
    let n = prepared.rays_across;
    let mut sums: Vec<PixelSum> = blocks.iter().map(|_| PixelSum::default()).collect();
    let (mut points, mut casts) = (Vec::with_capacity(blocks.len()), Vec::with_capacity(blocks.len()));
    for part in 0..n * n {
        points.clear();
        points.extend(blocks.iter().map(|&pixel| place.point(pixel, part, n)));
        let (boxes, counts) = (boxes.as_mut(), &mut tile.counts);
        cast_all(TileWork { points: &points, boxes, counts, casts: &mut casts });
        for ((sum, cast), place) in sums.iter_mut().zip(casts.drain(..)).zip(&*blocks) {
            sum.add(prepared, cast, behind([x + place[0], y + place[1]]));
        }
    }
    tile.pixels.reserve_exact(blocks.len() * drawn.layers.iter().map(|l| l.channels().len()).sum::<usize>());
    for sum in &sums {
        sum.append(prepared, drawn.layers, &mut tile.pixels);
    }
    if drawn.keeps_sums {
        tile.sums = sums.into_iter().map(|sum| sum.all).collect();
    }
    tile
}

/// The premultiplied background at each pixel of a picture of this width.
pub(super) fn behind(background: Backdrop<'_>, width: usize) -> impl Fn([usize; 2]) -> Rgba {
    let everywhere = match background {
        Backdrop::Color(c) => color::premultiply(c),
        Backdrop::None | Backdrop::Pixels(_) => [0.0; 4],
    };
    move |[i, j]| match background {
        Backdrop::Pixels(pixels) => pixels[j * width + i],
        Backdrop::Color(_) | Backdrop::None => everywhere,
    }
}

/// The rays of the tiles of a band. Each tile's rays are in the order in which [`draw`] reads them.
pub(super) fn rays_of_tiles<R: Real>(prepared: &Prepared<'_, R>, side: usize, band: &Band) -> Vec<TileRays> {
    let n = prepared.rays_across;
    let whole = in_blocks([side; 2]);
    let [left, top] = band.region.first;
    parallel::map(band.tiles.len(), &|index| {
        let place = TilePlace::new(prepared, band.tiles.start + index, side);
        let blocks = blocks_of(place.size, &whole);
        let parts = || (0..n * n).flat_map(|part| blocks.iter().map(move |&pixel| (pixel, part)));
        let ray = |([i, j], part): ([usize; 2], usize)| {
            [(place.at[0] + i) * n + part % n - left, (place.at[1] + j) * n + part / n - top]
        };
        TileRays {
            points: parts().map(|(pixel, part)| place.point(pixel, part, n)).collect(),
            places: parts().map(ray).collect(),
            boxes: place.boxes(prepared),
        }
    })
}

/// The point of a ray of the picture, or of a guard band about it, in pixels from the top left corner. `n` rays lie
/// across a pixel.
pub(super) fn ray_point(n: usize, ray: [i64; 2]) -> [f64; 2] {
    let n = n as i64;
    ray.map(|i| part_centre(i.div_euclid(n) as f64, i.rem_euclid(n) as usize, n as usize))
}

/// The centre of a part of a pixel.
fn part_centre(pixel: f64, part: usize, n: usize) -> f64 {
    pixel + (part as f64 + 0.5) / n as f64
}

/// Tiles across and down.
pub(super) fn tiles_across<R: Real>(prepared: &Prepared<'_, R>, side: usize) -> [usize; 2] {
    prepared.view.size.map(|n| n.div_ceil(side))
}

/// The place of a tile in the picture.
#[derive(Clone, Copy)]
pub(super) struct TilePlace {
    /// Its first pixel.
    pub(super) at: [usize; 2],
    /// Pixels across and down.
    size: [usize; 2],
}

impl TilePlace {
    pub(super) fn new<R: Real>(prepared: &Prepared<'_, R>, index: usize, side: usize) -> Self {
        let [across, _] = tiles_across(prepared, side);
        let at = [index % across * side, index / across * side];
        Self { at, size: [0, 1].map(|a| side.min(prepared.view.size[a] - at[a])) }
    }

    /// The tile before its rays are cast.
    fn not_drawn(self) -> TilePixels {
        let Self { at: [x, y], size } = self;
        TilePixels { x, y, size, pixels: Vec::new(), sums: Vec::new(), counts: Counts::default() }
    }

    /// The point of a part of a pixel. The n×n rays of a pixel go through the centres of its parts ([RAY-6]). The first
    /// part of all pixels is cast first, then the second part, and so on.
    pub(super) fn point(&self, [i, j]: [usize; 2], part: usize, n: usize) -> [f64; 2] {
        [part_centre((self.at[0] + i) as f64, part % n, n), part_centre((self.at[1] + j) as f64, part / n, n)]
    }

    /// The pixels of the tile, relative to its first one, as [`in_blocks`] orders them.
    pub(super) fn pixels(&self) -> Vec<[usize; 2]> {
        in_blocks(self.size)
    }

    /// The boxes of visible bricks that the tile's rays can meet. Returns none if nothing is skipped.
    pub(super) fn boxes<R: Real>(&self, prepared: &Prepared<'_, R>) -> Option<RayIntervals> {
        prepared.skip.as_ref().map(|skip| {
            let corner = |i: usize, j: usize| {
                let ray = prepared.view.ray(i as f64, j as f64);
                IndexRay::<R>::new(&ray, &prepared.view, &prepared.lattice, prepared.object.volume.grid()).rounded()
            };
            let ([x, y], [width, height]) = (self.at, self.size);
            let (right, bottom) = (x + width, y + height);
            let corners = [corner(x, y), corner(right, y), corner(right, bottom), corner(x, bottom)];
            skip.boxes_in(&Beam::new(corners))
        })
    }
}

/// The pixels of a tile as [`in_blocks`] orders them. `whole` holds those of a complete tile.
fn blocks_of(size: [usize; 2], whole: &[[usize; 2]]) -> Cow<'_, [[usize; 2]]> {
    if size[0] * size[1] == whole.len() { Cow::Borrowed(whole) } else { Cow::Owned(in_blocks(size)) }
}

/// The pixels of a tile, in blocks of 4 by 2, so that rays that are cast side by side are close together.
fn in_blocks([width, height]: [usize; 2]) -> Vec<[usize; 2]> {
    let mut pixels = Vec::with_capacity(width * height);
    for y in (0..height).step_by(2) {
        for x in (0..width).step_by(4) {
            for j in y..height.min(y + 2) {
                for i in x..width.min(x + 4) {
                    pixels.push([i, j]);
                }
            }
        }
    }
    pixels
}
