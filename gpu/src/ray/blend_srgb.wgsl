// Compositing of encoded colours ([VAL-3]).
// Glue: A choice of the blend space.

fn in_blend_space(rgb: vec3<real>) -> vec3<real> {
    return vec3<real>(linear_to_srgb(rgb.r), linear_to_srgb(rgb.g), linear_to_srgb(rgb.b));
}

fn decoded(rgb: vec3<real>) -> vec3<real> {
    return vec3<real>(srgb_to_linear(rgb.r), srgb_to_linear(rgb.g), srgb_to_linear(rgb.b));
}

// The background's straight colour is encoded and premultiplied, and the result is decoded.
fn over_background(front: Front, behind: vec4<real>) -> vec4<real> {
    let straight = unpremultiply(behind);
    let sum = over_premultiplied(front, premultiply(vec4<real>(in_blend_space(straight.rgb), straight.a)));
    let both = unpremultiply(vec4<real>(sum.rgb, sum.opacity));
    return premultiply(vec4<real>(decoded(both.rgb), both.a));
}
