// The push of style contours ([STF-8]).
// Twin: reference/src/style_transfer_functions/contour.rs

// (N_x, N_y) pushed outwards along the radius where |N.v| <= tau: r' = min(1, r/delta), delta = |N.v|/tau.
// There is no push for tau = 0, and r = 0 stays 0.
fn pushed(n: vec2<real>, n_dot_v: real, tau: real) -> vec2<real> {
    if (!(n_dot_v <= tau) || tau == 0.0) {
        return n;
    }
    let r = sqrt(n.x * n.x + n.y * n.y);
    if (r == 0.0) {
        return n;
    }
    return n / max(r, n_dot_v / tau);
}
