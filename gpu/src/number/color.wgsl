// sRGB and linear light ([VAL-3]).
// Twin: scene/src/color.rs

fn linear_to_srgb(c: real) -> real {
    if (c <= 0.0031308) {
        return 12.92 * c;
    }
    return 1.055 * power(c, real(1.0 / 2.4)) - 0.055;
}

fn srgb_to_linear(c: real) -> real {
    if (c <= 0.04045) {
        return c / 12.92;
    }
    return power((c + 0.055) / 1.055, real(2.4));
}

fn premultiply(c: vec4<real>) -> vec4<real> {
    return vec4<real>(c.rgb * c.a, c.a);
}

fn unpremultiply(c: vec4<real>) -> vec4<real> {
    if (c.a == 0.0) {
        return vec4<real>();
    }
    return vec4<real>(c.rgb / c.a, c.a);
}
