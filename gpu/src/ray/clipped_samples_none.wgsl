// The samples of a ray that no plane cuts: each is evaluated at its own place.
// Twin: reference/src/ray/clipped_samples.rs

// The place at which sample k is evaluated, in steps from the anchor.
fn steps_to(k: i32) -> real {
    return real(k);
}
