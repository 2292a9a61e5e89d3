// Cuts in a style ([RAY-8]), lit by the plane's normal.
// Twin: reference/src/ray/sample/cut.rs

// The cap's colour in place of a cut's own; its opacity is a factor.
fn show_styled_cap(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    if (cut_plane < 0 || sample.k != cut_k || planes[cut_plane].has_cap != 2.0) {
        return shaded;
    }
    let n = on_sphere(eye_normal(ray, a), ray.v_eye);
    // The sphere's place in the list stands in the place of a colour.
    let c = unpremultiply(sample_sphere(i32(planes[cut_plane].r), n.xy));
    return Shaded(c.rgb, shaded.alpha * c.a);
}
