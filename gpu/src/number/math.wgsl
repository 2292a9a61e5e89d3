// Transcendental functions from + - * / and the square root, the same text for f32 and f64.
// Drivers accept exp, log, pow and atan of f64 and compute them wrongly; WGSL grants f32 ones many last places.
// Twin: scene/src/math.rs

// ln 2 in two parts; the first has 12 bits, so that its product with a small whole number is exact.
const LN_2_HI = 0.693359375;
const LN_2_LO = -2.121944400546905827679e-4;
const LOG2_E = 1.4426950408889634;
const PI = 3.14159265358979323846;

// 2^n, -126 <= n <= 127.
fn power_of_two(n: i32) -> real {
    return real(bitcast<f32>(u32(n + 127) << 23u));
}

// 2 atanh(s) = ln((1 + s)/(1 - s)) for |s| <= 0.1716.
fn twice_atanh(s: real) -> real {
    let q = s * s;
    var sum = real(1.0 / 23.0);
    sum = sum * q + 1.0 / 21.0;
    sum = sum * q + 1.0 / 19.0;
    sum = sum * q + 1.0 / 17.0;
    sum = sum * q + 1.0 / 15.0;
    sum = sum * q + 1.0 / 13.0;
    sum = sum * q + 1.0 / 11.0;
    sum = sum * q + 1.0 / 9.0;
    sum = sum * q + 1.0 / 7.0;
    sum = sum * q + 1.0 / 5.0;
    sum = sum * q + 1.0 / 3.0;
    return 2.0 * (s + s * q * sum);
}

// The exponent n with x 2^-n in [0.707, 1.415), for positive x that f32 holds as a normal number.
fn exponent_of(x: real) -> i32 {
    let bits = bitcast<u32>(f32(x));
    // The mantissa of the root of 2 rounds up from here on.
    return i32((bits + 0x4afb0du) >> 23u) - 127;
}

// ln x, for positive x that f32 holds as a normal number.
fn ln(x: real) -> real {
    let n = exponent_of(x);
    let m = x * power_of_two(-n);
    let series = twice_atanh((m - 1.0) / (m + 1.0));
    return real(n) * LN_2_HI + (real(n) * LN_2_LO + series);
}

// ln(1 - alpha) for 0 <= alpha < 1, without cancellation for small alpha.
fn ln_one_minus(alpha: real) -> real {
    if (alpha < 0.25) {
        return twice_atanh(-alpha / (2.0 - alpha));
    }
    return ln(1.0 - alpha);
}

// (e^r - 1 - r)/r^2 for |r| <= 0.36.
fn exp_rest(r: real) -> real {
    var sum = real(1.0 / 87178291200.0);
    sum = sum * r + 1.0 / 6227020800.0;
    sum = sum * r + 1.0 / 479001600.0;
    sum = sum * r + 1.0 / 39916800.0;
    sum = sum * r + 1.0 / 3628800.0;
    sum = sum * r + 1.0 / 362880.0;
    sum = sum * r + 1.0 / 40320.0;
    sum = sum * r + 1.0 / 5040.0;
    sum = sum * r + 1.0 / 720.0;
    sum = sum * r + 1.0 / 120.0;
    sum = sum * r + 1.0 / 24.0;
    sum = sum * r + 1.0 / 6.0;
    return sum * r + 0.5;
}

// e^y for |y| < 87. Where f32 has no normal number it is 0.
fn exp_of(y: real) -> real {
    if (y < -87.0) {
        return 0.0;
    }
    let n = floor(y * LOG2_E + 0.5);
    let r = (y - n * LN_2_HI) - n * LN_2_LO;
    return (1.0 + (r + r * r * exp_rest(r))) * power_of_two(i32(n));
}

// 1 - e^y for y <= 0, without cancellation for small y.
fn one_minus_exp(y: real) -> real {
    if (y > -0.35) {
        return -(y + y * y * exp_rest(y));
    }
    return 1.0 - exp_of(y);
}

// x^y for x > 0.
fn power(x: real, y: real) -> real {
    return exp_of(y * ln(x));
}

fn log2_of(x: real) -> real {
    return ln(x) * LOG2_E;
}

// The angle of (cosine, sine), sine >= 0, from the x axis, in [0, pi].
fn angle(sine: real, cosine: real) -> real {
    let c = abs(cosine);
    let large = max(sine, c);
    if (large == 0.0) {
        return 0.0;
    }
    // Below tan(pi/8) in t, then half of that angle.
    let ratio = min(sine, c) / large;
    let far = ratio > 0.41421356237309503;
    let t = select(ratio, (ratio - 1.0) / (ratio + 1.0), far);
    let h = t / (1.0 + sqrt(1.0 + t * t));
    let q = h * h;
    var sum = real(-1.0 / 23.0);
    sum = sum * q + 1.0 / 21.0;
    sum = sum * q - 1.0 / 19.0;
    sum = sum * q + 1.0 / 17.0;
    sum = sum * q - 1.0 / 15.0;
    sum = sum * q + 1.0 / 13.0;
    sum = sum * q - 1.0 / 11.0;
    sum = sum * q + 1.0 / 9.0;
    sum = sum * q - 1.0 / 7.0;
    sum = sum * q + 1.0 / 5.0;
    sum = sum * q - 1.0 / 3.0;
    let small = 2.0 * (h + h * q * sum) + select(real(0.0), real(PI / 4.0), far);
    let first = select(small, PI / 2.0 - small, sine > c);
    return select(first, PI - first, cosine < 0.0);
}
