// Functions that the numbers of both widths have in common.
// Twin: reference/src/number/arithmetic.rs

fn lerp(a: real, b: real, w: real) -> real {
    return a + w * (b - a);
}

fn lerp3(a: vec3<real>, b: vec3<real>, w: real) -> vec3<real> {
    return a + (b - a) * w;
}

fn clamp_01(x: real) -> real {
    return min(max(x, 0.0), 1.0);
}

// x^n by repeated squaring, lowest bit first.
fn pow_whole(x: real, n: u32) -> real {
    var result = real(1.0);
    var square = x;
    var left = n;
    while (left > 0u) {
        if ((left & 1u) == 1u) {
            result = result * square;
        }
        square = square * square;
        left = left >> 1u;
    }
    return result;
}
