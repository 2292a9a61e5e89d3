//! Which part a sample belongs to ([STF-13]).

use crate::field::{Cells, Place};
use crate::number::{Mat3, Real, Vec3};
use drypoint_scene::glam::DVec3;
use drypoint_scene::space::Grid;
use drypoint_scene::tables::LabelLookup;
use drypoint_scene::volume::Anatomy;
use drypoint_scene::volume::labels::LabelVolume;

/// Voxels by which two grids may differ and count as one: headers keep places in single precision, and one says in a
/// matrix what another says in a quaternion. By as much a position may lie outside the box of another grid.
const SLACK: f64 = 1.0 / 1024.0;

/// A label volume at the positions of a data volume.
///
/// Positions are f64 from here on, so that ids do not depend on the number type of the samples.
#[derive(Clone, Debug)]
pub struct Labels<'a> {
    volume: &'a LabelVolume,
    lookup: LabelLookup,
    /// None where data and labels have one grid.
    map: Option<Map>,
    cells: Cells<f64>,
    /// Voxels of the labels along x, y, z.
    dims: [usize; 3],
    /// From a voxel to the next one in linear order; 0 on an axis of length 1.
    strides: [usize; 3],
}

/// `label index = D_l⁻¹ (D · index + origin − origin_l)` as one affine map, and the boxes of both.
#[derive(Clone, Copy, Debug)]
struct Map {
    linear: Mat3<f64>,
    offset: Vec3<f64>,
    data_box: [DVec3; 2],
    label_box: [DVec3; 2],
}

impl<'a> Labels<'a> {
    /// Prepares the lookup of labels at positions of a data volume that lies on `data`, in a world of that anatomy
    /// ([SPACE-2]).
    pub fn new(volume: &'a LabelVolume, data: &Grid, world: Option<Anatomy>, lookup: LabelLookup) -> Self {
        let own = volume.grid_in(world);
        let dims = own.dims();
        let map = Map::new(data, &own);
        let stride = [1, dims[0], dims[0] * dims[1]];
        Self {
            volume,
            lookup,
            map: (data.dims() != dims || !map.is_identity()).then_some(map),
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
    /// `nearest` takes the nearest voxel in index space, of two at one distance that of the lower index, as [PREC-2]
    /// does. `smooth` takes the id with the highest sum of trilinear weights among the eight voxels around, of equal
    /// sums the smallest id.
    #[inline]
    pub fn id_at<R: Real>(&self, p: Vec3<R>) -> u32 {
        let mut p = Vec3::new(p.x.to_f64(), p.y.to_f64(), p.z.to_f64());
        if let Some(map) = &self.map {
            p = map.apply(p);
            if !within(map.label_box, p.to_glam()) {
                return 0;
            }
        }
        let at = self.cells.locate(p);
        match self.lookup {
            LabelLookup::Nearest => self.nearest(at),
            LabelLookup::Smooth => self.smooth(at),
        }
    }

    /// Every id that [`id_at`](Self::id_at) can give in the data's cells from `first` up to, not including, `end`,
    /// ascending ([RAY-2]); others may be among them.
    pub fn ids_in(&self, first: [usize; 3], end: [usize; 3]) -> Vec<u32> {
        let Some(map) = &self.map else { return self.ids_of(first, end) };
        let [lo, hi] = map.bounds(first, end);
        let [start, stop] = map.label_box;
        let mut ids = if lo.cmple(stop).all() && hi.cmpge(start).all() {
            // Floors: what is clamped to the box is not negative.
            let cell = |p: DVec3| p.clamp(DVec3::ZERO, stop).to_array().map(|x| x as usize);
            self.ids_of(cell(lo), cell(hi).map(|x| x + 1))
        } else {
            Vec::new()
        };
        if !(within(map.label_box, lo) && within(map.label_box, hi)) && ids.first() != Some(&0) {
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
    fn nearest(&self, at: Place<f64>) -> u32 {
        let upper = |a: usize| if at.w[a] > 0.5 { self.strides[a] } else { 0 };
        self.volume.id(self.linear(at.cell) + upper(0) + upper(1) + upper(2))
    }

    #[inline]
    fn smooth(&self, at: Place<f64>) -> u32 {
        let start = self.linear(at.cell);
        let [dx, dy, dz] = self.strides;
        let ids: [u32; 8] =
            std::array::from_fn(|c| self.volume.id(start + (c & 1) * dx + (c >> 1 & 1) * dy + (c >> 2) * dz));
        // Inside of a part, which is almost everywhere.
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

impl Map {
    fn new(data: &Grid, labels: &Grid) -> Self {
        let inverse = labels.inverse_axes();
        let [lo, hi] = labels.index_box();
        Self {
            linear: Mat3::from_glam(inverse * data.axes()),
            offset: Vec3::from_glam(inverse * (data.origin() - labels.origin())),
            data_box: data.index_box(),
            label_box: [lo - SLACK, hi + SLACK],
        }
    }

    #[inline(always)]
    fn apply(&self, p: Vec3<f64>) -> Vec3<f64> {
        self.linear.apply(p) + self.offset
    }

    /// Whether no corner of the data's box, and so no position in it, is moved by more than the slack.
    fn is_identity(&self) -> bool {
        corners(self.data_box).all(|p| (self.apply(Vec3::from_glam(p)).to_glam() - p).abs().max_element() <= SLACK)
    }

    /// Bounds of the label positions of a part of the data's cells, with a margin for rounding.
    fn bounds(&self, first: [usize; 3], end: [usize; 3]) -> [DVec3; 2] {
        let number = |i: [usize; 3]| DVec3::from_array(i.map(|i| i as f64));
        // On an axis of length 1 positions are not those of its one cell.
        let flat = (self.data_box[0]).cmplt(DVec3::ZERO);
        let lo = DVec3::select(flat, self.data_box[0], number(first));
        let hi = DVec3::select(flat, self.data_box[1], number(end));
        let places = corners([lo, hi]).map(|p| self.apply(Vec3::from_glam(p)).to_glam());
        let [lo, hi] = places.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], p| [lo.min(p), hi.max(p)]);
        [lo - SLACK, hi + SLACK]
    }
}

/// Whether a box holds a position.
#[inline(always)]
fn within([lo, hi]: [DVec3; 2], p: DVec3) -> bool {
    p.cmpge(lo).all() && p.cmple(hi).all()
}

/// The eight corners of a box.
fn corners([lo, hi]: [DVec3; 2]) -> impl Iterator<Item = DVec3> {
    (0..8).map(move |c| DVec3::from_array(std::array::from_fn(|a| if c >> a & 1 == 0 { lo[a] } else { hi[a] })))
}

#[cfg(test)]
mod tests;
