// The iso-surface, at which a ray ends ([HATCH-14]).

// The plane at which the ray meets the surface, counted from the anchor, with its fraction; NO_HIT if it does not.
var<private> hit: real;

// The last sample before the surface.
fn last_before_surface() -> i32 {
    return i32(ceil(hit)) - 1;
}

// A sample counts if its plane lies before the surface.
fn end_at_surface(ray: Ray, run: vec2<i32>) -> vec2<i32> {
    if (SURFACE_ALONE) {
        return vec2(1, 0);
    }
    return vec2(run.x, min(run.y, last_before_surface()));
}

// The last sample stands for all the way up to the surface, from half a step to one and a half.
fn share_before_surface(k: i32, steps: real) -> real {
    if (hit < NO_HIT && k == last_before_surface()) {
        return hit + 0.5 - real(k);
    }
    return steps;
}

// Composites the surface, of opacity 1, at its own depth.
fn meet_surface(ray: Ray, seen: Front) -> Front {
    if (hit >= NO_HIT || seen.opacity >= params.stop_at) {
        return seen;
    }
    var sample: Sample;
    sample.k = last_before_surface();
    sample.offset = hit - real(sample.k);
    sample.position = min(max(ray.origin + ray.along * (hit * ray.depth_step), box_low()), box_high());
    sample.at = locate(sample.position);
    sample.s = params.iso;
    let attributes = measured_rest(ray, sample, measured_first(ray, sample));
    let shaded = on_surface(ray, sample, attributes, Shaded(surface_rgb(), 1.0));
    collect(ray, sample, attributes, 1.0);
    let w = 1.0 - seen.opacity;
    return Front(seen.rgb + w * in_blend_space(shaded.rgb), 1.0);
}
