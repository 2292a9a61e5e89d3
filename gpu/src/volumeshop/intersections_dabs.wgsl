// Dabs of a Gaussian brush on intersection transfer functions ([VS-4]).
// Twin: reference/src/volumeshop/intersections.rs

// A function under a dab of centre and widths `place` = (at_0, at_1, width_0, width_1) and straight colour `dab`, at the value
// at p and that at T p. With w = a exp(-((v_0 - at_0)^2/width_0^2 + (v_1 - at_1)^2/width_1^2)/2) this is "over" of Porter and
// Duff (1984): alpha' = w + alpha (1 - w), c' = (w c_dab + alpha (1 - w) c)/alpha'.
fn painted(under: Shaded, place: vec4<real>, dab: vec4<real>, values: vec2<real>) -> Shaded {
    let d = (values - place.xy) / place.zw;
    let w = dab.a * exp_of(-0.5 * (d.x * d.x + d.y * d.y));
    let alpha = w + under.alpha * (1.0 - w);
    var share = real(0.0);
    if (alpha > 0.0) {
        share = w / alpha;
    }
    return Shaded(under.rgb * (1.0 - share) + dab.rgb * share, alpha);
}

// A function under dabs in their order, which begin at `first` of the tables.
fn painted_by_all(unpainted: Shaded, first: i32, dabs: i32, values: vec2<real>) -> Shaded {
    var top = unpainted;
    for (var i = first; i < first + 2 * dabs; i += 2) {
        top = painted(top, intersection_tables[i], intersection_tables[i + 1], values);
    }
    return top;
}
