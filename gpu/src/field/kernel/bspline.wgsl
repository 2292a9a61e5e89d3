// The cubic B-spline ([REC-1]).
// Twin: reference/src/field/kernel/bspline.rs

// t^3/6 and (1 + 3t + 3t^2 - 3t^3)/6: the pieces of the spline from outside in, and their derivatives.
fn bspline_outer(t: real) -> real {
    return t * t * t * (1.0 / 6.0);
}

fn bspline_inner(t: real) -> real {
    return 1.0 / 6.0 + 0.5 * t * (1.0 + t - t * t);
}

fn bspline_inner_first(t: real) -> real {
    return 0.5 + t - 1.5 * t * t;
}

// The spline at t + 1, t, t - 1, t - 2 for 0 <= t <= 1.
fn bspline_taps(t: real) -> Taps {
    let u = 1.0 - t;
    let zero = real(0.0);
    return Taps(
        array<real, 6>(bspline_outer(u), bspline_inner(u), bspline_inner(t), bspline_outer(t), zero, zero),
        array<real, 6>(
            -(0.5 * u * u), -bspline_inner_first(u), bspline_inner_first(t), 0.5 * t * t, zero, zero,
        ),
        array<real, 6>(u, 1.0 - 3.0 * u, 1.0 - 3.0 * t, t, zero, zero),
    );
}
