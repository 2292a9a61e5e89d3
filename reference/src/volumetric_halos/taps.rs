//! Reads of an image at a distance on both sides of a pixel, and beyond its border ([HALO-4], [HALO-5]).

use super::spans::{Span, SpanImage};
use drypoint_scene::shot::halo::split_distance;

/// The values of an image beyond its border.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Border {
    /// Zeros: a structure that the frame cuts has no halo along the frame.
    Zero,
    /// The nearest pixel's value.
    Replicate,
}

/// Two taps, t pixels before and after a pixel. If t is not an integer, each tap is linear between two pixels: (1 −
/// f)·a(±j) + f·a(±(j + 1)), t = j + f.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Taps {
    pub(super) j: usize,
    pub(super) f: f64,
}

impl Taps {
    /// Makes taps at a distance of t ≥ 0 pixels. `side` is the longer side of the image. A larger t is replaced by
    /// `side`, since both read only values beyond the border.
    pub(super) fn new(t: f64, side: usize) -> Self {
        let (j, f) = split_distance(t, side);
        Self { j, f }
    }

    /// The largest distance of a pixel that the taps read.
    pub(super) fn reach(self) -> usize {
        self.j + usize::from(self.f > 0.0)
    }
}

/// The rows of an image that taps in y read for one row, and the range outside which all of them are zero.
pub(super) struct TappedRows<'a> {
    /// The row itself, and its range.
    pub(super) middle: (&'a [f64], Span),
    /// The rows at −j and +j.
    pub(super) near: [&'a [f64]; 2],
    /// The rows at −(j + 1) and j + 1; read if f > 0.
    pub(super) far: [&'a [f64]; 2],
    /// Union of the ranges.
    pub(super) span: Span,
}

impl<'a> TappedRows<'a> {
    /// Finds the rows around row y. `zeros` is a row of zeros.
    #[inline(always)]
    pub(super) fn new(image: &'a SpanImage, y: usize, taps: Taps, border: Border, zeros: &'a [f64]) -> Self {
        let last = image.height() - 1;
        let row = |inside: Option<usize>, nearest: usize| match (inside, border) {
            (Some(y), _) => image.row(y),
            (None, Border::Replicate) => image.row(nearest),
            (None, Border::Zero) => (zeros, Span::EMPTY),
        };
        let pair = |t: usize| [row(y.checked_sub(t), 0), row(Some(y + t).filter(|y| *y <= last), last)];
        let middle = image.row(y);
        let near = pair(taps.j);
        let far = if taps.f > 0.0 { pair(taps.j + 1) } else { near };
        let span = near.iter().chain(&far).fold(middle.1, |span, (_, other)| span.union(*other));
        Self { middle, near: near.map(|(row, _)| row), far: far.map(|(row, _)| row), span }
    }
}

/// A row with `pad` pixels beyond the border on each side.
pub(super) struct PaddedRow<'a> {
    values: &'a mut [f64],
    pad: usize,
}

impl<'a> PaddedRow<'a> {
    /// Numbers that a row takes.
    pub(super) fn len(width: usize, pad: usize) -> usize {
        width + 2 * pad
    }

    /// Makes a row in a space of [`len`](Self::len) numbers. `fill` writes the range outside which the row is zero.
    ///
    /// Pixels farther than twice `pad` from the range keep earlier numbers and must not be read. A filter's values
    /// differ from zero up to `pad` beyond the range, and its taps reach `pad` farther.
    #[inline(always)]
    pub(super) fn new(
        values: &'a mut [f64],
        pad: usize,
        span: Span,
        border: Border,
        fill: impl FnOnce(&mut [f64]),
    ) -> Self {
        let width = values.len() - 2 * pad;
        let begin = span.start.saturating_sub(pad);
        let end = (span.end + 3 * pad).min(values.len());
        values[begin..span.start + pad].fill(0.0);
        values[span.end + pad..end].fill(0.0);
        fill(&mut values[span.start + pad..span.end + pad]);
        if border == Border::Replicate {
            let [first, last] = [values[pad], values[pad + width - 1]];
            if span.start == 0 {
                values[..pad].fill(first);
            }
            if span.end == width {
                values[width + pad..].fill(last);
            }
        }
        Self { values, pad }
    }

    /// The pixels of a range, shifted by `t` ≤ `pad` to each side.
    #[inline(always)]
    pub(super) fn shifted(&self, span: Span, t: usize) -> [&[f64]; 2] {
        let at = span.start + self.pad;
        [&self.values[at - t..][..span.len()], &self.values[at + t..][..span.len()]]
    }

    /// The pixels of a range, between their neighbours on the left and on the right.
    #[inline(always)]
    pub(super) fn around(&self, span: Span) -> [&[f64]; 3] {
        let [left, right] = self.shifted(span, 1);
        [left, self.middle(span), right]
    }

    /// The pixels of a range.
    #[inline(always)]
    pub(super) fn middle(&self, span: Span) -> &[f64] {
        &self.values[span.start + self.pad..span.end + self.pad]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_by_hand() {
        assert_eq!((Taps::new(2.0, 9), Taps::new(2.0, 9).reach()), (Taps { j: 2, f: 0.0 }, 2));
        assert_eq!((Taps::new(2.25, 9), Taps::new(2.25, 9).reach()), (Taps { j: 2, f: 0.25 }, 3));
        for t in [9.0, 9.5, 1e300, f64::INFINITY] {
            assert_eq!(Taps::new(t, 9), Taps { j: 9, f: 0.0 });
        }
    }
}
