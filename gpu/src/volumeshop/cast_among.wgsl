// A ray among objects: runs of samples of the background alone as if there were no objects, the others one by one.
// Glue: The loop over the samples of a ray.

fn cast_ray(ray: Ray) -> Front {
    var front = Front();
    let ratio = ray.step / params.reference_length;
    aim_background(ray);
    // Samples that are looked up for the ends of cutaways are not counted: a ray begins with its own.
    end_cutaways();
    begin_ray(ray);
    own_run = samples_left(ray, own_box);
    let all = all_left(ray, run_of_parts(own_run));
    var k = all.x;
    while (k <= all.y && front.opacity < params.stop_at) {
        let span = span_from(k, all.y);
        if (!span.is_mixed) {
            front = cast_samples(ray, vec2(max(k, own_run.x), min(span.end, own_run.y)), front);
            k = span.end + 1;
            continue;
        }
        while (k <= span.end && front.opacity < params.stop_at) {
            let found = together(k);
            if (found.shaded.alpha > 0.0) {
                front = composite(front, ray, found.sample, found.a, found.shaded, ratio);
            }
            k++;
        }
    }
    is_unfinished = is_unfinished || (front.opacity < params.stop_at && k <= all.y);
    return ended(ray, front);
}
