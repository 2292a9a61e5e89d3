//! One pass of the spreading process ([HALO-5]).

use super::spans::{Span, SpanImage};
use super::taps::{Border, PaddedRow, TappedRows, Taps};
use crate::number::lanes::widely;

/// Writes F_i of H_{i−1}. Given δ and H₀, mixes F_i with H₀: H_i = δF_i + (1 − δF_i)H₀.
///
/// w = [1 2 1; 2 4 2; 1 2 1]/16 is the product of [1 2 1]/4 in y and in x, with taps at a distance of k in both. New
/// values below `floor` become 0.
pub(super) fn pass(
    h: &SpanImage,
    mix: Option<(f64, &SpanImage)>,
    k: Taps,
    floor: Option<f64>,
    border: Border,
    zeros: &[f64],
    next: &mut SpanImage,
) {
    let (width, reach) = (zeros.len(), k.reach());
    let rows = h.rows().dilated(reach, h.height());
    let work = h.area() + 2 * reach * rows.len();
    next.write_rows(rows, work, PaddedRow::len(width, reach), |y, row, scratch| {
        let around = TappedRows::new(h, y, k, border, zeros);
        // H₀ is zero where H_{i−1} is, so its range lies within that of H_{i−1}.
        let (inner, span) = (around.span, around.span.dilated(reach, width));
        if span.is_empty() {
            return span;
        }
        widely(|| {
            let (middle, range) = (around.middle.0, inner.start..inner.end);
            let in_y = PaddedRow::new(scratch, reach, inner, border, |to| {
                let [near, far] = [around.near, around.far].map(|pair| pair.map(|row| &row[range.clone()]));
                one_two_one(to, &middle[range.clone()], near, far, k.f);
            });
            let f = &mut row[span.start..span.end];
            one_two_one(f, in_y.middle(span), in_y.shifted(span, k.j), in_y.shifted(span, reach), k.f);
            if let Some((delta, h0)) = mix {
                for (h, h0) in f.iter_mut().zip(&h0.row(y).0[span.start..span.end]) {
                    let spread = delta * *h;
                    *h = spread + (1.0 - spread) * h0;
                }
            }
        });
        match floor {
            Some(floor) => cut(row, span, floor),
            None => span,
        }
    });
}

/// Copies H₀ if there is no pass. Values below `floor` become 0.
pub(super) fn copy(h0: &SpanImage, floor: f64, h: &mut SpanImage) {
    h.write_rows(h0.rows(), h0.area(), 0, |y, row, _| {
        let (values, span) = h0.row(y);
        row[span.start..span.end].copy_from_slice(&values[span.start..span.end]);
        cut(row, span, floor)
    });
}

/// Sets values below `floor` to 0, and returns the remaining range. The rest of `span` is zero.
fn cut(row: &mut [f64], span: Span, floor: f64) -> Span {
    for h in &mut row[span.start..span.end] {
        *h = if *h < floor { 0.0 } else { *h };
    }
    span.trimmed(row)
}

/// Weights [1 2 1]/4 of a tap, the middle and a tap.
#[inline(always)]
fn one_two_one(to: &mut [f64], middle: &[f64], [a, b]: [&[f64]; 2], [far_a, far_b]: [&[f64]; 2], f: f64) {
    if f == 0.0 {
        for (((to, m), a), b) in to.iter_mut().zip(middle).zip(a).zip(b) {
            *to = 0.25 * ((a + b) + 2.0 * m);
        }
        return;
    }
    let taps = a.iter().zip(b).zip(far_a).zip(far_b);
    for ((to, m), (((a, b), far_a), far_b)) in to.iter_mut().zip(middle).zip(taps) {
        *to = 0.25 * (((1.0 - f) * (a + b) + f * (far_a + far_b)) + 2.0 * m);
    }
}
