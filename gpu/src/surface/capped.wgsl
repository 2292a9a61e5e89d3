// Cuts of an iso-surface in the colour of a cap ([RAY-8]).
// Glue: A choice of caps.

fn cap_surface(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    return under_cap(shaded, show_cap(ray, sample, a, shaded));
}
