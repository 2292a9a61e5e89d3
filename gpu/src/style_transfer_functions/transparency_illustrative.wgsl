// Illustrative transparency (eq. 2; [STF-9]).
// Twin: reference/src/style_transfer_functions/transparency.rs

// alpha/alpha_d = alpha_u^(0.5 + max(0, |N.v| - tau)(1 - |g|)); 0 and 1 stay as they are, exactly.
fn opacity_share(alpha_u: real, n_dot_v: real, tau: real, g: real) -> real {
    if (alpha_u <= 0.0 || alpha_u >= 1.0) {
        return alpha_u;
    }
    return power(alpha_u, max(n_dot_v - tau, 0.0) * (1.0 - g) + 0.5);
}
