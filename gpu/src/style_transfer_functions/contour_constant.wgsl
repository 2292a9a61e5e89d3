// A constant threshold: no curvature ([STF-6]).
// Twin: reference/src/style_transfer_functions/contour.rs

fn contour_tau(a: Attributes) -> real {
    return params.contour_constant;
}
