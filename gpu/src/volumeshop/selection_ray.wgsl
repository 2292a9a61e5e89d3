// A selection on a ray: the samples at which there can be members ([VS-2]).
// Twin: reference/src/ray/composite/selection_ray.rs

var<private> selection_ray: Ray;
var<private> selection_range: vec2<i32>;

fn aim_selection(x: real, y: real) {
    selection_ray = ray_through(x, y);
    selection_range = samples_inside(selection_ray);
}

fn is_in_selection(k: i32) -> bool {
    return selection_range.x <= k && k <= selection_range.y;
}

// The plane at which the ray leaves the box of the selection, counted from the anchor, with its fraction; -NOT_MET if it misses it ([VS-7]).
fn far_side() -> real {
    let through = through_box(selection_ray, selected_low(), selected_high());
    return select(real(-NOT_MET), through.y, through.x <= through.y);
}
