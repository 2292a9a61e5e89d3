//! Sums of a separable kernel over the numbers around a cell.
//!
//! All sums run over differences to the number at the cell's first voxel. So a constant field has exactly its value,
//! and derivatives that are exactly 0 ([REC-1], [REC-2]).

use crate::number::{Arithmetic, Real, Sym3, Vec3};
use std::ops::{Add, Mul, Sub};

/// Weights of a kernel's `N` taps along one axis: for the value and for its first and second derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Taps<R, const N: usize> {
    pub value: [R; N],
    pub first: [R; N],
    pub second: [R; N],
}

/// A summand over z and y: a number, the same tap of several cells, or the taps of a row along x. `W` is the type of
/// its weights.
pub(super) trait Row<W>: Copy + Add<Output = Self> + Sub<W, Output = Self> + Mul<W, Output = Self> {}

impl<W, A: Copy + Add<Output = A> + Sub<W, Output = A> + Mul<W, Output = A>> Row<W> for A {}

/// The rows around a cell: `row(j, k)` is tap j along y, k along z. The cell's first voxel is tap N/2 − 1 on each axis.
pub(super) trait Rows<A> {
    /// The row at (j, k). All rows may be shifted by one common constant.
    fn row(&self, j: usize, k: usize) -> A;

    /// A row of zeros.
    fn zero(&self) -> A;
}

/// Rows of numbers from a function.
pub(super) struct RowsFn<F>(pub F);

impl<R: Real, const N: usize, F: Fn(usize, usize) -> [R; N]> Rows<Numbers<R, N>> for RowsFn<F> {
    #[inline(always)]
    fn row(&self, j: usize, k: usize) -> Numbers<R, N> {
        Numbers((self.0)(j, k))
    }

    #[inline(always)]
    fn zero(&self) -> Numbers<R, N> {
        Numbers([R::ZERO; N])
    }
}

/// `N` numbers along x.
#[derive(Clone, Copy)]
pub(super) struct Numbers<R, const N: usize>([R; N]);

impl<R: Real, const N: usize> From<Numbers<R, N>> for [R; N] {
    #[inline(always)]
    fn from(numbers: Numbers<R, N>) -> Self {
        numbers.0
    }
}

impl<R: Real, const N: usize> Add for Numbers<R, N> {
    type Output = Self;

    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        for i in 0..N {
            self.0[i] += other.0[i];
        }
        self
    }
}

impl<R: Real, const N: usize> Sub<R> for Numbers<R, N> {
    type Output = Self;

    #[inline(always)]
    fn sub(mut self, less: R) -> Self {
        for i in 0..N {
            self.0[i] -= less;
        }
        self
    }
}

impl<R: Real, const N: usize> Mul<R> for Numbers<R, N> {
    type Output = Self;

    #[inline(always)]
    fn mul(mut self, weight: R) -> Self {
        for i in 0..N {
            self.0[i] *= weight;
        }
        self
    }
}

/// The number at the cell's first voxel.
#[inline(always)]
fn origin<R: Real, A: Into<[R; N]>, const N: usize>(rows: &impl Rows<A>) -> R {
    let o = N / 2 - 1;
    let row: [R; N] = rows.row(o, o).into();
    row[o]
}

/// Σ a b: the even terms plus the odd ones. The compiler vectorizes pairs of sums of one shape, here and in the
/// callers.
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
pub(super) fn value<R: Real, A: Row<R> + Into<[R; N]>, const N: usize>(
    rows: &impl Rows<A>,
    [x, y, z]: &[Taps<R, N>; 3],
) -> R {
    let first = origin(rows);
    let mut sum = rows.zero();
    for k in 0..N {
        let mut plane = rows.zero();
        for j in 0..N {
            plane = plane + (rows.row(j, k) - first) * y.value[j];
        }
        sum = sum + plane * z.value[k];
    }
    first + dot(&sum.into(), &x.value)
}

/// The gradient along the index axes.
#[inline(always)]
pub(super) fn gradient<R: Real, A: Row<R> + Into<[R; N]>, const N: usize>(
    rows: &impl Rows<A>,
    [x, y, z]: &[Taps<R, N>; 3],
) -> Vec3<R> {
    let [s00, s10, s01] = gradient_sums(rows, origin(rows), [y, z]);
    gradient_of_sums(&[s00.into(), s10.into(), s01.into()], x)
}

/// Sums over z and y of the differences to `first`, named by the derivatives in (y, z): s₀₀, s₁₀ and s₀₁.
#[inline(always)]
pub(super) fn gradient_sums<W: Copy, A: Row<W>, const N: usize>(
    rows: &impl Rows<A>,
    first: W,
    [y, z]: [&Taps<W, N>; 2],
) -> [A; 3] {
    let [mut s00, mut s10, mut s01] = [rows.zero(); 3];
    for k in 0..N {
        let [mut p0, mut p1] = [rows.zero(); 2];
        for j in 0..N {
            let c = rows.row(j, k) - first;
            p0 = p0 + c * y.value[j];
            p1 = p1 + c * y.first[j];
        }
        s00 = s00 + p0 * z.value[k];
        s10 = s10 + p1 * z.value[k];
        s01 = s01 + p0 * z.first[k];
    }
    [s00, s10, s01]
}

