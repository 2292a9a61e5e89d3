//! Principal directions stored at voxels (3.1, 4.2; [HATCH-4], [HATCH-5]).
//!
//! A direction is computed at the first query near its voxel, or in advance for the whole grid. It depends on the
//! voxel alone, so that the time, the order and the thread do not matter.

mod blocks;
mod mean;
mod smoothing;

use super::super::strokes::StrokeField;
use super::super::{CurvatureFamily, DirectionCounts, NoDirection};
use super::umbilics::PrincipalDirections;
use crate::field::curvature::Curvature;
use crate::number::Vec3;
pub(super) use blocks::VoxelBox;
use blocks::{CORNERS, DirectionBlocks};
use drypoint_scene::glam::DVec3;
use mean::LineMean;
use smoothing::SurfaceLines;

/// Interpolation of stored directions between voxels ([HATCH-4]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DirectionInterpolation {
    /// The dominant eigenvector of the trilinear mean of e eᵀ.
    Tensor,
    /// The trilinear mean of directions, each turned to the current one: the paper's method. At a seed there is no
    /// current direction, and `Tensor` is used.
    Flipped,
}

/// Parameters of the storage of directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DirectionStorage {
    /// Interpolation between voxels.
    pub between: DirectionInterpolation,
    /// Whether the directions of the whole grid are computed before the first query.
    pub all: bool,
}

/// Directions at the voxels of a ground.
#[derive(Debug)]
pub(in super::super) struct StoredDirections {
    between: DirectionInterpolation,
    dims: [usize; 3],
    blocks: DirectionBlocks,
}

/// Cached lines at the corners of the cell in which a stroke was last.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct CellCache {
    cell: [usize; 3],
    /// A bit for each corner that was read.
    read: u8,
    /// A bit for each corner that was read and has a direction.
    has: u8,
    /// Directions at the corners; 0 if there is none.
    corners: [DVec3; 8],
}

impl Default for CellCache {
    fn default() -> Self {
        Self::of([usize::MAX; 3])
    }
}

impl CellCache {
    fn of(cell: [usize; 3]) -> Self {
        Self { cell, read: 0, has: 0, corners: [DVec3::ZERO; 8] }
    }
}

/// The inputs from which the directions of voxels are computed.
pub(in super::super) struct DirectionInputs<'a, 'f, 'v> {
    pub(in super::super) ground: &'a dyn StrokeField,
    pub(in super::super) directions: &'a PrincipalDirections<'f, 'v>,
}

impl DirectionInputs<'_, '_, '_> {
    fn at(&self, voxel: [usize; 3]) -> Option<Curvature<f64>> {
        // The cause of a missing direction is not stored.
        self.directions.at_voxel(self.ground, voxel, &mut DirectionCounts::default()).ok()
    }
}

impl StoredDirections {
    /// An empty storage.
    pub(in super::super) fn new(ground: &dyn StrokeField, between: DirectionInterpolation) -> Self {
        let dims = ground.grid().dims();
        Self { between, dims, blocks: DirectionBlocks::new(dims) }
    }

    /// Computes the directions of all voxels, in parallel.
    pub(in super::super) fn fill(&self, source: &DirectionInputs<'_, '_, '_>) {
        self.blocks.fill(|voxels| source.directions.of_voxels(source.ground, voxels));
    }

    /// Stores directions of the voxels around the surface of some cells, smoothed along it over a length in world units.
    /// Curvatures are means of those around, by how sure they are.
    pub(in super::super) fn smooth(&self, source: &DirectionInputs<'_, '_, '_>, cells: &[[usize; 3]], length: f64) {
        let axes = source.ground.grid().axes();
        let mut lines = SurfaceLines::new(source.ground, cells, &|voxel| source.at(voxel));
        lines.smooth(length, [0, 1, 2].map(|a| axes.col(a).length()));
        for (voxel, curvatures, directions) in lines.each() {
            self.blocks.set(
                voxel,
                curvatures.zip(directions).map(|([k1, k2], [e1, e2])| {
                    let [e1, e2] = [e1, e2].map(Vec3::from_glam);
                    Curvature { k1, k2, e1, e2 }
                }),
            );
        }
    }

