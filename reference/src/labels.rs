//! The label of a sample ([STF-13]).

use crate::field::{CellPosition, Cells};
use crate::number::{Real, Vec3};
use drypoint_scene::glam::DVec3;
use drypoint_scene::other_grid::OtherGrid;
use drypoint_scene::shot::LabelLookup;
use drypoint_scene::space::Grid;
use drypoint_scene::volume::Anatomy;
use drypoint_scene::volume::labels::LabelVolume;

/// A label volume at the positions of a data volume.
///
/// Positions are converted to f64, so that ids do not depend on the number type of the samples.
#[derive(Clone, Debug)]
pub struct Labels<'a> {
    volume: &'a LabelVolume,
    lookup: LabelLookup,
    /// The map between grids; none if data and labels have one grid.
    map: Option<OtherGrid>,
    cells: Cells<f64>,
    /// Number of the labels' voxels along x, y, z.
    dims: [usize; 3],
    /// Distance of neighbouring voxels in linear order; 0 on an axis of length 1.
    strides: [usize; 3],
}

impl<'a> Labels<'a> {
    /// Prepares the lookup of labels at positions of a data volume that lies on `data`, in a world of that anatomy
    /// ([SPACE-2]).
    pub fn new(volume: &'a LabelVolume, data: &Grid, world: Option<Anatomy>, lookup: LabelLookup) -> Self {
        let own = volume.grid_in(world);
        let dims = own.dims();
        let stride = [1, dims[0], dims[0] * dims[1]];
        Self {
            volume,
            lookup,
            map: OtherGrid::new(data, &own),
            cells: Cells::new(dims),
            dims,
            strides: std::array::from_fn(|a| if dims[a] == 1 { 0 } else { stride[a] }),
        }
    }

    /// Whether the labels lie on the data's own grid, voxel on voxel.
    pub fn on_same_grid(&self) -> bool {
        self.map.is_none()
    }

    /// The id at a position of the data's index space, inside its box; 0 outside the box of the labels.
    ///
    /// `nearest` takes the nearest voxel in index space. Of two at equal distance, the lower index holds, as in
    /// [PREC-2]. `smooth` takes the id with the highest sum of trilinear weights among the eight voxels around. Of
    /// equal sums, the smallest id holds.
    #[inline]
    pub fn id_at<R: Real>(&self, p: Vec3<R>) -> u32 {
        R::assigned(p, |p| self.id_at_f64(p))
    }

    #[inline(always)]
    fn id_at_f64(&self, mut p: Vec3<f64>) -> u32 {
        if let Some(map) = &self.map {
            let Some(there) = map.position(p.to_glam()) else { return 0 };
            p = Vec3::from_glam(there);
        }
        let at = self.cells.locate(p);
        match self.lookup {
            LabelLookup::Nearest => self.nearest(at),
            LabelLookup::Smooth => self.smooth(at),
        }
    }

    /// All ids that [`id_at`](Self::id_at) can return in the data's cells from `first` up to, but excluding, `end`,
    /// in ascending order ([RAY-2]). The list may contain further ids.
    pub fn ids_in(&self, first: [usize; 3], end: [usize; 3]) -> Vec<u32> {
        let Some(map) = &self.map else { return self.ids_of(first, end) };
        let [lo, hi] = map.bounds(first, end);
        let [start, stop] = map.reach();
        let mut ids = if lo.cmple(stop).all() && hi.cmpge(start).all() {
            // The cast takes the floor, since positions clamped to the box are not negative.
            let cell = |p: DVec3| p.clamp(DVec3::ZERO, stop).to_array().map(|x| x as usize);
            self.ids_of(cell(lo), cell(hi).map(|x| x + 1))
        } else {
            Vec::new()
        };
        if !(map.has(lo) && map.has(hi)) && ids.first() != Some(&0) {
            ids.insert(0, 0);
        }
        ids
    }

    /// The ids of the voxels from `first` up to and including `last`, as far as there are any.
    fn ids_of(&self, first: [usize; 3], last: [usize; 3]) -> Vec<u32> {
        let along = |a: usize| first[a]..=last[a].min(self.dims[a] - 1);
        let (mut ids, mut latest) = (Vec::new(), None);
        for z in along(2) {
            for y in along(1) {
                for x in along(0) {
                    let id = self.volume.id((z * self.dims[1] + y) * self.dims[0] + x);
                    if latest.replace(id) != Some(id) {
                        ids.push(id);
                    }
                }
            }
        }
        ids.sort_unstable();
        ids.dedup();
        ids
    }

    #[inline(always)]
    fn linear(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.dims[1] + y) * self.dims[0] + x
    }

    #[inline(always)]
    fn nearest(&self, at: CellPosition<f64>) -> u32 {
        let upper = |a: usize| if at.w[a] > 0.5 { self.strides[a] } else { 0 };
        self.volume.id(self.linear(at.cell) + upper(0) + upper(1) + upper(2))
    }

    #[inline]
    fn smooth(&self, at: CellPosition<f64>) -> u32 {
        let start = self.linear(at.cell);
        let [dx, dy, dz] = self.strides;
        let ids: [u32; 8] =
            std::array::from_fn(|c| self.volume.id(start + (c & 1) * dx + (c >> 1 & 1) * dy + (c >> 2) * dz));
        // The inside of a part, which is almost everywhere.
        if ids.iter().all(|&id| id == ids[0]) {
            return ids[0];
        }
        let [x, y, z] = at.w.map(|w| [1.0 - w, w]);
        let weight: [f64; 8] = std::array::from_fn(|c| x[c & 1] * y[c >> 1 & 1] * z[c >> 2]);
        let (mut highest, mut best) = (-1.0, u32::MAX);
        for &id in &ids {
            let mut sum = 0.0;
            for c in 0..8 {
                sum += if ids[c] == id { weight[c] } else { 0.0 };
            }
            if sum > highest || (sum == highest && id < best) {
                (highest, best) = (sum, id);
            }
        }
        best
    }
}

#[cfg(test)]
mod tests;
