// The styles between two nodes ([STF-3]).
// Twin: reference/src/style_transfer_functions/lookup.rs

// j0 and j1 in the shares 1 - w and w.
struct Blend {
    j0: i32,
    j1: i32,
    w: real,
}

// The styles of a place: j0 = ift(i0), j1 = ift(i0 + 1) (4.1, steps 2 and 3).
fn blend_of(place: NodePlace) -> Blend {
    if (place.w == 0.0) {
        let j = style_of(place.node);
        return Blend(j, j, 0.0);
    }
    let j1 = style_of(place.node + 1);
    // A value just below a node can round to the whole way; then the first style has no share.
    if (place.w >= 1.0) {
        return Blend(j1, j1, 0.0);
    }
    return Blend(style_of(place.node), j1, place.w);
}

// The lookup in one style, or the mix of two, ready for a further mix.
fn blended(blend: Blend, n: vec2<real>, level: real) -> vec4<real> {
    let first = to_mix(sft(blend.j0, n, level));
    if (blend.j0 == blend.j1) {
        return first;
    }
    return mix_texels(first, to_mix(sft(blend.j1, n, level)), blend.w);
}

// sft(n, j0) (1 - w) + sft(n, j1) w (4.1, step 4), linear and premultiplied.
fn style_at(blend: Blend, n: vec2<real>, level: real) -> vec4<real> {
    if (blend.j0 == blend.j1) {
        return sft(blend.j0, n, level);
    }
    return from_mix(blended(blend, n, level));
}
