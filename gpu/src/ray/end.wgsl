// The opaque surface at which a ray ends: an iso-surface ([HATCH-14]) or a mesh ([VS-12]).
// Glue: The end of a ray.

// The plane at which the ray meets the surface, counted from the anchor, with its fraction; NO_HIT if it does not.
var<private> hit: real;

fn forget_surface(ray: Ray) {
    hit = NO_HIT;
}

// The last sample before the surface.
fn last_before_surface() -> i32 {
    return i32(ceil(hit)) - 1;
}

// A sample counts if its plane lies before the surface.
fn end_at_surface(ray: Ray, run: vec2<i32>) -> vec2<i32> {
    return vec2(run.x, min(run.y, last_before_surface()));
}

// The last sample stands for all the way up to the surface, from half a step to one and a half.
fn share_before_surface(k: i32, steps: real) -> real {
    if (hit < NO_HIT && k == last_before_surface()) {
        return hit + 0.5 - real(k);
    }
    return steps;
}
