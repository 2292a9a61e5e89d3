//! What errors are summed up by, and how numbers are written.

/// Errors in ascending order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Errors(Vec<f64>);

impl Errors {
    /// From errors in any order.
    pub(crate) fn new(mut errors: Vec<f64>) -> Self {
        errors.sort_by(f64::total_cmp);
        Self(errors)
    }

    /// The ⌈qn⌉-th of n, the first for q = 0; 0 of none.
    pub(crate) fn quantile(&self, q: f64) -> f64 {
        let rank = ((q * self.0.len() as f64).ceil() as usize).max(1);
        self.0.get(rank - 1).copied().unwrap_or(0.0)
    }

    /// The middle one.
    pub(crate) fn median(&self) -> f64 {
        self.quantile(0.5)
    }

    /// The largest.
    pub(crate) fn max(&self) -> f64 {
        self.quantile(1.0)
    }

    /// The root of the mean square.
    pub(crate) fn rms(&self) -> f64 {
        (self.0.iter().map(|e| e * e).sum::<f64>() / self.0.len() as f64).sqrt()
    }
}

/// The slope of the line fitted to (log₂ x, −log₂ error) by least squares: the order in which errors fall.
pub(crate) fn order(x: &[f64], errors: &[f64]) -> f64 {
    use drypoint::scene::math::log2;
    let points: Vec<_> = x.iter().zip(errors).map(|(&x, &e)| (log2(x), -log2(e))).collect();
    let n = points.len() as f64;
    let (mx, my) = (points.iter().map(|p| p.0).sum::<f64>() / n, points.iter().map(|p| p.1).sum::<f64>() / n);
    let (xy, xx) =
        points.iter().fold((0.0, 0.0), |s, p| (s.0 + (p.0 - mx) * (p.1 - my), s.1 + (p.0 - mx) * (p.0 - mx)));
    xy / xx
}

/// A positive number with two digits that count: `0.13`, `12`, `180`, `3.3·10⁻⁵`.
pub(crate) fn two_digits(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let written = format!("{x:.1e}");
    let (digits, exponent) = written.split_once('e').unwrap_or((&written, "0"));
    match (written.parse::<f64>(), exponent.parse::<i32>()) {
        (Ok(rounded), Ok(e @ -2..=2)) => format!("{rounded:.*}", (1 - e).max(0) as usize),
        _ => format!("{digits}·10{}", exponent.chars().map(raised).collect::<String>()),
    }
}

/// A digit or a minus sign as an exponent.
fn raised(c: char) -> char {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    c.to_digit(10).map_or('⁻', |d| DIGITS[d as usize])
}

/// A share as per cent with two digits that count.
pub(crate) fn percent(x: f64) -> String {
    format!("{} %", two_digits(100.0 * x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_and_slopes_by_hand() {
        let errors = Errors::new(vec![4.0, 1.0, 3.0, 2.0]);
        assert_eq!((errors.median(), errors.quantile(0.75), errors.max()), (2.0, 3.0, 4.0));
        assert_eq!(errors.rms(), 7.5f64.sqrt());
        // Errors that fall by 8 where x doubles: order 3.
        assert_eq!(order(&[1.0, 2.0, 4.0], &[64.0, 8.0, 1.0]), 3.0);
    }

    #[test]
    fn numbers_keep_two_digits() {
        let written = [0.125, 1.0, 0.0333, 12.4, 178.0, 3.3e-5, 1234.0, 0.0].map(two_digits);
        assert_eq!(written, ["0.12", "1.0", "0.033", "12", "180", "3.3·10⁻⁵", "1.2·10³", "0"]);
        assert_eq!(percent(0.405), "40 %");
    }
}
