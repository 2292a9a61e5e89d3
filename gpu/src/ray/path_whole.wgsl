// A sample on a ray without lines ([VAL-3], [VAL-4]).
// Twin: reference/src/ray/composite/path.rs

// Lays a sample behind what is there; `ratio` is that of a step to the reference length.
fn composite(front: Front, ray: Ray, sample: Sample, a: Attributes, shaded: Shaded, ratio: real) -> Front {
    let alpha = corrected(shaded.alpha, ratio * steps_of(sample.k));
    collect(ray, sample, a, alpha);
    return over(front, in_blend_space(shaded.rgb), alpha);
}
