//! Tones of two directions of lines that cross on the page ([HATCH-19], not in the paper).

/// τ above which strokes are crossed.
const CROSSED: f64 = 0.6;

/// Returns the tones τ₁ and τ₂ of two directions that together print the tone τ: 1 − (1 − τ₁)(1 − τ₂) = τ. The second
/// direction begins at τ = 0.6, below which τ₂ is negative.
pub fn crossed_tones(tone: f64) -> [f64; 2] {
    [tone.min(CROSSED), (tone - CROSSED) / (1.0 - CROSSED)]
}

/// Returns the tone of the second direction if the first one keeps a constant distance. It is 0 or 1. The second
/// direction begins at the same tone as in [`crossed_tones`].
pub fn crossed_tone(tone: f64) -> f64 {
    f64::from(tone > CROSSED)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_directions_print_the_tone() {
        for tone in [0.0, 0.3, 0.6, 0.7, 0.9, 1.0] {
            let [first, second] = crossed_tones(tone);
            assert!((1.0 - (1.0 - first) * (1.0 - second.max(0.0)) - tone).abs() < 1e-15, "{tone}");
            assert_eq!(second > 0.0, crossed_tone(tone) == 1.0, "{tone}");
        }
    }
}
