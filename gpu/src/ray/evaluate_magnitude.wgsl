// |g| of [VAL-2]: where the gradient's magnitude lies in the scene's range.
// Twin: reference/src/ray/sample/evaluate.rs

fn measure_magnitude(ray: Ray, sample: Sample, known: Attributes) -> Attributes {
    var a = known;
    if (params.gradient_width > 0.0) {
        a.magnitude = clamp_01((length_of(a.gradient) - params.gradient_low) / params.gradient_width);
    }
    return a;
}
