//! A transfer function as a table of equal steps, like a texture of graphics hardware (4.1, the texture tft; [STF-3]).

/// The entries of a table: α_u and i at equal steps of the range of values, exact at the steps. Between two entries
/// both are interpolated linearly, as a texture unit does.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entries {
    /// The value of entry k of n: lo + (k + ½)(hi − lo)/n, the centre of a texel.
    pub(super) at: Vec<f64>,
    /// α_u of each entry.
    pub(super) opacity: Vec<f64>,
    /// i of each entry, from 0 to N − 1 for N nodes.
    pub(super) index: Vec<f64>,
}

impl Entries {
    /// The table of `n` entries of the function with those nodes, over the values [lo, hi].
    pub(super) fn new(at: &[f64], opacity: &[f64], n: usize, [lo, hi]: [f64; 2]) -> Self {
        let step = (hi - lo) / n as f64;
        let values: Vec<f64> = (0..n).map(|k| lo + (k as f64 + 0.5) * step).collect();
        let (index, opacity) = values.iter().map(|&s| function(at, opacity, s)).unzip();
        Self { at: values, opacity, index }
    }
}

/// (i, α_u) = tft(s): i = k + (s − a_k)/(a_{k+1} − a_k) for the last k with a_k ≤ s.
fn function(at: &[f64], opacity: &[f64], s: f64) -> (f64, f64) {
    let Some(k) = at.iter().rposition(|&a| a <= s) else { return (0.0, opacity.first().copied().unwrap_or(0.0)) };
    match at.get(k + 1) {
        None => (k as f64, opacity[k]),
        Some(next) => {
            let w = (s - at[k]) / (next - at[k]);
            (k as f64 + w, opacity[k] + w * (opacity[k + 1] - opacity[k]))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_by_hand() {
        // Four texels of [0, 8] have their centres at 1, 3, 5, 7; the step at 5 belongs to its later node.
        let e = Entries::new(&[2.0, 4.0, 5.0, 5.0], &[0.0, 0.5, 0.25, 1.0], 4, [0.0, 8.0]);
        assert_eq!(e.at, [1.0, 3.0, 5.0, 7.0]);
        assert_eq!(e.index, [0.0, 0.5, 3.0, 3.0]);
        assert_eq!(e.opacity, [0.0, 0.25, 1.0, 1.0]);
    }
}
