// A sample in its styles (Bruckner and Groeller 2007).
// Glue: A sample in its styles.

// Straight colour, and opacity per reference length.
fn shade_style(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    let n = on_sphere(eye_normal(ray, a), ray.v_eye);
    let tau = contour_threshold(a);
    // |N.v| counts as 1 where there is no normal, which is on no contour, whatever the threshold ([PREC-3]).
    var n_dot_v = real(1.0);
    var looked_up = n.xy;
    if (a.has_normal) {
        n_dot_v = abs(dot(a.normal, ray.v));
        looked_up = pushed(looked_up, n_dot_v, tau);
    }
    let c = style_between(sample, looked_up, level_below_last(ray, sample, a));
    if (c.a == 0.0) {
        return Shaded();
    }
    let share = opacity_share(opacity_between(sample), n_dot_v, tau, a.magnitude);
    if (c.a == 1.0) {
        return Shaded(c.rgb, share);
    }
    return Shaded(c.rgb / c.a, c.a * share);
}
