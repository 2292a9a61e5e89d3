// A ray through the volume alone.
// Glue: The loop over the samples of a ray.

fn cast_ray(ray: Ray) -> Front {
    begin_ray(ray);
    return ended(ray, cast_samples(ray, samples_left(ray, samples_inside(ray)), Front()));
}
