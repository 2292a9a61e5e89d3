//! Quantiles without interpolation ([VAL-2]).

/// The quantile q in [0, 1] of n numbers: the ⌈qn⌉-th in ascending order, the first for q = 0. `None` for no numbers.
/// Reorders its argument. The numbers are finite.
pub fn quantile(values: &mut [f64], q: f64) -> Option<f64> {
    if values.is_empty() {
        return None;
    }
    let rank = ((q * values.len() as f64).ceil() as usize).clamp(1, values.len());
    Some(*values.select_nth_unstable_by(rank - 1, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_by_hand() {
        let mut v = [30.0, 10.0, 20.0, 40.0];
        for (q, want) in
            [(0.0, 10.0), (0.25, 10.0), (0.26, 20.0), (0.5, 20.0), (0.75, 30.0), (0.999, 40.0), (1.0, 40.0)]
        {
            assert_eq!(quantile(&mut v, q), Some(want), "{q}");
        }
        assert_eq!(quantile(&mut [], 0.5), None);
    }
}
