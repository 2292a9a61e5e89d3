//! Sums of a separable kernel over the numbers around a cell.
//!
//! All run over differences to the number at the cell's first voxel, so that a constant has exactly that value and
//! derivatives that are exactly 0 ([REC-1], [REC-2]).

use crate::number::{Arithmetic, Real, Sym3, Vec3};

/// Weights of a kernel's `N` taps along one axis: for the value and for its first and second derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Taps<R, const N: usize> {
    pub value: [R; N],
    pub first: [R; N],
    pub second: [R; N],
}

/// Rows along x of a cell's surroundings: `row(j, k)` starts one tap below the smallest x, y and z.
///
/// The cell's first voxel is tap N/2 − 1.
#[inline(always)]
fn origin<R: Real, const N: usize>(row: impl Fn(usize, usize) -> [R; N]) -> R {
    let o = N / 2 - 1;
    row(o, o)[o]
}

#[inline(always)]
fn add<R: Real, const N: usize>(sum: &mut [R; N], row: &[R; N], weight: R) {
    for i in 0..N {
        sum[i] += row[i] * weight;
    }
}

/// Σ a b: the even terms, then the odd ones, then both. Two sums of one shape are what the compiler makes vectors of,
/// here and in all that they are made from.
#[inline(always)]
fn dot<A: Arithmetic, const N: usize>(a: &[A; N], b: &[A; N]) -> A {
    let (mut even, mut odd) = (a[0] * b[0], a[1] * b[1]);
    let mut i = 2;
    while i < N {
        even = even + a[i] * b[i];
        odd = odd + a[i + 1] * b[i + 1];
        i += 2;
    }
    even + odd
}

/// Σ w_x w_y w_z c.
#[inline(always)]
pub(super) fn value<R: Real, const N: usize>(row: impl Fn(usize, usize) -> [R; N], [x, y, z]: [[R; N]; 3]) -> R {
    let first = origin(&row);
    let mut sum = [R::ZERO; N];
    for (k, &wz) in z.iter().enumerate() {
        let mut plane = [R::ZERO; N];
        for (j, &wy) in y.iter().enumerate() {
            add(&mut plane, &row(j, k).map(|c| c - first), wy);
        }
        add(&mut sum, &plane, wz);
    }
    first + dot(&sum, &x)
}

/// The gradient along the index axes.
#[inline(always)]
pub(super) fn gradient<R: Real, const N: usize>(
    row: impl Fn(usize, usize) -> [R; N],
    [x, y, z]: &[Taps<R, N>; 3],
) -> Vec3<R> {
    let first = origin(&row);
    // Sums over z and y, named by the derivatives in (y, z).
    let [mut s00, mut s10, mut s01] = [[R::ZERO; N]; 3];
    for k in 0..N {
        let [mut p0, mut p1] = [[R::ZERO; N]; 2];
        for j in 0..N {
            let c = row(j, k).map(|c| c - first);
            add(&mut p0, &c, y.value[j]);
            add(&mut p1, &c, y.first[j]);
        }
        add(&mut s00, &p0, z.value[k]);
        add(&mut s10, &p1, z.value[k]);
        add(&mut s01, &p0, z.first[k]);
    }
    gradient_of_sums(&[s00, s10, s01], x)
}

/// One column of taps along x of the numbers around a cell: `number(j, k)` is tap j along y, k along z.
pub(super) trait Column<A> {
    /// That number, or with all others more by the same.
    fn number(&self, j: usize, k: usize) -> A;
}

/// A column's part of [`gradient`], to the same bits: its sums over z and y, named by the derivatives in (y, z), s₀₀, s₁₀ and
/// s₀₁, of the differences to `first`. A number here may be several, of which `zero` is 0.
#[inline(always)]
pub(super) fn column_sums<A: Arithmetic, const N: usize>(
    column: &impl Column<A>,
    first: A,
    [y, z]: [&Taps<A, N>; 2],
    zero: A,
) -> [A; 3] {
    let [mut s00, mut s10, mut s01] = [zero; 3];
    for k in 0..N {
        let [mut p0, mut p1] = [zero; 2];
        for j in 0..N {
            let c = column.number(j, k) - first;
            p0 = p0 + c * y.value[j];
            p1 = p1 + c * y.first[j];
        }
        s00 = s00 + p0 * z.value[k];
        s10 = s10 + p1 * z.value[k];
        s01 = s01 + p0 * z.first[k];
    }
    [s00, s10, s01]
}

