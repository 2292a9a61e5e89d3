// Contours that fade in with |g| ([STF-7]).
// Twin: reference/src/style_transfer_functions/contour.rs

// Smoothstep t^2 (3 - 2t), t = clamp((|g| - lo)/(hi - lo)). For hi = lo a step, which |g| = lo has passed.
fn contour_fade(g: real) -> real {
    if (params.fade_width == 0.0) {
        return select(real(1.0), real(0.0), g < params.fade_low);
    }
    let t = clamp_01((g - params.fade_low) / params.fade_width);
    return t * t * (3.0 - (t + t));
}

fn contour_threshold(a: Attributes) -> real {
    return contour_tau(a) * contour_fade(a.magnitude);
}
