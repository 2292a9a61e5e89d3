// Plain transparency ([STF-9]): alpha/alpha_d = alpha_u.
// Twin: reference/src/style_transfer_functions/transparency.rs

fn opacity_share(alpha_u: real, n_dot_v: real, tau: real, g: real) -> real {
    return alpha_u;
}
