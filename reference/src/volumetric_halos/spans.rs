//! Images with a range for each row, outside which the row is zero ([HALO-5]).

use drypoint_scene::parallel;

/// A range of pixels of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) start: usize,
    pub(super) end: usize,
}

impl Span {
    pub(super) const EMPTY: Self = Self { start: 0, end: 0 };

    /// Number of pixels.
    pub(super) fn len(self) -> usize {
        self.end - self.start
    }

    pub(super) fn is_empty(self) -> bool {
        self.start == self.end
    }

    /// Returns the smallest range that contains both.
    pub(super) fn union(self, other: Self) -> Self {
        match (self.is_empty(), other.is_empty()) {
            (true, _) => other,
            (_, true) => self,
            _ => Self { start: self.start.min(other.start), end: self.end.max(other.end) },
        }
    }

    /// Returns the range enlarged by `reach` pixels on each side, within a row of `width`. An empty range stays empty.
    pub(super) fn dilated(self, reach: usize, width: usize) -> Self {
        if self.is_empty() {
            return self;
        }
        Self { start: self.start.saturating_sub(reach), end: (self.end + reach).min(width) }
    }

    /// Returns the smallest part of the range outside which a row is zero.
    pub(super) fn trimmed(self, row: &[f64]) -> Self {
        let values = &row[self.start..self.end];
        // Blocks of zeros are tested first. Without an early exit, the compiler joins the bits of a block in vectors.
        const BLOCK: usize = 32;
        let zero = |block: &[f64]| block.iter().fold(0, |any, v| any | v.to_bits()) == 0;
        let skipped = values.chunks(BLOCK).take_while(|block| zero(block));
        let before = (skipped.count() * BLOCK).min(values.len());
        let Some(first) = values[before..].iter().position(|v| *v != 0.0) else { return Self::EMPTY };
        let start = before + first;
        let mut end = values.len();
        while end - start > BLOCK && zero(&values[end - BLOCK..end]) {
            end -= BLOCK;
        }
        while values[end - 1] == 0.0 {
            end -= 1;
        }
        Self { start: self.start + start, end: self.start + end }
    }
}

/// The number of written pixels below which a second thread does not pay.
const SHARED_WORK: usize = 1 << 14;

/// Rows that a thread takes at a time.
const ROWS: usize = 16;

/// An image, row by row, and for each row a range outside which it is zero.
#[derive(Clone, Debug)]
pub(super) struct SpanImage {
    width: usize,
    values: Vec<f64>,
    spans: Vec<Span>,
}

impl SpanImage {
    /// Makes an image of zeros.
    pub(super) fn new([width, height]: [usize; 2]) -> Self {
        Self { width, values: vec![0.0; width * height], spans: vec![Span::EMPTY; height] }
    }

    pub(super) fn height(&self) -> usize {
        self.spans.len()
    }

    /// Returns a row, and the range outside which it is zero.
    #[inline(always)]
    pub(super) fn row(&self, y: usize) -> (&[f64], Span) {
        (&self.values[y * self.width..][..self.width], self.spans[y])
    }

    pub(super) fn values(&self) -> &[f64] {
        &self.values
    }

    /// The pixels, for writing anywhere. [`find_spans`](Self::find_spans) must be called afterwards.
    pub(super) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// Finds the ranges of all rows.
    pub(super) fn find_spans(&mut self) {
        const RUN: usize = 8 * ROWS;
        let width = self.width;
        let (values, spans) = (&self.values, &mut self.spans);
        if width == 0 {
            return;
        }
        let find = |run: usize, spans: &mut [Span]| {
            for (span, row) in spans.iter_mut().zip(values[run * RUN * width..].chunks(width)) {
                *span = Span { start: 0, end: width }.trimmed(row);
            }
        };
        if values.len() >= 8 * SHARED_WORK {
            parallel::chunks_mut(spans, RUN, &find);
        } else {
            spans.chunks_mut(RUN).enumerate().for_each(|(run, spans)| find(run, spans));
        }
    }

    /// The range of rows outside which the image is zero.
    pub(super) fn rows(&self) -> Span {
        let filled = |span: &Span| !span.is_empty();
        let Some(start) = self.spans.iter().position(filled) else { return Span::EMPTY };
        Span { start, end: self.spans.iter().rposition(filled).map_or(start, |last| last + 1) }
    }

    /// Sum of the lengths of the ranges.
    pub(super) fn area(&self) -> usize {
        self.spans.iter().map(|span| span.len()).sum()
    }

