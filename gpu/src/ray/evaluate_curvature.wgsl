// The curvatures of a sample that has a normal, in H's own field too ([CUR-1], [CUR-2], [PREC-3]).
// Twin: reference/src/ray/sample/evaluate.rs

fn measure_curvature(ray: Ray, sample: Sample, known: Attributes) -> Attributes {
    var a = known;
    if (!a.has_normal) {
        return a;
    }
    let second = index_second(sample.at);
    let g = world_gradient(second.gradient);
    if (!has_normal(g)) {
        return a;
    }
    let shape = world_shape(g, second);
    if (EXACT_KAPPA) {
        a.kappa = curvature_along_view(shape, ray.v);
    }
    if (PRINCIPAL) {
        a.principal = principal_curvatures(shape);
    }
    return a;
}
