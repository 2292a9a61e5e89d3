//! Undo and redo: a list of brick tables. Tables share their equal bricks.

use super::table::{BrickTable, BrickedVolume};
use crate::volume::Voxel;

/// The states of a bricked volume, each a table of its bricks.
#[derive(Clone, Debug)]
pub struct History<V> {
    /// The states from the first one to the last one that can be restored.
    tables: Vec<BrickTable<V>>,
    /// The index of the present state.
    now: usize,
}

impl<V: Voxel> History<V> {
    /// Begins with the present state of a volume.
    pub fn new(volume: &BrickedVolume<V>) -> Self {
        Self { tables: vec![volume.table().clone()], now: 0 }
    }

    /// Adds the present state of the volume. States that were undone are dropped.
    pub fn record(&mut self, volume: &BrickedVolume<V>) {
        self.tables.truncate(self.now + 1);
        self.tables.push(volume.table().clone());
        self.now += 1;
    }

    /// Restores the previous state of a volume. Returns whether there is one.
    pub fn undo(&mut self, volume: &mut BrickedVolume<V>) -> bool {
        self.go_to(self.now.checked_sub(1), volume)
    }

    /// Restores the state of a volume that was undone last. Returns whether there is one.
    pub fn redo(&mut self, volume: &mut BrickedVolume<V>) -> bool {
        self.go_to(self.now.checked_add(1), volume)
    }

    fn go_to(&mut self, state: Option<usize>, volume: &mut BrickedVolume<V>) -> bool {
        let Some((state, table)) = state.and_then(|state| Some((state, self.tables.get(state)?))) else { return false };
        volume.restore(table.clone());
        self.now = state;
        true
    }
}
