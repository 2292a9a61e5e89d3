//! Plane order: the rays of a picture plane by plane, tile by tile without halos, and all together with them ([HALO-1],
//! [HALO-8]).

use super::cast::Cast;
use super::object_ray::ObjectRay;
use super::seed_rays::SeedRays;
use super::waiting_tile::{ENDED, WaitingTile};
use crate::number::Real;
use crate::ray::draw::RayRect;
use crate::ray::prepared::Prepared;
use crate::ray::prepared_halos::PreparedHalos;
use crate::ray::progress::FrameProgress;
use crate::ray::tile_work::{TileRays, TileWork};
use crate::volumetric_halos::HaloPlanes;
use drypoint_scene::counts::Counts;
use drypoint_scene::parallel;

/// The results of the rays of each tile, in their order.
type Casts = Vec<(Vec<Cast>, Counts)>;

/// The largest number of bytes for the rays of a region with halos: their states with a short path each, seed rays, the
/// objects on all of them, and the images.
pub(crate) fn bytes_with_halos<R: Real>(
    prepared: &Prepared<'_, R>,
    halos: &PreparedHalos<'_>,
    [width, height]: [usize; 2],
) -> u64 {
    let with_guard = |side: usize| (side as u64).saturating_add(2u64.saturating_mul(halos.guard() as u64));
    let inside = (width as u64).saturating_mul(height as u64);
    let images = HaloPlanes::BYTES_OF_PIXEL * halos.list.len() as u64;
    let of_band = with_guard(width).saturating_mul(with_guard(height));
    let objects = prepared.combination.as_ref().map_or(0, |objects| ObjectRay::most_bytes(objects) + SLOT);
    let rays = inside.saturating_mul(WaitingTile::<'_, '_, R>::BYTES_OF_RAY + objects);
    rays.saturating_add(of_band.saturating_mul(SeedRays::<'_, '_, R>::BYTES_OF_RAY + objects + images))
}

/// Bytes of the pointer to the objects of a ray, and of two more ranges of samples.
const SLOT: u64 = 40;

/// Casts the rays of a tile plane by plane, without halos.
pub(crate) fn cast_all<R: Real>(prepared: &Prepared<'_, R>, work: TileWork<'_>) {
    let TileWork { points, boxes, counts, casts } = work;
    // Places are read only with halos.
    let rays = TileRays { points: points.to_vec(), places: vec![[0; 2]; points.len()], boxes: boxes.cloned() };
    let mut tile = WaitingTile::new(prepared, rays, 0);
    while tile.next != ENDED {
        tile.visit(tile.next);
    }
    let (found, own) = tile.finish();
    casts.extend(found);
    counts.add(&own);
}

/// Casts the rays of a region with halos, one chunk of planes after the other. A chunk ends with a group of some halo.
///
/// In each chunk rays first composite their samples and the glow behind each plane, with the halos of the chunk's
/// beginning. Then samples seed: also invisible ones, those of rays that have ended, and those in a guard band about
/// the region. At the end of the chunk, seeds become intensities. So within a chunk rays are independent and may run on
/// any thread.
pub(crate) fn cast_with_halos<R: Real>(
    (prepared, halos): (&Prepared<'_, R>, &PreparedHalos<'_>),
    tiles: Vec<TileRays>,
    region: RayRect,
    progress: FrameProgress<'_>,
) -> Casts {
    let mut planes = HaloPlanes::new(&halos.list, region.size);
    let watched = halos.watched();
    let mut tiles: Vec<WaitingTile<'_, '_, R>> =
        parallel::map_of(tiles, &|_, tile| WaitingTile::new(prepared, tile, watched));
    let mut counts = Counts::default();
    let mut seeds = SeedRays::new(prepared, halos, region, planes.size(), &mut counts);
    counts.bytes.insert("rays".into(), tiles.iter().map(WaitingTile::bytes).sum());
    counts.bytes.insert("seed_rays".into(), seeds.bytes());
    counts.bytes.insert("halos".into(), planes.bytes());
    let first = tiles.iter().map(|tile| tile.next).min().unwrap_or(ENDED).min(seeds.next());
    let last = tiles.iter().filter_map(WaitingTile::last).max().unwrap_or(first);
    let mut ended = first - 1;
    loop {
        // The next chunk. It follows the last one if rays or seeds wait; otherwise planes without samples are skipped.
        let next = tiles.iter().map(|tile| tile.next).min().unwrap_or(ENDED);
        let next_seeds = seeds.next();
        let is_waiting = planes.is_waiting();
        let seeds_count = planes.outlive_samples() && next_seeds != ENDED;
        if progress.is_stopped() || !(is_waiting && planes.outlive_samples() || next != ENDED || seeds_count) {
            break;
        }
        let begin = if is_waiting { ended + 1 } else { next.min(next_seeds) };
        // Up to the end of the group with the next seeds, the rays' halos do not change.
        let end = match (is_waiting, next_seeds) {
            (true, _) => planes.group_end(begin),
            (false, ENDED) => ENDED - 1,
            (false, seeds) => planes.group_end(seeds),
        };
        // Compositing.
        if planes.reach_all_rays() {
            parallel::each_of(tiles.iter_mut().collect(), &|_, tile: &mut WaitingTile<'_, '_, R>| {
                tile.visit_glowing([begin, end], &planes);
            });
        } else {
            let waiting = tiles.iter_mut().filter(|tile| tile.next <= end).collect();
            parallel::each_of(waiting, &|_, tile: &mut WaitingTile<'_, '_, R>| tile.visit_tinted(end, &planes));
        }
        // Seeds count as long as a pixel in their reach is open.
        let open: Vec<bool> = tiles.iter().map(|tile| tile.is_open).collect();
        if !open.contains(&true) {
            break;
        }
        seeds.keep_near(open);
        if next_seeds <= end {
            seeds.visit(end, &mut planes, &mut counts);
        }
        planes.end(end);
        ended = end;
        progress.tell((ended.min(last) - first) as f64 / (last - first).max(1) as f64);
    }
    counts.halo_passes += planes.passes();
    let mut casts: Casts = parallel::map_of(tiles, &|_, tile| tile.finish());
    if let Some((_, of_first)) = casts.first_mut() {
        of_first.add(&counts);
    }
    casts
}
