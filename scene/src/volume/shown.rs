//! The test whether a stored value is shown: by a function of the value, or by a table if there are few values.

use super::Volume;

/// A volume of fewer values than this is looked up in a table instead of asked about voxel by voxel.
const TABLE: f64 = 65_536.0;

/// The stored values whose value is shown.
pub struct ShownValues<'a> {
    is_shown: &'a (dyn Fn(f64) -> bool + Sync),
    slope: f64,
    intercept: f64,
    lowest: f64,
    /// One entry for each integer from the lowest on; empty where there are many values.
    table: Vec<bool>,
}

impl<'a> ShownValues<'a> {
    /// Prepares the test for a volume. If the stored integers have few values, `is_shown` is called once for each.
    pub fn new(volume: &Volume, is_shown: &'a (dyn Fn(f64) -> bool + Sync)) -> Self {
        let (slope, intercept) = (volume.slope(), volume.intercept());
        let [lowest, highest] = volume.voxels().range();
        let few = volume.is_integer() && highest - lowest < TABLE;
        let steps = if few { (highest - lowest) as usize + 1 } else { 0 };
        let table = (0..steps).map(|i| is_shown(slope * (lowest + i as f64) + intercept)).collect();
        Self { is_shown, slope, intercept, lowest, table }
    }

    /// Whether a stored value of the volume is shown.
    #[inline]
    pub fn has(&self, stored: f64) -> bool {
        match self.table.get((stored - self.lowest) as usize) {
            Some(&shown) => shown,
            None => (self.is_shown)(self.slope * stored + self.intercept),
        }
    }
}
