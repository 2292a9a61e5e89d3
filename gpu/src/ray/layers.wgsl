// Layers of a picture, from the samples of its rays ([IO-6]).
// Twin: reference/src/ray/composite/layers.rs

// A depth where nothing was met.
const NOWHERE = 3.0e38;

struct FirstSample {
    depth: real,
    value: real,
    normal: vec3<real>,
    curvature: vec3<real>,
}

// Sums along one ray: of w q over its samples, w = (1 - A) alpha.
struct Sums {
    // A of the samples alone.
    opacity: real,
    weight: real,
    is_met: bool,
    first: FirstSample,
    // The depth at which A first reaches a half.
    half: real,
    depth: real,
    normal: vec3<real>,
    gradient: vec3<real>,
    // Both principal curvatures and the scene's curvature.
    curvature: vec3<real>,
}

var<private> ray_sums: Sums;
// The sums of a pixel's first ray, to whose means those of the others are added.
var<private> pixel_sums: Sums;

fn begin_sums(ray: Ray) {
    ray_sums = Sums();
    ray_sums.half = NOWHERE;
    ray_sums.first.depth = NOWHERE;
    ray_sums.first.value = NOWHERE;
}

fn collect_layers(ray: Ray, sample: Sample, a: Attributes, alpha: real) {
    if (!(alpha > 0.0)) {
        return;
    }
    let w = (1.0 - ray_sums.opacity) * alpha;
    ray_sums.opacity = select(real(1.0), ray_sums.opacity + w, alpha < 1.0);
    let depth = depth_of(ray, sample.k) + sample.offset * ray.depth_step;
    let normal = eye_normal(ray, a);
    let curvature = vec3<real>(a.principal.x, a.principal.y, a.kappa);
    if (!ray_sums.is_met) {
        ray_sums.is_met = true;
        ray_sums.first = FirstSample(depth, sample.s, normal, curvature);
    }
    if (ray_sums.half == NOWHERE && ray_sums.opacity >= 0.5) {
        ray_sums.half = depth;
    }
    ray_sums.weight += w;
    ray_sums.depth += w * depth;
    ray_sums.normal += w * normal;
    ray_sums.gradient += w * a.gradient;
    ray_sums.curvature += w * curvature;
}

fn pool_sums(part: i32) {
    if (part == 0) {
        pixel_sums = ray_sums;
        pixel_sums.depth = select(real(NOWHERE), ray_sums.depth / ray_sums.weight, ray_sums.weight > 0.0);
        return;
    }
    pixel_sums.weight += ray_sums.weight;
    pixel_sums.normal += ray_sums.normal;
    pixel_sums.gradient += ray_sums.gradient;
    pixel_sums.curvature += ray_sums.curvature;
}

// A mean over the samples of a pixel; 0 where there are none.
fn mean_of(sum: real) -> real {
    return select(real(0.0), sum / pixel_sums.weight, pixel_sums.weight > 0.0);
}
