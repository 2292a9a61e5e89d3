// Colours over the value ([STF-11]).
// Glue: A choice of the function.

fn node_color(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    return Shaded(color_at(sample.place), sample.place.alpha_u);
}
