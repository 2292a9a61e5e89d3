// Counts of samples as a layer ([IO-6]).
// Twin: scene/src/counts.rs

// Samples of the ray whose value was evaluated, and those of the pixel's first ray.
var<private> samples_of_ray: i32;
var<private> samples_of_pixel: i32;

fn begin_count(ray: Ray) {
    samples_of_ray = 0;
}

fn count_sample(sample: Sample) {
    samples_of_ray++;
}

fn end_count(part: i32) {
    if (part == 0) {
        samples_of_pixel = samples_of_ray;
    }
}
