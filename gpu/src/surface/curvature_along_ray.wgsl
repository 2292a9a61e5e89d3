// kappa_v at an iso-surface, from the normal one step before it ([STF-5], [HATCH-14]).
// Twin: reference/src/style_transfer_functions/curvature_along_ray.rs

// Samples of the volume lie on their planes or, on cuts, before them; places on the surface lie behind.
fn measure_along_ray_at_surface(ray: Ray, sample: Sample, known: Attributes) -> Attributes {
    var a = known;
    if (sample.offset <= 0.0 || !a.has_normal) {
        return a;
    }
    a.kappa = 0.0;
    let t = hit - 1.0;
    let before = ray.origin + ray.along * (t * ray.depth_step);
    if (!in_box(before) || (PERSPECTIVE && t + params.anchor_steps <= 0.0)) {
        return a;
    }
    let g = gradient_at(locate(before));
    if (has_normal(g)) {
        a.kappa = turn_along_ray(a.normal, normal_of(g, ray.v), ray.step);
    }
    return a;
}
