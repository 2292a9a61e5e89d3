// Styles that are read as they are.
// Twin: reference/src/style_transfer_functions/mipmaps.rs

fn level_below_last(ray: Ray, sample: Sample, a: Attributes) -> real {
    return 0.0;
}

fn sft(j: i32, n: vec2<real>, level: real) -> vec4<real> {
    return sample_sphere(j, n);
}
