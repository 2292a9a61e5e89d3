// Gradients of samples that are composited and seed: measured once.
// Glue: Queries of samples.

// The plane of the sample that was measured last, and what was measured.
var<private> measured_plane: i32;
var<private> measured_before: Attributes;

fn forget_sample() {
    measured_plane = -NO_PLANE;
}

fn measure_gradient_once(ray: Ray, sample: Sample, known: Attributes) -> Attributes {
    // An iso-surface and a cut lie between planes.
    if (sample.offset != 0.0) {
        return measure_gradient(ray, sample, known);
    }
    if (measured_plane != sample.k) {
        measured_plane = sample.k;
        measured_before = measure_gradient(ray, sample, known);
    }
    var a = known;
    a.gradient = measured_before.gradient;
    a.has_normal = measured_before.has_normal;
    a.normal = measured_before.normal;
    return a;
}
