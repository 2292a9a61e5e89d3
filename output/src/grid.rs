//! Integer coordinates on the page, and square cells to find neighbours.

/// Returns a length on the page in micrometres, rounded to even. It is clamped to ±1 km, so that squared distances fit.
pub(crate) fn micrometres(mm: f64) -> i64 {
    (mm * 1000.0).round_ties_even().clamp(-1e9, 1e9) as i64
}

/// End marker of a cell's linked list, for callers that keep lists.
pub(crate) const NONE: usize = usize::MAX;

/// Square cells over the bounding box of some points, about one a point.
pub(crate) struct CellGrid {
    corner: [i64; 2],
    /// Side of a cell in micrometres, above 0.
    pub(crate) side: i64,
    pub(crate) columns: usize,
    pub(crate) rows: usize,
}

impl CellGrid {
    /// Makes cells at least `reach` wide; none without a point.
    pub(crate) fn new(places: &[[i64; 2]], reach: i64) -> Option<Self> {
        let corner = places.iter().copied().reduce(|a, b| [a[0].min(b[0]), a[1].min(b[1])])?;
        let far = places.iter().fold(corner, |a, b| [a[0].max(b[0]), a[1].max(b[1])]);
        let [width, height] = [0, 1].map(|k| (far[k] - corner[k]) as f64);
        let n = places.len() as f64;
        // In a flat box the sides count, not the area.
        let side = (width * height / n).sqrt().max(width / n).max(height / n).ceil() as i64;
        let side = side.max(reach).max(1);
        let [columns, rows] = [0, 1].map(|k| ((far[k] - corner[k]) / side) as usize + 1);
        Some(Self { corner, side, columns, rows })
    }

    /// Returns column and row of a point in the box.
    pub(crate) fn cell_of(&self, place: &[i64; 2]) -> [usize; 2] {
        [0, 1].map(|k| ((place[k] - self.corner[k]) / self.side) as usize)
    }

    /// Returns the index of a cell.
    pub(crate) fn index(&self, [column, row]: [usize; 2]) -> usize {
        row * self.columns + column
    }

    /// Returns the number of cells.
    pub(crate) fn cells(&self) -> usize {
        self.columns * self.rows
    }

    /// Calls `each` with the point's cell and its neighbours. They contain every point within `reach`.
    pub(crate) fn around(&self, place: &[i64; 2], mut each: impl FnMut(usize)) {
        let [i, j] = self.cell_of(place);
        for row in j.saturating_sub(1)..=(j + 1).min(self.rows - 1) {
            for column in i.saturating_sub(1)..=(i + 1).min(self.columns - 1) {
                each(self.index([column, row]));
            }
        }
    }
}
