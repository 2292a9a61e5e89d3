// A ray among objects: runs of samples of the background alone as if there were no objects, the others one by one.

// From sample k on: the last sample up to which the same parts can show something, and whether there are any.
struct Span {
    end: i32,
    is_mixed: bool,
}

// A span that ends where a range of samples begins or ends.
fn span_within(span: Span, k: i32, range: vec2<i32>) -> Span {
    if (range.x <= k && k <= range.y) {
        return Span(min(span.end, range.y), true);
    }
    if (k < range.x && range.x <= range.y) {
        return Span(min(span.end, range.x - 1), span.is_mixed);
    }
    return span;
}

// The samples from the first to the last of two ranges.
fn hull(a: vec2<i32>, b: vec2<i32>) -> vec2<i32> {
    if (b.x > b.y) {
        return a;
    }
    if (a.x > a.y) {
        return b;
    }
    return vec2(min(a.x, b.x), max(a.y, b.y));
}

fn cast_ray(ray: Ray) -> Front {
    var front = Front();
    let ratio = ray.step / params.reference_length;
    begin_ray(ray);
    aim_background(ray);
    end_cutaways();
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
