//! The first root of a cubic on [0, 1], from its Bernstein coefficients.

/// A cubic b₀(1−u)³ + 3b₁u(1−u)² + 3b₂u²(1−u) + b₃u³ on [0, 1].
///
/// In this form the value never leaves the range of the coefficients, and the ends are exactly b₀ and b₃. Multiplying
/// all four by a power of two changes no root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BernsteinCubic(pub(super) [f64; 4]);

/// Number of steps after which a bracket has no number inside: each third step halves it at least.
const MOST_STEPS: usize = 200;

impl BernsteinCubic {
    /// The value at u by de Casteljau's scheme, whose means stay between their operands.
    fn at(self, u: f64) -> f64 {
        let Self([a, b, c, d]) = self;
        let (ab, bc, cd) = (mix(a, b, u), mix(b, c, u), mix(c, d, u));
        mix(mix(ab, bc, u), mix(bc, cd, u), u)
    }

    /// The smallest u in [0, 1] with the value 0.
    ///
    /// A cubic is monotonic between its extrema, and has a root there if the ends have different signs. A cubic that
    /// touches 0 and turns back has its root at the extremum, if the computed value there is 0 or beyond. Rounding
    /// decides this case.
    pub(super) fn first_root(self) -> Option<f64> {
        let Self(b) = self;
        if b[0] == 0.0 {
            return Some(0.0);
        }
        let above = b[0] > 0.0;
        if b[1..].iter().all(|&b| b != 0.0 && (b > 0.0) == above) {
            return None;
        }
        let (mut from, mut before) = (0.0, b[0]);
        for to in self.extrema().into_iter().flatten().chain([1.0]) {
            let value = if to == 1.0 { b[3] } else { self.at(to) };
            if value == 0.0 {
                return Some(to);
            }
            if (value > 0.0) != above {
                return Some(self.between([from, before], [to, value]));
            }
            (from, before) = (to, value);
        }
        None
    }

    /// Zeros of the derivative in (0, 1), in ascending order.
    fn extrema(self) -> [Option<f64>; 2] {
        let Self([a, b, c, d]) = self;
        // Bernstein coefficients of a third of the derivative, divided by the largest, so that squares neither
        // overflow nor underflow.
        let d = [b - a, c - b, d - c];
        let largest = d.into_iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        if largest == 0.0 {
            return [None; 2];
        }
        let [d0, d1, d2] = d.map(|d| d / largest);
        // d₀(1−u)² + 2d₁u(1−u) + d₂u² = (d₀ − 2d₁ + d₂)u² + 2(d₁ − d₀)u + d₀.
        let (square, half, discriminant) = (d0 - 2.0 * d1 + d2, d1 - d0, d1 * d1 - d0 * d2);
        if discriminant < 0.0 {
            return [None; 2];
        }
        // Numbers of the same sign are added, so that no digits cancel. The product of both roots gives the other
        // root.
        let root = discriminant.sqrt();
        let q = if half < 0.0 { root - half } else { -root - half };
        let inside = |u: f64| (u > 0.0 && u < 1.0).then_some(u);
        let (u, v) = (inside(q / square), inside(d0 / q));
        if u > v { [v, u] } else { [u, v] }
    }

    /// The root in a part where the cubic is monotonic. The ends are given with their values, which differ in sign.
    fn between(self, from: [f64; 2], to: [f64; 2]) -> f64 {
        bracketed(|u| self.at(u), from, to)
    }
}

/// A root of a continuous function between two places whose values differ in sign. Each place is given with its
/// value. The result is a place with the value 0, or the first of two neighbouring numbers between which the sign
/// changes.
///
/// Secant steps, with a bisection at every third step, so that no shape of the function slows the search down.
pub(crate) fn bracketed(f: impl Fn(f64) -> f64, [mut lo, mut at_lo]: [f64; 2], [mut hi, mut at_hi]: [f64; 2]) -> f64 {
    let below = at_lo < 0.0;
    // The values for the secant: an end that stays gets half its value, or it would stay forever (Illinois).
    let (mut left, mut right) = (at_lo, at_hi);
    for step in 0..MOST_STEPS {
        let middle = lo + 0.5 * (hi - lo);
        let secant = lo + (hi - lo) * (left / (left - right));
        let at = if step % 3 == 2 || !(secant > lo && secant < hi) { middle } else { secant };
        if at <= lo || at >= hi {
            break;
        }
        let value = f(at);
        if value == 0.0 {
            return at;
        }
        if (value < 0.0) == below {
            (lo, at_lo) = (at, value);
            (left, right) = (value, right * 0.5);
        } else {
            (hi, at_hi) = (at, value);
            (left, right) = (left * 0.5, value);
        }
    }
    if at_hi.abs() < at_lo.abs() { hi } else { lo }
}

