//! Medians and quartiles of times ([COST-3]).

/// Returns the quantile of a share, linear between neighbours; NaN without a value.
pub(crate) fn quantile(values: &[f64], share: f64) -> f64 {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    let Some(last) = values.len().checked_sub(1) else { return f64::NAN };
    let at = share * last as f64;
    let below = at.floor() as usize;
    let above = (below + 1).min(last);
    values[below] + (at - below as f64) * (values[above] - values[below])
}

/// Returns the median, the mean of the middle two of an even number of values; NaN without a value.
pub fn median(values: &[f64]) -> f64 {
    quantile(values, 0.5)
}

/// Returns the quartiles at a quarter and at three quarters.
pub(super) fn quartiles(values: &[f64]) -> [f64; 2] {
    [0.25, 0.75].map(|share| quantile(values, share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_hand() {
        assert_eq!((median(&[3.0]), quartiles(&[3.0])), (3.0, [3.0, 3.0]));
        assert_eq!(median(&[4.0, 1.0]), 2.5);
        // One outlier moves neither.
        assert_eq!((median(&[5.0, 1.0, 2.0, 900.0, 3.0]), quartiles(&[5.0, 1.0, 2.0, 900.0, 3.0])), (3.0, [2.0, 5.0]));
        assert_eq!(quartiles(&[0.0, 1.0, 2.0, 3.0]), [0.75, 2.25]);
        assert!(median(&[]).is_nan());
    }
}