    /// Like [`fill`](Self::fill), with random signs.
    #[cfg(test)]
    pub(in super::super) fn turn_signs(&self, source: &DirectionInputs<'_, '_, '_>) {
        let turned = |voxel: [usize; 3], draw: u32, e: Vec3<f64>| {
            let up = drypoint_scene::philox::uniform(1, voxel.map(|i| i as u32), draw) < 0.5;
            if up { e } else { -e }
        };
        let make = |v| source.at(v).map(|c| Curvature { e1: turned(v, 0, c.e1), e2: turned(v, 1, c.e2), ..c });
        self.blocks.fill(|_| make);
    }

    /// Number of voxels with a stored direction.
    pub(in super::super) fn made(&self) -> u64 {
        self.blocks.made()
    }

    /// Size of the stored directions in bytes.
    pub(in super::super) fn bytes(&self) -> u64 {
        self.blocks.bytes()
    }

    /// Curvatures and directions at a voxel.
    pub(in super::super) fn voxel(
        &self,
        source: &DirectionInputs<'_, '_, '_>,
        voxel: [usize; 3],
    ) -> Option<Curvature<f64>> {
        self.blocks.get(voxel, || source.at(voxel))
    }

    /// Trilinear weights of a cell's corners.
    #[inline]
    fn weights(&self, cell: [usize; 3], index: Vec3<f64>) -> [f64; 8] {
        // Values are constant along an axis of one voxel.
        let up = |a: usize, x: f64| if self.dims[a] == 1 { 0.0 } else { x - cell[a] as f64 };
        let (x, y, z) = (up(0, index.x), up(1, index.y), up(2, index.z));
        let (x, y, z) = ([1.0 - x, x], [1.0 - y, y], [1.0 - z, z]);
        let [a, b, c, d] = [x[0] * y[0], x[1] * y[0], x[0] * y[1], x[1] * y[1]];
        [a * z[0], b * z[0], c * z[0], d * z[0], a * z[1], b * z[1], c * z[1], d * z[1]]
    }

    /// The direction of a family at a place in index space, of length 1 and with either sign. `like` is the current
    /// direction. `near` caches the cell's corners for the caller and the family.
    pub(in super::super) fn line(
        &self,
        source: &DirectionInputs<'_, '_, '_>,
        index: Vec3<f64>,
        family: CurvatureFamily,
        like: Option<DVec3>,
        near: &mut CellCache,
        counts: &mut DirectionCounts,
    ) -> Result<DVec3, NoDirection> {
        let like = like.filter(|_| self.between == DirectionInterpolation::Flipped);
        let cell = source.ground.cell(index);
        if near.cell != cell {
            *near = CellCache::of(cell);
        }
        let weights = self.weights(cell, index);
        // Corners with weight 0 are not computed.
        let new = weights.iter().enumerate().fold(0, |new, (i, w)| new | u8::from(*w > 0.0) << i) & !near.read;
        if new != 0 {
            near.read |= new;
            let which = usize::from(family == CurvatureFamily::Min);
            near.has |= self.blocks.lines(cell, new, which, |voxel| source.at(voxel), &mut near.corners);
        }
        let mut mean = LineMean::new(like);
        mean.add_all(near.has, &near.corners, &weights);
        let found = mean.direction();
        if found.is_some() {
            counts.between += 1
        } else {
            counts.missing += 1
        }
        found.ok_or(NoDirection::Umbilic)
    }

    /// Both directions and the means of the curvatures at a place in index space.
    pub(in super::super) fn curvature(
        &self,
        source: &DirectionInputs<'_, '_, '_>,
        index: Vec3<f64>,
        counts: &mut DirectionCounts,
    ) -> Result<Curvature<f64>, NoDirection> {
        let mut means = [LineMean::new(None), LineMean::new(None)];
        let (mut k1, mut k2) = (0.0, 0.0);
        let cell = source.ground.cell(index);
        let weights = self.weights(cell, index);
        for (up, weight) in CORNERS.into_iter().zip(weights).filter(|(_, weight)| *weight > 0.0) {
            if let Some(c) = self.voxel(source, [0, 1, 2].map(|a| cell[a] + up[a])) {
                means[0].add(c.e1.to_glam(), weight);
                means[1].add(c.e2.to_glam(), weight);
                (k1, k2) = (k1 + weight * c.k1, k2 + weight * c.k2);
            }
        }
        let [Some(e1), Some(e2)] = means.each_ref().map(LineMean::direction) else {
            counts.missing += 1;
            return Err(NoDirection::Umbilic);
        };
        counts.between += 1;
        let weight = means[0].weight();
        Ok(Curvature { k1: k1 / weight, k2: k2 / weight, e1: Vec3::from_glam(e1), e2: Vec3::from_glam(e2) })
    }
}
