// Coverage of objects where rays can end at meshes, which belong to no object.
// Twin: reference/src/ray/composite/layers.rs

fn collect_coverage_without_meshes(ray: Ray, sample: Sample, a: Attributes, alpha: real) {
    if (met_mesh < 0 || sample.offset <= 0.0) {
        collect_coverage(ray, sample, a, alpha);
    }
}
