//! Numbers of twice f64's digits, for tables and for the truth that tests compare with.

use std::cmp::Ordering;

/// The unevaluated sum of two numbers, the second at most half an ulp of the first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Double {
    pub(super) hi: f64,
    pub(super) lo: f64,
}

/// The exact comparison of a₀·a₁ with b₀·b₁, unless a product leaves the range of f64. NaN compares as equal.
pub fn compare_products(a: [f64; 2], b: [f64; 2]) -> Ordering {
    let compare = |x: f64, y: f64| x.partial_cmp(&y).unwrap_or(Ordering::Equal);
    // Rounding keeps the order, so that only equal products need what was rounded off.
    compare(a[0] * a[1], b[0] * b[1])
        .then_with(|| compare(Double::product(a[0], a[1]).lo, Double::product(b[0], b[1]).lo))
}

impl Double {
    pub(super) const fn new(x: f64) -> Self {
        Self { hi: x, lo: 0.0 }
    }

    /// a + b of two numbers, exactly (Knuth's two-sum).
    pub(super) const fn sum(a: f64, b: f64) -> Self {
        let hi = a + b;
        let b_part = hi - a;
        Self { hi, lo: (a - (hi - b_part)) + (b - b_part) }
    }

    /// a·b of two numbers, exactly (Dekker's product).
    pub(super) const fn product(a: f64, b: f64) -> Self {
        let ([a1, a0], [b1, b0]) = (halves(a), halves(b));
        let hi = a * b;
        Self { hi, lo: ((a1 * b1 - hi) + a1 * b0 + a0 * b1) + a0 * b0 }
    }

    pub(super) const fn plus(self, b: Self) -> Self {
        let s = Self::sum(self.hi, b.hi);
        let t = Self::sum(self.lo, b.lo);
        let s = Self::sum(s.hi, s.lo + t.hi);
        Self::sum(s.hi, s.lo + t.lo)
    }

    pub(super) const fn times(self, b: Self) -> Self {
        let p = Self::product(self.hi, b.hi);
        Self::sum(p.hi, p.lo + (self.hi * b.lo + self.lo * b.hi))
    }

    /// Division by a number, in two steps of long division.
    pub(super) const fn over(self, b: f64) -> Self {
        let first = self.hi / b;
        let rest = self.plus(Self::product(-first, b));
        Self::sum(first, rest.hi / b)
    }

    /// e^x − 1 for |x| < 200, to about 90 bits: Taylor's series of x/1024, ten times (1 + e)² − 1 = e(2 + e).
    pub(super) const fn exp_m1(self) -> Self {
        let x = self.over(1024.0);
        let mut e = Self::new(0.0);
        let mut n = 24;
        while n > 0 {
            // x/n (1 + e)
            e = x.over(n as f64).times(e.plus(Self::new(1.0)));
            n -= 1;
        }
        let mut doubled = 0;
        while doubled < 10 {
            e = e.times(e.plus(Self::new(2.0)));
            doubled += 1;
        }
        e
    }

    /// The logarithm of n/d, whole numbers between ½ and 2 of each other, to about 100 bits:
    /// 2 artanh(s) = 2(s + s³/3 + s⁵/5 …), s = (n − d)/(n + d).
    pub(super) const fn ln_ratio(n: f64, d: f64) -> Self {
        let s = Self::new(2.0 * (n - d)).over(n + d);
        let z = s.times(s).times(Self::new(0.25));
        let mut sum = Self::new(0.0);
        let mut k = 34;
        while k > 0 {
            k -= 1;
            sum = sum.times(z).plus(Self::new(1.0).over((2 * k + 1) as f64));
        }
        s.times(sum)
    }
}

/// The upper and the lower half of a number's digits.
const fn halves(a: f64) -> [f64; 2] {
    let c = 134_217_729.0 * a;
    let hi = c - (c - a);
    [hi, a - hi]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The digits of ln 2 and e beyond those of f64, after OEIS A002162 and A001113, as the next double.
    #[test]
    fn products_that_round_to_the_same() {
        // (1 + 2⁻³⁰)² = 1 + 2⁻²⁹ + 2⁻⁶⁰, of which f64 keeps the first two.
        let (a, b) = (1.0 + 2f64.powi(-30), 1.0 + 2f64.powi(-29));
        assert_eq!(a * a, b);
        assert_eq!(compare_products([a, a], [b, 1.0]), Ordering::Greater);
        assert_eq!(compare_products([-a, a], [b, -1.0]), Ordering::Less);
        assert_eq!(compare_products([0.0, 5.0], [-0.0, 7.0]), Ordering::Equal);
        assert_eq!(compare_products([3.0, 4.0], [6.0, 2.0]), Ordering::Equal);
        assert_eq!(compare_products([1e300, 1e300], [2.0, 1.0]), Ordering::Greater);
        assert_eq!(compare_products([f64::NAN, 1.0], [2.0, 1.0]), Ordering::Equal);
    }

    #[test]
    fn two_known_numbers() {
        let ln_2 = Double::ln_ratio(2.0, 1.0);
        assert_eq!(ln_2.hi, std::f64::consts::LN_2);
        assert!((ln_2.lo - 2.319_046_813_846_299_6e-17).abs() < 1e-31, "{ln_2:?}");
        let e = Double::new(1.0).exp_m1().plus(Double::new(1.0));
        assert_eq!(e.hi, std::f64::consts::E);
        // Ten doublings lose ten bits of 106 and the series a few.
        assert!((e.lo - 1.445_646_891_729_250_2e-16).abs() < 1e-28, "{e:?}");
    }
}
