//! Lighting transfer functions (Bruckner and Gröller 2005, 5; [VS-5]): tables of reflectances over (N·L, N·Ĥ).

mod contour;
mod presets;

pub use contour::ContourRule;
pub use presets::{LightingModel, LightingPreset};

use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::sync::Arc;

/// A cell of a lighting table: (s_a, s_d, s_s, s_α).
pub type LightingCell = [f64; 4];

/// A table of reflectances. Column i of W stands at N·L = 2i/(W − 1) − 1, row j of H from the top at
/// N·Ĥ = 1 − 2j/(H − 1). A single column or row stands for all numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LightingTable {
    width: usize,
    height: usize,
    /// Row by row from the top.
    cells: Vec<LightingCell>,
}

/// A table that a scene names by its file.
#[derive(Clone, Debug, PartialEq)]
pub struct LightingFile {
    /// The picture.
    pub path: PathBuf,
    /// The table, once the picture has been read.
    pub table: Option<Arc<LightingTable>>,
}

impl LightingTable {
    /// Makes a table of cells, row by row from the top; none if their number is not width × height, or is 0.
    pub fn new(width: usize, height: usize, cells: Vec<LightingCell>) -> Option<Self> {
        let fits = !cells.is_empty() && width.checked_mul(height) == Some(cells.len());
        fits.then_some(Self { width, height, cells })
    }

    /// Samples a function of (N·L, N·Ĥ) on a table of S × S cells, S at least 2.
    pub(crate) fn of_function(side: usize, reflectance: impl Fn(f64, f64) -> LightingCell) -> Self {
        let at = |i: usize| 2.0 * i as f64 / (side - 1) as f64 - 1.0;
        let row = |j: usize| {
            let reflectance = &reflectance;
            (0..side).map(move |i| reflectance(at(i), at(side - 1 - j)))
        };
        Self { width: side, height: side, cells: (0..side).flat_map(row).collect() }
    }

    /// W.
    pub fn width(&self) -> usize {
        self.width
    }

    /// H.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The cells, row by row from the top.
    pub fn cells(&self) -> &[LightingCell] {
        &self.cells
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_cosines_to_the_light_and_rows_to_the_half_vector_from_the_top() {
        let table = LightingTable::of_function(5, |x, y| [x, y, 0.0, 1.0]);
        assert_eq!((table.width(), table.height()), (5, 5));
        assert_eq!(table.cells()[0], [-1.0, 1.0, 0.0, 1.0]);
        assert_eq!(table.cells()[4], [1.0, 1.0, 0.0, 1.0]);
        assert_eq!(table.cells()[2 * 5 + 3], [0.5, 0.0, 0.0, 1.0]);
        assert_eq!(table.cells()[4 * 5], [-1.0, -1.0, 0.0, 1.0]);
    }

    #[test]
    fn a_table_is_full_and_not_empty() {
        let cells = |n| vec![[0.0; 4]; n];
        assert!(LightingTable::new(2, 3, cells(6)).is_some());
        for (width, height, n) in [(2, 3, 5), (0, 0, 0), (usize::MAX, 2, 4)] {
            assert_eq!(LightingTable::new(width, height, cells(n)), None);
        }
    }
}
