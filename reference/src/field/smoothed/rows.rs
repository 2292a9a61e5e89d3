//! The weights of stored numbers in the smoothed samples of a line and in its continuation.

use crate::field::hessian::gaussian;
use crate::field::interpolated::{TAPS, taps};
use crate::field::stencil::beyond;
use crate::field::tensor;

/// Number of samples before a cell's first one that second derivatives read.
const PAD: usize = 2;

/// The weights of one smoothed sample: the index of the first stored number with a weight, and the weights from there
/// on.
pub(super) type Row = (usize, Vec<f64>);

/// The samples that rows read: the first, and the one after the last.
pub(super) fn reads(rows: &[Row]) -> [usize; 2] {
    let first = rows.iter().map(|(first, _)| *first).min().unwrap_or(0);
    [first, rows.iter().map(|(first, weights)| first + weights.len()).max().unwrap_or(first)]
}

/// The rows of a line of n samples, smoothed with half taps, and the rows beyond its ends. Each row beyond an end is
/// continued from the nearest three, like numbers ([REC-1]).
pub(super) fn rows(n: usize, half: &[f64]) -> Vec<Row> {
    let padded = n.max(2) + 2 * PAD;
    let mut rows = vec![(0, Vec::new()); padded];
    for i in 0..n {
        let (first, weights) = if n == 1 { (0, vec![1.0]) } else { gaussian::row(half, i, n) };
        rows[PAD + i] = shortened(first, &weights);
    }
    for i in PAD + n..padded {
        rows[i] = continued(i - PAD, [1, 2, 3].map(|back| &rows[i.saturating_sub(back)]));
    }
    for i in (0..PAD).rev() {
        rows[i] = continued(padded - i - 1, [1, 2, 3].map(|ahead| &rows[(i + ahead).min(padded - 1)]));
    }
    rows
}

/// The next row of a line of n, continued from its nearest three rows.
fn continued(n: usize, near: [&Row; 3]) -> Row {
    let weights = || near.into_iter().filter(|(_, weights)| !weights.is_empty());
    let first = weights().map(|(first, _)| *first).min().unwrap_or(0);
    let end = weights().map(|(first, weights)| first + weights.len()).max().unwrap_or(0);
    let sum = |j: usize| {
        let [a, b, c] =
            near.map(|(first, weights)| j.checked_sub(*first).and_then(|k| weights.get(k)).map_or(0.0, |w| *w));
        beyond(n, a, b, c)
    };
    shortened(first, &(first..end).map(sum).collect::<Vec<f64>>())
}

/// The row of weights from `first` on, without the zeros at its ends.
fn shortened(first: usize, weights: &[f64]) -> Row {
    let from = weights.iter().position(|w| *w != 0.0).unwrap_or(0);
    let end = weights.iter().rposition(|w| *w != 0.0).map_or(from, |last| last + 1);
    (first + from, weights[from..end].to_vec())
}

/// Root sums of squares of the weights of stored numbers at each of the n voxels of a line: in the smoothed value, and
/// in the second derivative.
pub(super) fn responses(rows: &[Row], n: usize) -> Vec<[f64; 2]> {
    let tensor::Taps { value, second, .. } = taps(0.0);
    let mut sum = Vec::new();
    let mut root_sum = |rows: &[Row], taps: &[f64; TAPS]| {
        let rows = &rows[..TAPS.min(rows.len())];
        let [lowest, end] = reads(rows);
        sum.clear();
        sum.resize(end - lowest, 0.0);
        for ((first, weights), tap) in rows.iter().zip(taps) {
            for (sum, w) in sum[first - lowest..].iter_mut().zip(weights) {
                *sum += w * tap;
            }
        }
        sum.iter().map(|w| w * w).sum::<f64>().sqrt()
    };
    (0..n).map(|i| [root_sum(&rows[i..], &value), root_sum(&rows[i..], &second)]).collect()
}
