// View-dependent opacity: a translucent surface is more opaque where it turns away from the eye ([HATCH-15]).
// Twin: reference/src/interactive_volume_illustration/tone/view_opacity.rs

// The exponent 1 + s (1/max(|N.V|, 2^-6) - 1).
fn view_exponent(n_dot_v: real) -> real {
    return 1.0 + params.view_opacity * (1.0 / min(max(abs(n_dot_v), 0.015625), 1.0) - 1.0);
}

// A sample without a normal keeps its opacity ([PREC-3]).
fn grow_opacity(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    if (!a.has_normal) {
        return shaded;
    }
    return Shaded(shaded.rgb, corrected(shaded.alpha, view_exponent(dot(a.normal, ray.v))));
}
