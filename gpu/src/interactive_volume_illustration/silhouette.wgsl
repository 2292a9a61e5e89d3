// Silhouettes: black where the surface turns away from the eye (4.4, [HATCH-15]).
// Twin: reference/src/interactive_volume_illustration/tone/silhouette.rs

// The test (N.V)^2 + offset > 1/2, which silhouettes fail.
fn is_silhouette(n_dot_v: real, offset: real) -> bool {
    return n_dot_v * n_dot_v + offset <= 0.5;
}

// A sample without a normal counts as N.V = 1 ([PREC-3]).
fn black_on_silhouettes(ray: Ray, a: Attributes, shaded: Shaded, offset: real) -> Shaded {
    let n_dot_v = select(real(1.0), dot(a.normal, ray.v), a.has_normal);
    return Shaded(select(shaded.rgb, vec3<real>(), is_silhouette(n_dot_v, offset)), shaded.alpha);
}
