//! Undo and redo: a list of brick tables. Tables share the bricks that they have in common.

use super::table::{BrickTable, BrickedVolume};
use crate::volume::Voxel;

/// The states of a bricked volume, each a table of its bricks.
#[derive(Clone, Debug)]
pub struct History<V> {
    /// The states from the first to the last that can be had again.
    tables: Vec<BrickTable<V>>,
    /// The place of the present state.
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

    /// Gives a volume the state before. Returns whether there is one.
    pub fn undo(&mut self, volume: &mut BrickedVolume<V>) -> bool {
        self.go_to(self.now.checked_sub(1), volume)
    }

    /// Gives a volume the state that was undone last. Returns whether there is one.
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