/// The gradient from the sums of all columns.
#[inline(always)]
pub(super) fn gradient_of_sums<A: Arithmetic, const N: usize>(
    [s00, s10, s01]: &[[A; N]; 3],
    x: &Taps<A, N>,
) -> Vec3<A> {
    Vec3::new(dot(s00, &x.first), dot(s10, &x.value), dot(s01, &x.value))
}

/// Gradient and Hessian along the index axes.
#[inline(always)]
pub(super) fn second<R: Real, const N: usize>(
    row: impl Fn(usize, usize) -> [R; N],
    [x, y, z]: &[Taps<R, N>; 3],
) -> (Vec3<R>, Sym3<R>) {
    let first = origin(&row);
    let [mut s00, mut s10, mut s01, mut s20, mut s11, mut s02] = [[R::ZERO; N]; 6];
    for k in 0..N {
        let [mut p0, mut p1, mut p2] = [[R::ZERO; N]; 3];
        for j in 0..N {
            let c = row(j, k).map(|c| c - first);
            add(&mut p0, &c, y.value[j]);
            add(&mut p1, &c, y.first[j]);
            add(&mut p2, &c, y.second[j]);
        }
        add(&mut s00, &p0, z.value[k]);
        add(&mut s10, &p1, z.value[k]);
        add(&mut s20, &p2, z.value[k]);
        add(&mut s01, &p0, z.first[k]);
        add(&mut s11, &p1, z.first[k]);
        add(&mut s02, &p0, z.second[k]);
    }
    let gradient = Vec3::new(dot(&s00, &x.first), dot(&s10, &x.value), dot(&s01, &x.value));
    let hessian = Sym3 {
        xx: dot(&s00, &x.second),
        xy: dot(&s10, &x.first),
        xz: dot(&s01, &x.first),
        yy: dot(&s20, &x.value),
        yz: dot(&s11, &x.value),
        zz: dot(&s02, &x.value),
    };
    (gradient, hessian)
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Every<'f, F>(&'f F, usize);

    impl<const N: usize, F: Fn(usize, usize) -> [f64; N]> Column<f64> for Every<'_, F> {
        fn number(&self, j: usize, k: usize) -> f64 {
            self.0(j, k)[self.1] + 7.0
        }
    }

    /// c(i, j, k) = (1 + 2i)(1 + 3j)(1 + 5k) and taps that differ on each axis: sums that factor, worked by hand.
    #[test]
    fn sums_of_a_product_are_products_of_sums() {
        let row = |j: usize, k: usize| [0, 1].map(|i| ((1 + 2 * i) * (1 + 3 * j) * (1 + 5 * k)) as f64);
        // Weights of the value sum to 1, of derivatives to 0, as every kernel's do.
        let taps = |w: f64, d: f64, e: f64| Taps { value: [1.0 - w, w], first: [-d, d], second: [-e, e] };
        let axes = [taps(0.5, 1.0, 2.0), taps(0.25, 2.0, 4.0), taps(0.75, 4.0, 8.0)];
        // Along x: value 2, first 2, second 4; along y: 1.75, 6, 12; along z: 4.75, 20, 40.
        let (x, y, z) = ([2.0, 2.0, 4.0], [1.75, 6.0, 12.0], [4.75, 20.0, 40.0]);
        assert_eq!(value(row, axes.map(|t| t.value)), x[0] * y[0] * z[0]);
        let want = Vec3::new(x[1] * y[0] * z[0], x[0] * y[1] * z[0], x[0] * y[0] * z[1]);
        assert_eq!(gradient(row, &axes), want);
        let (g, h) = second(row, &axes);
        assert_eq!(g, want);
        let first = row(0, 0)[0] + 7.0;
        let [a, b] = [0, 1].map(|i| column_sums(&Every(&row, i), first, [&axes[1], &axes[2]], 0.0));
        assert_eq!(gradient_of_sums(&[0, 1, 2].map(|s| [a[s], b[s]]), &axes[0]), want);
        assert_eq!([h.xx, h.yy, h.zz], [x[2] * y[0] * z[0], x[0] * y[2] * z[0], x[0] * y[0] * z[2]]);
        assert_eq!([h.xy, h.xz, h.yz], [x[1] * y[1] * z[0], x[1] * y[0] * z[1], x[0] * y[1] * z[1]]);
    }
}
