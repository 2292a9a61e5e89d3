// The quintic B-spline, of prefiltered coefficients ([REC-1]).
// Twin: reference/src/field/kernel/bspline5.rs

const KERNEL_TAPS = 6;

// The pieces of the spline, x from inside out: 120 times them are 26 + 50t + 20t^2 - 20t^3 - 20t^4 + 10t^5,
// 1 + 5t + 10t^2 + 10t^3 + 5t^4 - 5t^5 and t^5.
fn bspline5_value(t: real) -> vec3<real> {
    let square = t * t;
    return vec3<real>(
        (((((10.0 * t - 20.0) * t - 20.0) * t + 20.0) * t + 50.0) * t + 26.0) * (1.0 / 120.0),
        (((((-5.0 * t + 5.0) * t + 10.0) * t + 10.0) * t + 5.0) * t + 1.0) * (1.0 / 120.0),
        square * square * t * (1.0 / 120.0),
    );
}

fn bspline5_first(t: real) -> vec3<real> {
    let square = t * t;
    return vec3<real>(
        ((((5.0 * t - 8.0) * t - 6.0) * t + 4.0) * t + 5.0) * (1.0 / 12.0),
        ((((-5.0 * t + 4.0) * t + 6.0) * t + 4.0) * t + 1.0) * (1.0 / 24.0),
        square * square * (1.0 / 24.0),
    );
}

fn bspline5_second(t: real) -> vec3<real> {
    return vec3<real>(
        (((5.0 * t - 6.0) * t - 3.0) * t + 1.0) * (1.0 / 3.0),
        (((-5.0 * t + 3.0) * t + 3.0) * t + 1.0) * (1.0 / 6.0),
        t * t * t * (1.0 / 6.0),
    );
}

// The spline at t + 2 ... t - 3 for 0 <= t <= 1: pieces in t, and their mirror images in 1 - t.
fn kernel_taps(t: real) -> Taps {
    let u = 1.0 - t;
    let a = bspline5_value(t);
    let b = bspline5_value(u);
    let c = bspline5_first(t);
    let d = bspline5_first(u);
    let e = bspline5_second(t);
    let f = bspline5_second(u);
    return Taps(
        array<real, 6>(b.z, b.y, b.x, a.x, a.y, a.z),
        array<real, 6>(-d.z, -d.y, -d.x, c.x, c.y, c.z),
        array<real, 6>(f.z, f.y, f.x, e.x, e.y, e.z),
    );
}
