//! Places on a page in whole steps, and square cells over them, to find what lies near.

/// A length on the page as the number of its steps of 0.001 mm. It ends at a kilometre, so that squares of distances fit.
pub(crate) fn micrometres(mm: f64) -> i64 {
    (mm * 1000.0).round_ties_even().clamp(-1e9, 1e9) as i64
}

/// The end of a cell's list, where a caller keeps lists.
pub(crate) const NONE: usize = usize::MAX;

/// Cells over the box of some places, about as many as there are places.
pub(crate) struct Grid {
    corner: [i64; 2],
    /// Of a cell, above 0.
    pub(crate) side: i64,
    pub(crate) columns: usize,
    pub(crate) rows: usize,
}

impl Grid {
    /// Cells at least `reach` wide; none without a place.
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

    /// Column and row of a place in the box.
    pub(crate) fn cell_of(&self, place: &[i64; 2]) -> [usize; 2] {
        [0, 1].map(|k| ((place[k] - self.corner[k]) / self.side) as usize)
    }

    /// The cell's number.
    pub(crate) fn index(&self, [column, row]: [usize; 2]) -> usize {
        row * self.columns + column
    }

    /// How many there are.
    pub(crate) fn cells(&self) -> usize {
        self.columns * self.rows
    }

    /// The place's cell and its neighbours: all that lies within `reach`.
    pub(crate) fn around(&self, place: &[i64; 2], mut each: impl FnMut(usize)) {
        let [i, j] = self.cell_of(place);
        for row in j.saturating_sub(1)..=(j + 1).min(self.rows - 1) {
            for column in i.saturating_sub(1)..=(i + 1).min(self.columns - 1) {
                each(self.index([column, row]));
            }
        }
    }
}
