// Styles without contours: T = 0, so tau = 0 ([STF-9]).
// Twin: reference/src/style_transfer_functions/contour.rs

fn contour_threshold(a: Attributes) -> real {
    return 0.0;
}

fn pushed(n: vec2<real>, n_dot_v: real, tau: real) -> vec2<real> {
    return n;
}
