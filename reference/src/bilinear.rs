//! Bilinear interpolation between the cells of a table, the texels of a picture or four rows of voxels.

use crate::number::{Arithmetic, Real};

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

/// Numbers at (y, z) = (0, 0), (1, 0), (0, 1), (1, 1) interpolated along y, then z.
#[inline(always)]
pub(crate) fn bilinear<R: Arithmetic>(c: [R; 4], wy: R, wz: R) -> R {
    R::lerp(R::lerp(c[0], c[1], wy), R::lerp(c[2], c[3], wy), wz)
}
