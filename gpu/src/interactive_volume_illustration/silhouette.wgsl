// Silhouettes: black where the surface turns away from the eye (4.4, [HATCH-15]).

// The test (N.V)^2 + offset > 1/2, which silhouettes fail.
fn is_silhouette(n_dot_v: real) -> bool {
    return n_dot_v * n_dot_v + params.silhouette_offset <= 0.5;
}

// A sample without a normal counts as N.V = 1 ([PREC-3]).
fn shade_silhouette(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    let n_dot_v = select(real(1.0), dot(a.normal, ray.v), a.has_normal);
    return Shaded(select(shaded.rgb, vec3<real>(), is_silhouette(n_dot_v)), shaded.alpha);
}
