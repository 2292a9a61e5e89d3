// Gradient magnitudes as quantities ([STF-4]); 0 without a normal.
// Twin: reference/src/transfer/over/sample_quantities.rs

// ||g||, times a power of two.
fn magnitude_of_gradient(a: Attributes) -> real {
    return select(real(0.0), length_of(a.gradient), a.has_normal);
}

// |g| of [VAL-2].
fn magnitude_in_range(a: Attributes) -> real {
    return select(real(0.0), a.magnitude, a.has_normal);
}
