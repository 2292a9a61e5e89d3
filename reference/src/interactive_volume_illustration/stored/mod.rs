//! Principal directions stored at voxels (3.1, 4.2; [HATCH-4], [HATCH-5]).
//!
//! A direction is made when a place near its voxel is asked for, or before, for the whole grid. It depends on the voxel
//! alone, so that it does not matter when, in which order and by which thread.

mod blocks;
mod mean;

use super::ground::Ground;
use super::umbilics::Directions;
use super::{Family, NoDirection, Scales};
use crate::field::curvature::Curvature;
use crate::number::Vec3;
use blocks::Blocks;
pub(super) use blocks::Voxels;
use drypoint_scene::glam::DVec3;
use mean::Mean;

/// What stored directions make between voxels ([HATCH-4]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Between {
    /// The dominant eigenvector of the trilinear mean of e eᵀ.
    Tensor,
    /// The trilinear mean of directions, each turned to the current one: the paper's. Without a current one, at a seed, the
    /// tensor's.
    Flipped,
}

/// How directions are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Storing {
    /// What they make between voxels.
    pub between: Between,
    /// Whether those of the whole grid are made before the first is asked for.
    pub all: bool,
}

/// Directions at the voxels of a ground.
#[derive(Debug)]
pub(super) struct Stored {
    between: Between,
    dims: [usize; 3],
    blocks: Blocks,
}

/// What was read of the cell that a stroke was in last: lines at its corners, as far as they were asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    cell: [usize; 3],
    corners: [Option<Option<DVec3>>; 8],
}

impl Default for Near {
    fn default() -> Self {
        Self { cell: [usize::MAX; 3], corners: [None; 8] }
    }
}

/// What the directions of voxels are made from.
pub(super) struct Source<'a, 'f, 'v> {
    pub(super) ground: &'a dyn Ground,
    pub(super) directions: &'a Directions<'f, 'v>,
}

impl Source<'_, '_, '_> {
    fn at(&self, voxel: [usize; 3]) -> Option<Curvature<f64>> {
        // Why there is none is not kept.
        self.directions.at_voxel(self.ground, voxel, &mut Scales::default()).ok()
    }
}

impl Stored {
    /// Nothing is made yet.
    pub(super) fn new(ground: &dyn Ground, between: Between) -> Self {
        let dims = ground.grid().dims();
        Self { between, dims, blocks: Blocks::new(dims) }
    }

    /// Makes all that there are, in parallel.
    pub(super) fn fill(&self, source: &Source<'_, '_, '_>) {
        self.blocks.fill(|voxels| source.directions.of_voxels(source.ground, voxels));
    }

    /// As [`fill`](Self::fill), with signs at random.
    #[cfg(test)]
    pub(super) fn turn_signs(&self, source: &Source<'_, '_, '_>) {
        let turned = |voxel: [usize; 3], draw: u32, e: Vec3<f64>| {
            let up = drypoint_scene::philox::uniform(1, voxel.map(|i| i as u32), draw) < 0.5;
            if up { e } else { -e }
        };
        self.blocks.fill(|voxels| {
            let of = |voxel| source.at(voxel).map(|c| (voxel, c));
            let each = voxels
                .each()
                .map(of)
                .map(|made| made.map(|(v, c)| Curvature { e1: turned(v, 0, c.e1), e2: turned(v, 1, c.e2), ..c }));
            each.collect()
        });
    }

    /// Voxels with a stored direction.
    pub(super) fn made(&self) -> u64 {
        self.blocks.made()
    }

    /// Bytes of what is stored.
    pub(super) fn bytes(&self) -> u64 {
        self.blocks.bytes()
    }

    /// Those of a voxel.
    pub(super) fn voxel(&self, source: &Source<'_, '_, '_>, voxel: [usize; 3]) -> Option<Curvature<f64>> {
        self.blocks.get(voxel, || source.at(voxel))
    }

    /// The weights of a cell's two sides along each axis.
    #[inline]
    fn weights(&self, cell: [usize; 3], index: Vec3<f64>) -> [[f64; 2]; 3] {
        let index = [index.x, index.y, index.z];
        [0, 1, 2].map(|a| {
            // Along an axis of one voxel nothing changes.
            let w = if self.dims[a] == 1 { 0.0 } else { index[a] - cell[a] as f64 };
            [1.0 - w, w]
        })
    }

    /// The corners of a place's cell that have a weight: their numbers, voxels and weights.
    #[inline(always)]
    fn corners(&self, cell: [usize; 3], index: Vec3<f64>) -> impl Iterator<Item = (usize, [usize; 3], f64)> {
        let [x, y, z] = self.weights(cell, index);
        (0..8).filter_map(move |i| {
            let up = [i & 1, i >> 1 & 1, i >> 2];
            let weight = x[up[0]] * y[up[1]] * z[up[2]];
            (weight > 0.0).then(|| (i, [0, 1, 2].map(|a| cell[a] + up[a]), weight))
        })
    }

    /// The direction of a family at a place in index space, of length 1 and with either sign. `like` is the current one, `near`
    /// has what was read of the cell by whoever asks for this family.
    pub(super) fn line(
        &self,
        source: &Source<'_, '_, '_>,
        index: Vec3<f64>,
        family: Family,
        like: Option<DVec3>,
        near: &mut Near,
        counts: &mut Scales,
    ) -> Result<DVec3, NoDirection> {
        let like = like.filter(|_| self.between == Between::Flipped);
        let mut mean = Mean::new(like);
        let cell = source.ground.cell(index);
        if near.cell != cell {
            *near = Near { cell, corners: [None; 8] };
        }
        for (i, voxel, weight) in self.corners(cell, index) {
            let line = near.corners[i]
                .get_or_insert_with(|| self.blocks.line(voxel, family == Family::Min, || source.at(voxel)));
            if let Some(e) = *line {
                mean.add(e, weight);
            }
        }
        let found = mean.direction();
        if found.is_some() {
            counts.between += 1
        } else {
            counts.missing += 1
        }
        found.ok_or(NoDirection::Umbilic)
    }

    /// Both directions and the means of the curvatures at a place in index space.
    pub(super) fn curvature(
        &self,
        source: &Source<'_, '_, '_>,
        index: Vec3<f64>,
        counts: &mut Scales,
    ) -> Result<Curvature<f64>, NoDirection> {
        let mut means = [Mean::new(None), Mean::new(None)];
        let (mut k1, mut k2) = (0.0, 0.0);
        for (_, voxel, weight) in self.corners(source.ground.cell(index), index) {
            if let Some(c) = self.voxel(source, voxel) {
                means[0].add(c.e1.to_glam(), weight);
                means[1].add(c.e2.to_glam(), weight);
                (k1, k2) = (k1 + weight * c.k1, k2 + weight * c.k2);
            }
        }
        let [Some(e1), Some(e2)] = means.each_ref().map(Mean::direction) else {
            counts.missing += 1;
            return Err(NoDirection::Umbilic);
        };
        counts.between += 1;
        let weight = means[0].weight();
        Ok(Curvature { k1: k1 / weight, k2: k2 / weight, e1: Vec3::from_glam(e1), e2: Vec3::from_glam(e2) })
    }
}
