// Styles over two quantities (4.2; [STF-4]).
// Twin: reference/src/style_transfer_functions/lookup.rs

// (sft(n, j00)(1 - w_x) + sft(n, j10) w_x)(1 - w_y) + (sft(n, j01)(1 - w_x) + sft(n, j11) w_x) w_y.
fn style_between(sample: Sample, n: vec2<real>, level: real) -> vec4<real> {
    let below = blend_of(node_patch.below);
    if (node_patch.w == 0.0) {
        return style_at(below, n, level);
    }
    let above = blend_of(node_patch.above);
    if (below.j0 == below.j1 && above.j0 == below.j0 && above.j1 == below.j0) {
        return sft(below.j0, n, level);
    }
    return from_mix(mix_texels(blended(below, n, level), blended(above, n, level), node_patch.w));
}

fn opacity_between(sample: Sample) -> real {
    return node_patch.alpha_u;
}
