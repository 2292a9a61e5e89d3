// A constant threshold: no curvature ([STF-6]).

fn contour_tau(a: Attributes) -> real {
    return params.contour_constant;
}
