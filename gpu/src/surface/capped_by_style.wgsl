// Cuts of an iso-surface in a style ([RAY-8]).
// Glue: A choice of caps.

fn cap_surface_by_style(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    return under_cap(shaded, show_styled_cap(ray, sample, a, shaded));
}
