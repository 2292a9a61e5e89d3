//! Bilinear interpolation between the cells of a table or the texels of a picture.

use crate::number::Real;

/// The cell min(⌊x⌋, max(n − 2, 0)) of a coordinate clamped to [0, n − 1], among n places, and the fraction in the
/// cell.
#[inline]
pub(crate) fn cell<R: Real>(x: R, n: usize) -> (usize, R) {
    let end = R::from_f64((n - 1) as f64);
    let (i, w) = x.max(R::ZERO).min(end).split();
    if i + 1 >= n && i > 0 { (i - 1, w + R::ONE) } else { (i, w) }
}

/// Channel by channel, a + w(b − a), which returns a constant exactly.
#[inline(always)]
pub(crate) fn mix<R: Real>(a: [R; 4], b: [R; 4], w: R) -> [R; 4] {
    std::array::from_fn(|c| R::lerp(a[c], b[c], w))
}
