//! Bricks by their content, so that equal ones are stored once.

use super::brick::Brick;
use crate::volume::Voxel;
use std::collections::HashMap;
use std::sync::{Arc, Weak};

/// The bricks in use, by their hashes. A brick that no table holds any more is forgotten.
#[derive(Clone, Debug)]
pub(super) struct Pool<V> {
    bricks: HashMap<u64, Vec<Weak<Brick<V>>>>,
    /// The number of hashes at which the hashes of forgotten bricks are removed.
    full: usize,
}

impl<V: Voxel> Pool<V> {
    /// Number of hashes below which none is removed.
    const FEW: usize = 1024;

    /// A pool without bricks.
    pub(super) fn new() -> Self {
        Self { bricks: HashMap::new(), full: Self::FEW }
    }

    /// The shared brick of this content.
    pub(super) fn shared(&mut self, brick: Brick<V>) -> Arc<Brick<V>> {
        if self.bricks.len() >= self.full {
            self.bricks.retain(|_, equal| equal.iter().any(|brick| brick.strong_count() > 0));
            self.full = (2 * self.bricks.len()).max(Self::FEW);
        }
        let candidates = self.bricks.entry(brick.hash()).or_default();
        candidates.retain(|brick| brick.strong_count() > 0);
        if let Some(found) = candidates.iter().filter_map(Weak::upgrade).find(|found| found.equals(&brick)) {
            return found;
        }
        let brick = Arc::new(brick);
        candidates.push(Arc::downgrade(&brick));
        brick
    }
}
