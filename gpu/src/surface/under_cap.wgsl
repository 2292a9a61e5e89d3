// Caps of an opaque surface ([RAY-8]).
// Glue: A cap over an opaque surface.

// The colour of an opaque surface under a cap, which lies over its own.
fn under_cap(own: Shaded, cap: Shaded) -> Shaded {
    return Shaded(lerp3(own.rgb, cap.rgb, cap.alpha), own.alpha);
}
