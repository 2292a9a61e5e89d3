//! The halos of a picture prepared for its samples ([HALO-1], [RAY-2]).

use super::brick_occupancy::BrickOccupancy;
use super::error::RenderError;
use super::prepared_seeds::{PreparedSeeds, can_seed_at};
use crate::volumetric_halos::{PreparedHalo, guard};
use drypoint_scene::glam::DVec3;
use drypoint_scene::inputs::ObjectData;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::{BlendSpace, SampleQuery, Shot};
use drypoint_scene::volume::{BRICK, Bricks};

/// Halos, and the queries of samples for their seeds.
pub(super) struct PreparedHalos<'v> {
    pub(super) list: Vec<PreparedHalo>,
    /// The seeds among the samples of the volume; none if all halos take other parts.
    pub(super) seeds: Option<PreparedSeeds<'v>>,
    /// The bricks of the volume in which a sample can seed; none if nothing is skipped.
    pub(super) skip: Option<BrickOccupancy>,
}

impl<'v> PreparedHalos<'v> {
    /// Prepares the halos of a shot. Returns none if it has none.
    ///
    /// # Errors
    /// The nodes of an h_v do not make a function, or labels were not handed over.
    pub(super) fn new(
        shot: &Shot,
        data: &ObjectData<'v>,
        bricks: Option<&Bricks>,
        over_two: Option<SampleQuery>,
        rounded: impl Fn(f64) -> f64 + Copy,
    ) -> Result<Option<Self>, RenderError> {
        let (halos, object) = (&shot.halos, shot.background());
        if halos.list.is_empty() {
            return Ok(None);
        }
        let list = Self::list(shot);
        if shot.combination.is_some() && !halos.list.iter().any(|halo| halo.seed.can_seed()) {
            return Ok(Some(Self { list, seeds: None, skip: None }));
        }
        let seeds = PreparedSeeds::new((&halos.list, halos.query), data, object.label_lookup, over_two)?;
        // A brick is skipped if none of its samples can seed.
        let grid = data.volume.grid();
        let cells = data.volume.dims().map(|n| n.max(2) - 1);
        let can_seed = |brick: [usize; 3], range: [f64; 2]| {
            let first = brick.map(|i| i * BRICK);
            let end: [usize; 3] = std::array::from_fn(|a| (first[a] + BRICK).min(cells[a]));
            let [lo, hi] = [first, end].map(|corner| DVec3::from_array(corner.map(|i| i as f64)));
            let centre = grid.to_world((lo + hi) * 0.5);
            // On an axis of length 1, coordinates reach half a voxel beyond.
            let half = (hi - lo) * 0.5 + DVec3::splat(0.5);
            let radius = grid.axes().x_axis.length() * half.x
                + grid.axes().y_axis.length() * half.y
                + grid.axes().z_axis.length() * half.z;
            halos.list.iter().zip(&seeds.list).any(|(params, seeding)| {
                can_seed_at(&params.seed, &object.function, range, rounded)
                    && seeding.focus.as_ref().is_none_or(|focus| focus.can_reach(centre, radius))
                    && seeding.labels.as_ref().is_none_or(|wanted| {
                        let labels = seeds.labels.as_ref();
                        labels.is_none_or(|labels| labels.ids_in(first, end).iter().any(|id| wanted.contains(id)))
                    })
            })
        };
        let skip = bricks.map(|bricks| BrickOccupancy::new(bricks, can_seed));
        Ok(Some(Self { list, seeds: Some(seeds), skip }))
    }

    /// The halos of a shot, in their order.
    pub(super) fn list(shot: &Shot) -> Vec<PreparedHalo> {
        let encode = shot.blend_space == BlendSpace::Srgb;
        let is_watched = |i: usize| shot.layers.contains(&LayerKind::Halo(i));
        let halos = shot.halos.list.iter().enumerate();
        halos.map(|(i, halo)| PreparedHalo::new(halo, encode, is_watched(i))).collect()
    }

    /// Number of rays of the guard band that all halos need around the picture.
    pub(super) fn guard(&self) -> usize {
        guard(&self.list)
    }

    /// The index of a halo among those that layers show.
    pub(super) fn watched_place(&self, halo: usize) -> Option<usize> {
        let is_watched = self.list.get(halo).is_some_and(|halo| halo.is_watched);
        is_watched.then(|| self.list[..halo].iter().filter(|halo| halo.is_watched).count())
    }

    /// The number of halos that layers show.
    pub(super) fn watched(&self) -> usize {
        self.list.iter().filter(|halo| halo.is_watched).count()
    }
}