/// The gradient from the sums s₀₀, s₁₀ and s₀₁.
#[inline(always)]
pub(super) fn gradient_of_sums<A: Arithmetic, const N: usize>(
    [s00, s10, s01]: &[[A; N]; 3],
    x: &Taps<A, N>,
) -> Vec3<A> {
    Vec3::new(dot(s00, &x.first), dot(s10, &x.value), dot(s01, &x.value))
}

/// Gradient and Hessian along the index axes.
#[inline(always)]
pub(super) fn second<R: Real, A: Row<R> + Into<[R; N]>, const N: usize>(
    rows: &impl Rows<A>,
    [x, y, z]: &[Taps<R, N>; 3],
) -> (Vec3<R>, Sym3<R>) {
    let first = origin(rows);
    let [mut s00, mut s10, mut s01, mut s20, mut s11, mut s02] = [rows.zero(); 6];
    for k in 0..N {
        let [mut p0, mut p1, mut p2] = [rows.zero(); 3];
        for j in 0..N {
            let c = rows.row(j, k) - first;
            p0 = p0 + c * y.value[j];
            p1 = p1 + c * y.first[j];
            p2 = p2 + c * y.second[j];
        }
        s00 = s00 + p0 * z.value[k];
        s10 = s10 + p1 * z.value[k];
        s20 = s20 + p2 * z.value[k];
        s01 = s01 + p0 * z.first[k];
        s11 = s11 + p1 * z.first[k];
        s02 = s02 + p0 * z.second[k];
    }
    let [s00, s10, s01]: [[R; N]; 3] = [s00.into(), s10.into(), s01.into()];
    let [s20, s11, s02]: [[R; N]; 3] = [s20.into(), s11.into(), s02.into()];
    let hessian = Sym3 {
        xx: dot(&s00, &x.second),
        xy: dot(&s10, &x.first),
        xz: dot(&s01, &x.first),
        yy: dot(&s20, &x.value),
        yz: dot(&s11, &x.value),
        zz: dot(&s02, &x.value),
    };
    (gradient_of_sums(&[s00, s10, s01], x), hessian)
}

/// A sum over the 4³ numbers around a cell, for any storage of their rows.
pub(super) trait Sum<R: Real> {
    /// The type of the sum.
    type Of;

    /// The sum.
    fn over<A: Row<R> + Into<[R; 4]>>(&self, rows: &impl Rows<A>) -> Self::Of;
}

macro_rules! sums {
    ($($name:ident, $sum:ident, $of:ty;)*) => { $(
        #[doc = concat!("[`", stringify!($sum), "`] at the way `w` into a cell, of a kernel's taps.")]
        pub(super) struct $name<R, F> {
            pub w: [R; 3],
            pub taps: F,
        }

        impl<R: Real, F: Fn(R) -> Taps<R, 4>> Sum<R> for $name<R, F> {
            type Of = $of;

            #[inline(always)]
            fn over<A: Row<R> + Into<[R; 4]>>(&self, rows: &impl Rows<A>) -> $of {
                let Self { w: [x, y, z], taps } = self;
                $sum(rows, &[taps(*x), taps(*y), taps(*z)])
            }
        }
    )* };
}
sums! {
    Value, value, R;
    Gradient, gradient, Vec3<R>;
    Second, second, (Vec3<R>, Sym3<R>);
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Every<'f, F>(&'f F, usize);

    impl<const N: usize, F: Fn(usize, usize) -> [f64; N]> Rows<f64> for Every<'_, F> {
        fn row(&self, j: usize, k: usize) -> f64 {
            self.0(j, k)[self.1] + 7.0
        }

        fn zero(&self) -> f64 {
            0.0
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
        assert_eq!(value(&RowsFn(row), &axes), x[0] * y[0] * z[0]);
        let want = Vec3::new(x[1] * y[0] * z[0], x[0] * y[1] * z[0], x[0] * y[0] * z[1]);
        assert_eq!(gradient(&RowsFn(row), &axes), want);
        let (g, h) = second(&RowsFn(row), &axes);
        assert_eq!(g, want);
        let first = row(0, 0)[0] + 7.0;
        let [a, b] = [0, 1].map(|i| gradient_sums(&Every(&row, i), first, [&axes[1], &axes[2]]));
        assert_eq!(gradient_of_sums(&[0, 1, 2].map(|s| [a[s], b[s]]), &axes[0]), want);
        assert_eq!([h.xx, h.yy, h.zz], [x[2] * y[0] * z[0], x[0] * y[2] * z[0], x[0] * y[0] * z[2]]);
        assert_eq!([h.xy, h.xz, h.yz], [x[1] * y[1] * z[0], x[1] * y[0] * z[1], x[0] * y[1] * z[1]]);
    }
}
