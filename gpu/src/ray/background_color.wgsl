// A background of one colour, or none.
// Glue: A choice of the background.

fn background_at(pixel: i32) -> vec4<real> {
    return vec4<real>(params.background_r, params.background_g, params.background_b, params.background_a);
}
