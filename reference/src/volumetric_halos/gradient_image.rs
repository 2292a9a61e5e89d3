//! The magnitude of the seed image's gradient ([HALO-4]).

use super::spans::SpanImage;
use super::taps::{Border, PaddedRow, TappedRows, Taps};
use crate::number::lanes::widely;

/// Writes √(dx² + dy²), at most 1, where dx = (S(x + q, y) − S(x − q, y))/2 and dy likewise.
///
/// Differences over ±q pixels are not divided by q, so a step of seeds keeps its height at every resolution.
pub(super) fn gradient_magnitude(s: &SpanImage, q: Taps, border: Border, zeros: &[f64], magnitude: &mut SpanImage) {
    let (width, reach) = (zeros.len(), q.reach());
    let rows = s.rows().dilated(reach, s.height());
    let padded = PaddedRow::len(width, reach);
    let work = s.area() + 2 * reach * rows.len();
    magnitude.write_rows(rows, work, padded + width, |y, row, scratch| {
        let around = TappedRows::new(s, y, q, border, zeros);
        let (middle, inside) = around.middle;
        let span = inside.dilated(reach, width).union(around.span);
        if span.is_empty() {
            return span;
        }
        let (scratch, dy) = scratch.split_at_mut(padded);
        widely(|| {
            let range = span.start..span.end;
            let dy = &mut dy[range.clone()];
            half_difference(dy, around.near.map(|r| &r[range.clone()]), around.far.map(|r| &r[range.clone()]), q.f);
            let s = PaddedRow::new(scratch, reach, span, border, |to| to.copy_from_slice(&middle[range.clone()]));
            let dx = &mut row[range.clone()];
            half_difference(dx, s.shifted(span, q.j), s.shifted(span, reach), q.f);
            for (g, dy) in dx.iter_mut().zip(dy) {
                *g = (*g * *g + *dy * *dy).sqrt().min(1.0);
            }
        });
        span
    });
}

/// Half the difference of two taps.
#[inline(always)]
fn half_difference(d: &mut [f64], [a, b]: [&[f64]; 2], [far_a, far_b]: [&[f64]; 2], f: f64) {
    if f == 0.0 {
        for ((d, a), b) in d.iter_mut().zip(a).zip(b) {
            *d = 0.5 * (b - a);
        }
        return;
    }
    for ((((d, a), b), far_a), far_b) in d.iter_mut().zip(a).zip(b).zip(far_a).zip(far_b) {
        *d = 0.5 * ((1.0 - f) * (b - a) + f * (far_b - far_a));
    }
}