    /// Whether the image has enough pixels for threads to share the work.
    pub(super) fn is_large(&self) -> bool {
        self.area() >= SHARED_WORK
    }

    /// Sets all pixels to zero. The cost is proportional to the pixels that are not zero.
    pub(super) fn clear(&mut self) {
        self.clear_rows(Span { start: 0, end: self.height() });
    }

    fn clear_rows(&mut self, rows: Span) {
        for y in rows.start..rows.end {
            let span = std::mem::replace(&mut self.spans[y], Span::EMPTY);
            self.values[y * self.width..][span.start..span.end].fill(0.0);
        }
    }

    /// Writes the rows of a range by `write(y, row, scratch)`, which fills a range of the row and returns the range.
    /// All other pixels become zero. `work` is about the number of written pixels, and `scratch` the numbers that a row
    /// needs as working memory.
    pub(super) fn write_rows(
        &mut self,
        rows: Span,
        work: usize,
        scratch: usize,
        write: impl Fn(usize, &mut [f64], &mut [f64]) -> Span + Sync,
    ) {
        self.clear_rows(Span { start: 0, end: rows.start });
        self.clear_rows(Span { start: rows.end, end: self.height() });
        let width = self.width;
        let values = &mut self.values[rows.start * width..rows.end * width];
        let spans = &mut self.spans[rows.start..rows.end];
        let block = |first: usize, values: &mut [f64], spans: &mut [Span]| {
            let mut space = vec![0.0; scratch];
            for (y, (row, span)) in (rows.start + first..).zip(values.chunks_mut(width).zip(spans)) {
                let (old, new) = (*span, write(y, row, &mut space));
                // Remains of an earlier image outside the new range.
                row[old.start..old.end.min(new.start.max(old.start))].fill(0.0);
                row[old.start.max(new.end.min(old.end))..old.end].fill(0.0);
                *span = new;
            }
        };
        if width == 0 {
            return;
        }
        if work < SHARED_WORK {
            block(0, values, spans);
        } else {
            let blocks = values.chunks_mut(ROWS * width).zip(spans.chunks_mut(ROWS)).collect();
            parallel::each_of(blocks, &|i, (values, spans)| block(i * ROWS, values, spans));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(start: usize, end: usize) -> Span {
        Span { start, end }
    }

    #[test]
    fn ranges_by_hand() {
        assert_eq!(span(2, 5).union(span(7, 9)), span(2, 9));
        assert_eq!((span(2, 5).union(Span::EMPTY), Span::EMPTY.union(span(2, 5))), (span(2, 5), span(2, 5)));
        assert_eq!((span(2, 5).dilated(3, 7), Span::EMPTY.dilated(3, 7)), (span(0, 7), Span::EMPTY));
    }

    #[test]
    fn every_range_is_found() {
        for width in [1, 31, 32, 33, 70, 100] {
            for (start, end) in (0..width).flat_map(|a| (a + 1..=width).map(move |b| (a, b))) {
                let mut row = vec![0.0; width];
                (row[start], row[end - 1]) = (0.5, 0.25);
                assert_eq!(span(0, width).trimmed(&row), span(start, end), "{width}");
            }
            assert_eq!(span(0, width).trimmed(&vec![0.0; width]), Span::EMPTY);
        }
    }

    /// Whatever stood in the rows before, they have the new range and zeros around it.
    #[test]
    fn what_is_stale_is_cleared() {
        for (old, new) in [((1, 4), (3, 6)), ((3, 6), (1, 4)), ((0, 8), (3, 4)), ((3, 4), (0, 8)), ((1, 3), (5, 7))] {
            for new in [span(new.0, new.1), Span::EMPTY] {
                let mut image = SpanImage::new([8, 3]);
                let fill = |range: Span| {
                    move |_: usize, row: &mut [f64], _: &mut [f64]| {
                        row[range.start..range.end].fill(1.0);
                        range
                    }
                };
                image.write_rows(span(0, 3), 0, 0, fill(span(old.0, old.1)));
                image.write_rows(span(1, 2), 0, 0, fill(new));
                let ones: Vec<usize> = (0..24).filter(|i| image.values()[*i] != 0.0).collect();
                assert_eq!(ones, (8 + new.start..8 + new.end).collect::<Vec<_>>(), "{old:?} {new:?}");
                image.clear();
                assert_eq!((image.rows(), image.area()), (Span::EMPTY, 0));
                assert!(image.values().iter().all(|v| *v == 0.0));
            }
        }
    }
}
