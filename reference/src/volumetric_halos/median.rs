//! The median of 3×3 seeds, which takes single pixels away before they spread ([HALO-4]).

use super::spans::SpanImage;
use super::taps::{Border, PaddedRow, TappedRows, Taps};
use crate::number::lanes::widely;

/// Writes the median of each pixel and its eight neighbours.
pub(super) fn median(s: &SpanImage, border: Border, zeros: &[f64], to: &mut SpanImage) {
    let (width, taps) = (zeros.len(), Taps { j: 1, f: 0.0 });
    let rows = s.rows().dilated(1, s.height());
    let padded = PaddedRow::len(width, 1);
    to.write_rows(rows, 4 * s.area(), 3 * padded, |y, row, scratch| {
        let around = TappedRows::new(s, y, taps, border, zeros);
        let (inner, span) = (around.span, around.span.dilated(1, width));
        if span.is_empty() {
            return span;
        }
        widely(|| {
            let (first, rest) = scratch.split_at_mut(padded);
            let (second, third) = rest.split_at_mut(padded);
            let pad = |space, row: &[f64]| {
                PaddedRow::new(space, 1, inner, border, |to| to.copy_from_slice(&row[inner.start..inner.end]))
            };
            let rows = [pad(first, around.near[0]), pad(second, around.middle.0), pad(third, around.near[1])];
            let [a, b, c] = rows.each_ref().map(|row| {
                let [left, right] = row.shifted(span, 1);
                left.iter().zip(row.middle(span)).zip(right)
            });
            for (((to, ((a, b), c)), ((d, e), f)), ((g, h), i)) in
                row[span.start..span.end].iter_mut().zip(a).zip(b).zip(c)
            {
                *to = median_of_nine([*a, *b, *c, *d, *e, *f, *g, *h, *i]);
            }
        });
        span
    });
}

/// The fifth of nine numbers in order: a network of 19 exchanges (Paeth 1990, by Devillard).
#[inline(always)]
fn median_of_nine(mut p: [f64; 9]) -> f64 {
    const EXCHANGES: [[usize; 2]; 19] = [
        [1, 2],
        [4, 5],
        [7, 8],
        [0, 1],
        [3, 4],
        [6, 7],
        [1, 2],
        [4, 5],
        [7, 8],
        [0, 3],
        [5, 8],
        [4, 7],
        [3, 6],
        [1, 4],
        [2, 5],
        [4, 7],
        [4, 2],
        [6, 4],
        [4, 2],
    ];
    for [a, b] in EXCHANGES {
        let [x, y] = [p[a], p[b]];
        [p[a], p[b]] = if y < x { [y, x] } else { [x, y] };
    }
    p[4]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A network that orders all rows of zeros and ones orders all numbers; the median follows likewise.
    #[test]
    fn every_row_of_zeros_and_ones() {
        for bits in 0..512u32 {
            let p = std::array::from_fn(|i| f64::from(bits >> i & 1));
            assert_eq!(median_of_nine(p), f64::from(u8::from(bits.count_ones() >= 5)), "{bits:b}");
        }
    }

    /// A median of zeros and ones by hand: a plus has five of nine ones in its middle, a corner of a square four.
    #[test]
    fn a_plus_keeps_its_middle_and_a_square_loses_its_corners() {
        let filtered = |border, rows: [[u8; 5]; 4]| {
            let mut s = SpanImage::new([5, 4]);
            for (s, v) in s.values_mut().iter_mut().zip(rows.as_flattened()) {
                *s = f64::from(*v);
            }
            s.find_spans();
            let mut to = SpanImage::new([5, 4]);
            median(&s, border, &[0.0; 5], &mut to);
            to.values().iter().map(|v| *v as u8).collect::<Vec<_>>()
        };
        let plus = [[0, 0, 1, 0, 0], [0, 1, 1, 1, 0], [0, 0, 1, 0, 0], [0, 0, 0, 0, 0]];
        assert_eq!(filtered(Border::Zero, plus), [[0; 5], [0, 0, 1, 0, 0], [0; 5], [0; 5]].concat());
        let square = [[0, 1, 1, 1, 0], [0, 1, 1, 1, 0], [0, 1, 1, 1, 0], [0; 5]];
        let left = [[0, 0, 1, 0, 0], [0, 1, 1, 1, 0], [0, 0, 1, 0, 0], [0; 5]];
        assert_eq!(filtered(Border::Zero, square), left.concat());
        assert_eq!(filtered(Border::Zero, [[1; 5]; 4])[..5], [0, 1, 1, 1, 0]);
        assert_eq!(filtered(Border::Replicate, [[1; 5]; 4]), [1; 20]);
    }
}
