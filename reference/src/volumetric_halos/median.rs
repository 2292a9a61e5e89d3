//! The median of 3×3 seeds, which removes single pixels before seeds spread ([HALO-4]).

use super::spans::SpanImage;
use super::taps::{Border, PaddedRow, TappedRows, Taps};
use crate::number::lanes::widely;

/// Writes the median of each pixel and its eight neighbours.
///
/// Each column of three is sorted, and neighbouring pixels share columns. The median of the nine is the median of three
/// numbers: the maximum of the three minima, the median of the three medians, and the minimum of the three maxima.
pub(super) fn median(s: &SpanImage, border: Border, zeros: &[f64], to: &mut SpanImage) {
    let (width, taps) = (zeros.len(), Taps { j: 1, f: 0.0 });
    let rows = s.rows().dilated(1, s.height());
    let padded = PaddedRow::len(width, 1);
    to.write_rows(rows, 4 * s.area(), 3 * padded + 2 * width, |y, row, scratch| {
        let around = TappedRows::new(s, y, taps, border, zeros);
        let (inner, span) = (around.span, around.span.dilated(1, width));
        if span.is_empty() {
            return span;
        }
        let column = [around.near[0], around.middle.0, around.near[1]].map(|row| &row[inner.start..inner.end]);
        let (columns, rows) = scratch.split_at_mut(3 * padded);
        let (least, rest) = columns.split_at_mut(padded);
        let (medians, largest) = rest.split_at_mut(padded);
        let (of_least, of_medians) = rows.split_at_mut(width);
        let [to, of_least, of_medians] = [row, of_least, of_medians].map(|row| &mut row[span.start..span.end]);
        widely(|| {
            // Columns are sorted.
            let least = PaddedRow::new(least, 1, inner, border, |to| each_of_three(to, column, least_of_three));
            let medians = PaddedRow::new(medians, 1, inner, border, |to| each_of_three(to, column, median_of_three));
            let largest = PaddedRow::new(largest, 1, inner, border, |to| each_of_three(to, column, largest_of_three));
            // Three sorted columns are combined.
            each_of_three(of_least, least.around(span), largest_of_three);
            each_of_three(of_medians, medians.around(span), median_of_three);
            each_of_three(to, largest.around(span), least_of_three);
            for ((to, a), b) in to.iter_mut().zip(of_least).zip(of_medians) {
                *to = median_of_three(*a, *b, *to);
            }
        });
        span
    });
}

/// Writes a function of the numbers of three rows.
#[inline(always)]
fn each_of_three(to: &mut [f64], [a, b, c]: [&[f64]; 3], of: impl Fn(f64, f64, f64) -> f64) {
    for (((to, a), b), c) in to.iter_mut().zip(a).zip(b).zip(c) {
        *to = of(*a, *b, *c);
    }
}

#[inline(always)]
fn less(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

#[inline(always)]
fn more(a: f64, b: f64) -> f64 {
    if b < a { a } else { b }
}

#[inline(always)]
fn least_of_three(a: f64, b: f64, c: f64) -> f64 {
    less(less(a, b), c)
}

#[inline(always)]
fn largest_of_three(a: f64, b: f64, c: f64) -> f64 {
    more(more(a, b), c)
}

#[inline(always)]
fn median_of_three(a: f64, b: f64, c: f64) -> f64 {
    more(less(a, b), less(more(a, b), c))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filtered(size: [usize; 2], s: &[f64], border: Border) -> Vec<f64> {
        let [mut image, mut to] = [SpanImage::new(size), SpanImage::new(size)];
        image.values_mut().copy_from_slice(s);
        image.find_spans();
        median(&image, border, &vec![0.0; size[0]], &mut to);
        to.values().to_vec()
    }

    /// A filter of order that is right for all zeros and ones is right for all numbers: thresholds commute with it.
    #[test]
    fn every_nine_of_zeros_and_ones() {
        for bits in 0..512u32 {
            let s: Vec<f64> = (0..9).map(|i| f64::from(bits >> i & 1)).collect();
            let expected = f64::from(u8::from(bits.count_ones() >= 5));
            assert_eq!(filtered([3, 3], &s, Border::Zero)[4], expected, "{bits:b}");
        }
    }

    /// By hand: the middle of a plus has five ones of nine, a corner of a square four.
    #[test]
    fn a_plus_keeps_its_middle_and_a_square_loses_its_corners() {
        let of = |border, rows: [[u8; 5]; 4]| {
            let s: Vec<f64> = rows.as_flattened().iter().map(|v| f64::from(*v)).collect();
            filtered([5, 4], &s, border).into_iter().map(|v| v as u8).collect::<Vec<_>>()
        };
        let plus = [[0, 0, 1, 0, 0], [0, 1, 1, 1, 0], [0, 0, 1, 0, 0], [0, 0, 0, 0, 0]];
        assert_eq!(of(Border::Zero, plus), [[0; 5], [0, 0, 1, 0, 0], [0; 5], [0; 5]].concat());
        let square = [[0, 1, 1, 1, 0], [0, 1, 1, 1, 0], [0, 1, 1, 1, 0], [0; 5]];
        let left = [[0, 0, 1, 0, 0], [0, 1, 1, 1, 0], [0, 0, 1, 0, 0], [0; 5]];
        assert_eq!(of(Border::Zero, square), left.concat());
        assert_eq!(of(Border::Zero, [[1; 5]; 4])[..5], [0, 1, 1, 1, 0]);
        assert_eq!(of(Border::Replicate, [[1; 5]; 4]), [1; 20]);
    }
}