/// a + u(b − a) for u in [0, 1], from the nearer end: exact at both, and for a = b.
#[inline(always)]
pub(super) fn mix(a: f64, b: f64, u: f64) -> f64 {
    if u <= 0.5 { a + u * (b - a) } else { b - (1.0 - u) * (b - a) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The Bernstein coefficients of (u − p)(u − q)(u − r) by blossoming: the mean over all orders of the factors'
    /// values at the ends.
    fn with_roots([p, q, r]: [f64; 3]) -> BernsteinCubic {
        let b1 = (-p * -q * (1.0 - r) - p * (1.0 - q) * -r + (1.0 - p) * -q * -r) / 3.0;
        let b2 = (-p * (1.0 - q) * (1.0 - r) + (1.0 - p) * -q * (1.0 - r) + (1.0 - p) * (1.0 - q) * -r) / 3.0;
        BernsteinCubic([-p * -q * -r, b1, b2, (1.0 - p) * (1.0 - q) * (1.0 - r)])
    }

    #[test]
    fn the_first_of_three() {
        for roots in [[0.2, 0.5, 0.9], [0.1, 0.11, 0.12], [0.001, 0.5, 0.999], [0.3, 1.5, -2.0]] {
            let first = roots.into_iter().filter(|r| (0.0..=1.0).contains(r)).fold(1.0, f64::min);
            let got = with_roots(roots).first_root().unwrap();
            // A root moves by the coefficients' rounding over the slope there.
            let slope: f64 = roots.iter().filter(|r| **r != first).map(|r| (first - r).abs()).product();
            assert!((got - first).abs() <= 4.0 * f64::EPSILON / slope, "{roots:?}: {got}");
        }
        assert_eq!(with_roots([-0.5, 1.5, 3.0]).first_root(), None);
    }

    #[test]
    fn ends_touches_and_plateaus() {
        assert_eq!(BernsteinCubic([0.0, 1.0, 1.0, 1.0]).first_root(), Some(0.0));
        assert_eq!(BernsteinCubic([1.0, 1.0, 1.0, 0.0]).first_root(), Some(1.0));
        assert_eq!(BernsteinCubic([0.0; 4]).first_root(), Some(0.0));
        // (u − ½)²(u + 1) touches 0 at ½, where every step of the scheme is exact.
        assert_eq!(with_roots([0.5, 0.5, -1.0]).first_root(), Some(0.5));
        // Coefficients of both signs, and no root: the polygon crosses 0 and the curve does not.
        assert_eq!(BernsteinCubic([1.0, -0.3, -0.3, 1.0]).first_root(), None);
        // Linear: the first secant is exact.
        assert_eq!(BernsteinCubic([-1.0, 0.0, 1.0, 2.0]).first_root(), Some(1.0 / 3.0));
        assert_eq!(BernsteinCubic([-1e-300, 0.0, 1e-300, 2e-300]).first_root(), Some(1.0 / 3.0));
    }

    proptest! {
        /// Compares with the signs at 4096 places: the first change of sign, to the last bit of the values. Scaling
        /// changes no bit.
        #[test]
        fn no_root_is_before_the_first(b in prop::array::uniform4(-1.0..1.0f64), k in -900..900i32) {
            let cubic = BernsteinCubic(b);
            let first = cubic.first_root();
            let n = 4096;
            let places = (0..=n).map(|i| f64::from(i) / f64::from(n));
            let change = places.clone().zip(places.skip(1)).find(|&(u, v)| (cubic.at(u) < 0.0) != (cubic.at(v) < 0.0));
            if let Some((u, v)) = change {
                let root = first.unwrap();
                // A pair of roots between two of the places may come before.
                prop_assert!(root <= v);
                if root < u {
                    prop_assert!(cubic.at(root).abs() < 1e-6);
                }
            }
            if let Some(root) = first {
                prop_assert!(cubic.at(root).abs() <= 8.0 * f64::EPSILON, "{}", cubic.at(root));
            }
            let scaled = BernsteinCubic(b.map(|b| drypoint_scene::math::scale_by_power_of_two(b, k)));
            prop_assert_eq!(scaled.first_root().map(f64::to_bits), first.map(f64::to_bits));
        }
    }
}
