// Coverage of objects in a pixel ([IO-6], [VS-3]).
// Twin: reference/src/ray/composite/layers.rs

// Sums of w times the fraction of each object, along a ray and over the rays of a pixel.
var<private> ray_coverage: array<real, COVERING>;
var<private> pixel_coverage: array<real, COVERING>;
var<private> rays_of_pixel: real;

fn begin_coverage(ray: Ray) {
    ray_coverage = array<real, COVERING>();
}

// Takes in a sample before `collect_layers` adds it to A. An iso-surface, which lies behind its
// plane, is the background's.
fn collect_coverage(ray: Ray, sample: Sample, a: Attributes, alpha: real) {
    let w = (1.0 - ray_sums.opacity) * alpha * left_by_lines();
    for (var object = 0; object < COVERING; object++) {
        var fraction = select(real(0.0), real(1.0), object == 0);
        if (sample.offset <= 0.0) {
            fraction = fraction_of_object(object, sample.k);
        }
        ray_coverage[object] += w * fraction;
    }
}

fn pool_coverage(part: i32) {
    if (part == 0) {
        pixel_coverage = array<real, COVERING>();
        rays_of_pixel = 0.0;
    }
    rays_of_pixel += 1.0;
    for (var object = 0; object < COVERING; object++) {
        pixel_coverage[object] += ray_coverage[object];
    }
}
