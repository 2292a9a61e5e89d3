// The gradient and the normal of a sample.
// Twin: reference/src/ray/sample/evaluate.rs

fn measure_gradient(ray: Ray, sample: Sample, known: Attributes) -> Attributes {
    var a = known;
    a.gradient = gradient_at(sample.at);
    a.has_normal = has_normal(a.gradient);
    if (a.has_normal) {
        a.normal = normal_of(a.gradient, ray.v);
    }
    return a;
}
