// Opacity correction ([VAL-4]).
// Twin: reference/src/ray/opacity.rs

// From an opacity per reference length to that of a way `ratio` times as long: 1 - (1 - alpha)^ratio.
fn corrected(alpha: real, ratio: real) -> real {
    if (alpha <= 0.0) {
        return 0.0;
    }
    if (alpha >= 1.0) {
        return 1.0;
    }
    if (ratio == 1.0) {
        return alpha;
    }
    if (ratio == 0.5) {
        return alpha / (1.0 + sqrt(1.0 - alpha));
    }
    return one_minus_exp(ratio * ln_one_minus(alpha));
}
