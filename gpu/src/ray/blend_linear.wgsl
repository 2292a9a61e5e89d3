// Compositing of linear colours ([VAL-3]).
// Glue: A choice of the blend space.

fn in_blend_space(rgb: vec3<real>) -> vec3<real> {
    return rgb;
}

fn over_background(front: Front, behind: vec4<real>) -> vec4<real> {
    let sum = over_premultiplied(front, behind);
    return vec4<real>(sum.rgb, sum.opacity);
}
