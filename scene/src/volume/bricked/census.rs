//! The bricks that a volume would have, counted without storing them.

use super::brick;
use super::table::{bricks_along, bytes, extent, gathered};
use crate::parallel;
use crate::volume::{Access, Volume};
use serde::Serialize;
use std::collections::HashMap;

/// Bricks of a volume in its stored type, and the bytes that they would take.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct BrickCensus {
    /// Number of bricks.
    pub count: usize,
    /// Bricks that differ from each other.
    pub distinct: usize,
    /// Bytes of the distinct bricks and of their table.
    pub bytes: usize,
}

impl BrickCensus {
    /// Counts the bricks of a volume.
    pub fn new(volume: &Volume) -> Self {
        with_access!(volume, |access| Self::of(access))
    }

    fn of<A: Access>(access: A) -> Self {
        let dims = access.dims();
        let bricks = bricks_along(dims);
        let count = bricks.iter().product();
        let gather = |i: usize| {
            let at = [i % bricks[0], i / bricks[0] % bricks[1], i / (bricks[0] * bricks[1])];
            let extent = extent(dims, at);
            let mut voxels = gathered(at, extent, |[x, y, z]| access.at(x, y, z));
            brick::repeat_last(&mut voxels, extent);
            voxels
        };
        let hashes: Vec<u64> = parallel::map(count, &|i| brick::hash(&gather(i)));
        // The first brick of each content that has a hash.
        let mut firsts: HashMap<u64, Vec<usize>> = HashMap::new();
        for (i, hash) in hashes.into_iter().enumerate() {
            let firsts = firsts.entry(hash).or_default();
            if firsts.is_empty() || !firsts.iter().any(|&first| brick::same(&gather(first), &gather(i))) {
                firsts.push(i);
            }
        }
        let distinct = firsts.values().map(Vec::len).sum();
        Self { count, distinct, bytes: bytes(distinct, count, size_of::<A::Voxel>()) }
    }
}
