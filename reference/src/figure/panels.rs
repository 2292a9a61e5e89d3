//! The arrangement of a figure's panels in rows.

/// The columns of a figure, in whole pixels. Width and gap are at most 2³⁰.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PanelGrid {
    /// Width of the figure.
    pub width: usize,
    /// Number of columns, at least 1.
    pub columns: usize,
    /// Space between panels.
    pub gap: usize,
}

/// A panel to be placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PanelSize {
    /// Columns that it takes, at most those of the grid.
    pub columns: usize,
    /// Height of its picture in pixels.
    pub height: usize,
    /// Height of the text below it in pixels.
    pub text: usize,
}

/// A panel in its row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlacedPanel {
    /// Left and upper end of its picture in pixels.
    pub corner: [usize; 2],
    /// The upper end of its text. Texts of a row begin at one height.
    pub text: usize,
}

impl PanelGrid {
    /// Whether each column has at least some pixels.
    pub fn has_columns_of(&self, least: usize) -> bool {
        let gaps = self.gap.saturating_mul(self.columns - 1);
        gaps.saturating_add(least.saturating_mul(self.columns)) <= self.width
    }

    /// The left end of a column. Columns differ by at most one pixel, and the last one ends at the figure's width.
    fn left(&self, column: usize) -> usize {
        let whole = self.width + self.gap;
        (2 * column * whole + self.columns) / (2 * self.columns)
    }

    /// The columns at which panels begin, and their rows. A panel that the row has no room for begins the next one.
    fn cells(&self, spans: impl IntoIterator<Item = usize>) -> Vec<[usize; 2]> {
        let (mut column, mut row) = (0, 0);
        let cell = |span: usize| {
            if column + span > self.columns && column > 0 {
                (column, row) = (0, row + 1);
            }
            let cell = [column, row];
            column += span;
            cell
        };
        spans.into_iter().map(cell).collect()
    }

    /// Returns the widths of panels that take some columns each, at least one pixel.
    pub fn widths(&self, spans: &[usize]) -> Vec<usize> {
        let cells = self.cells(spans.iter().copied()).into_iter().zip(spans);
        cells
            .map(|([column, _], span)| self.left(column + span).saturating_sub(self.gap + self.left(column)).max(1))
            .collect()
    }

    /// Places panels in rows below `top`, each picture in the middle of its row's height. Returns the places and the lower
    /// end of the last row. Places beyond the largest number are at it.
    pub fn place(&self, panels: &[PanelSize], top: usize) -> (Vec<PlacedPanel>, usize) {
        let cells = self.cells(panels.iter().map(|panel| panel.columns));
        let rows = cells.last().map_or(0, |[_, row]| row + 1);
        let mut placed = Vec::new();
        let mut upper = top;
        for row in 0..rows {
            let of_row = || cells.iter().zip(panels).filter(|([_, of], _)| *of == row);
            let [height, text] =
                of_row().fold([0; 2], |[height, text], (_, p)| [height.max(p.height), text.max(p.text)]);
            placed.extend(of_row().map(|([column, _], panel)| PlacedPanel {
                corner: [self.left(*column), upper.saturating_add((height - panel.height) / 2)],
                text: upper.saturating_add(height),
            }));
            let gap = if row + 1 < rows { self.gap } else { 0 };
            upper = [height, text, gap].into_iter().fold(upper, usize::saturating_add);
        }
        (placed, upper)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniforms;

    const GRID: PanelGrid = PanelGrid { width: 1000, columns: 3, gap: 20 };

    /// Columns of 1000 px with gaps of 20: 326 ⅔ each.
    #[test]
    fn panels_by_hand() {
        assert_eq!(GRID.widths(&[1, 1, 1, 2, 1, 3]), [320, 320, 320, 660, 320, 1000]);
        let size = |columns, height, text| PanelSize { columns, height, text };
        // The second panel begins a row of its own.
        let (placed, end) = GRID.place(&[size(2, 100, 30), size(2, 50, 10), size(1, 70, 0)], 5);
        let at = |corner, text| PlacedPanel { corner, text };
        assert_eq!(placed, [at([0, 5], 105), at([0, 165], 225), at([680, 155], 225)]);
        assert_eq!(end, 235);
        assert_eq!(GRID.place(&[], 7), (vec![], 7));
        let huge = GRID.place(&[size(3, usize::MAX, 9), size(3, 9, usize::MAX)], 7);
        assert_eq!(huge.1, usize::MAX);
    }

    /// Panels of random sizes lie in the figure, in reading order, and neither pictures nor texts overlap.
    #[test]
    fn panels_never_overlap() {
        for scene in 0..200 {
            let [width, columns, gap] = uniforms(5, [scene, 0, 0], 0).map(|u| (u * 300.0) as usize)[..3] else {
                panic!()
            };
            let grid = PanelGrid { width: 200 + width, columns: 1 + columns % 7, gap: gap % 20 };
            let panels: Vec<PanelSize> = (0..12)
                .map(|i| {
                    let [span, height, text] = uniforms(6, [scene, i, 0], 0)[..3] else { panic!() };
                    let columns = 1 + (span * grid.columns as f64) as usize;
                    PanelSize { columns, height: 1 + (height * 90.0) as usize, text: (text * 30.0) as usize }
                })
                .collect();
            let spans: Vec<usize> = panels.iter().map(|panel| panel.columns).collect();
            let widths = grid.widths(&spans);
            // Columns differ by at most one pixel.
            let narrowest = *grid.widths(&vec![1; grid.columns]).iter().min().unwrap();
            assert!(grid.has_columns_of(narrowest) && !grid.has_columns_of(narrowest + 2), "{scene}");
            let (placed, end) = grid.place(&panels, 10);
            let boxes: Vec<[[usize; 2]; 2]> = (0..12)
                .map(|i| {
                    let [left, top] = placed[i].corner;
                    assert!(placed[i].text >= top + panels[i].height);
                    [[left, top], [left + widths[i], placed[i].text + panels[i].text]]
                })
                .collect();
            for (i, [low, high]) in boxes.iter().enumerate() {
                assert!(high[0] <= grid.width && high[1] <= end && low[1] >= 10, "{scene}");
                for [other_low, other_high] in &boxes[..i] {
                    let beside = |k: usize| high[k] <= other_low[k] || other_high[k] <= low[k];
                    assert!(beside(0) || beside(1), "{scene}");
                }
            }
        }
    }
}
