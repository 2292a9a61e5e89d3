// Styles over the value ([STF-3]).
// Twin: reference/src/style_transfer_functions/lookup.rs

fn style_between(sample: Sample, n: vec2<real>, level: real) -> vec4<real> {
    return style_at(blend_of(sample.place), n, level);
}

fn opacity_between(sample: Sample) -> real {
    return sample.place.alpha_u;
}
