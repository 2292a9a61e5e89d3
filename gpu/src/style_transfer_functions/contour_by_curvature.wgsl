// The threshold of eq. 1 ([STF-7]).
// Twin: reference/src/style_transfer_functions/contour.rs

// sqrt(x (2 - x)), x = T kappa clamped to [0, 1].
fn contour_root(t_kappa: real) -> real {
    let x = clamp_01(t_kappa);
    return sqrt(x * (2.0 - x));
}

fn contour_tau(a: Attributes) -> real {
    return contour_root(abs(a.kappa) * params.contour_thickness);
}
