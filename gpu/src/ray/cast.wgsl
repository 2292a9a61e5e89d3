// The samples of a ray, front to back ([VAL-3], [VAL-4], [RAY-2]).
// Glue: The loop over the samples of a ray.

// The first channel of a pixel of which a driver ended a ray.
const UNFINISHED = -2.0e30;

// Whether a loop over samples ended before its last one: software drivers end shaders that loop too often, without a word.
var<private> is_unfinished: bool;

// Sample k where it is evaluated, without its value.
fn sample_on(ray: Ray, k: i32) -> Sample {
    var sample: Sample;
    let steps = steps_to(k);
    sample.k = k;
    sample.offset = steps - real(k);
    sample.position = place_on(ray, steps);
    sample.at = locate(sample.position);
    return sample;
}

// Lays the samples of a run behind what is there.
fn cast_samples(ray: Ray, run: vec2<i32>, seen: Front) -> Front {
    var front = seen;
    let ratio = ray.step / params.reference_length;
    var k = run.x;
    var is_closed = false;
    for (; k <= run.y; k++) {
        var sample = sample_on(ray, k);
        let next = next_plane(ray, sample);
        if (next > k) {
            // What lies before that plane shows nothing.
            k = next - 1;
            continue;
        }
        visited(sample);
        sample.s = value_at(sample.at);
        sample.place = node_place(locate_value(sample.s));
        if (!(sample.place.alpha_u > 0.0)) {
            continue;
        }
        let first = measured_first(ray, sample);
        if (!is_seen(ray, sample, first)) {
            continue;
        }
        let attributes = measured_rest(ray, sample, first);
        front = composite(front, ray, sample, attributes, shown(ray, sample, attributes), ratio);
        if (front.opacity >= params.stop_at) {
            is_closed = true;
            break;
        }
    }
    is_unfinished = is_unfinished || (!is_closed && k <= run.y);
    return front;
}
