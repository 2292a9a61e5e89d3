// The background among objects: the picture's volume less what is selected of it (eqs. 1 to 3; [VS-2], [VS-7]).
// Twin: reference/src/ray/composite/object_ray.rs

const NO_SAMPLE = -0x7fffffff;

// Planes from the anchor that stand for none.
const NOT_MET = 4.0e6;

var<private> own_ray: Ray;
// The samples in the volume's box, and those that clip planes and surfaces leave.
var<private> own_box: vec2<i32>;
var<private> own_run: vec2<i32>;
// The sample of the volume that was looked up last, its plane and whether there is one.
var<private> here: Sample;
var<private> here_k: i32;
var<private> is_here: bool;

fn aim_objects(pixel: vec2<i32>, part: i32, across: i32) {
    aim_parts(point_of(pixel, part, across));
}

fn aim_background(ray: Ray) {
    own_ray = ray;
    own_box = samples_inside(ray);
    here_k = NO_SAMPLE;
}

// The place at which the background's sample k is evaluated, in steps from the anchor.
fn own_steps(k: i32) -> real {
    return steps_to(k);
}

// Looks up the volume's sample k once; none outside the box and in masked cells.
fn look_here(k: i32) -> bool {
    if (here_k == k) {
        return is_here;
    }
    here_k = k;
    is_here = own_box.x <= k && k <= own_box.y;
    if (is_here) {
        here = sample_on(own_ray, k);
        is_here = next_number(own_ray, here) == k;
    }
    if (is_here) {
        note_sample(here);
        here.s = value_at(here.at);
    }
    return is_here;
}

// The set of the background at sample k, whose selection set has this membership.
fn background_set(k: i32, weight: real) -> Found {
    if (!(weight > 0.0) || k < own_run.x || k > own_run.y || is_ghosted_away(k)) {
        return Found();
    }
    if (next_plane(own_ray, sample_on(own_ray, k)) > k || !look_here(k)) {
        return Found();
    }
    here.place = node_place(locate_value(here.s));
    if (!(here.place.alpha_u > 0.0)) {
        return Found();
    }
    let first = measured_first(own_ray, here);
    if (!is_seen(own_ray, here, first)) {
        return Found();
    }
    let a = measured_rest(own_ray, here, first);
    let shaded = shown(own_ray, here, a);
    let faded = ghosted(k, a);
    return Found(a, shaded.rgb, weight, both(weight, shaded.alpha * faded), faded);
}

fn unlit_background(a: Attributes) -> Shaded {
    return unlit(own_ray, here, a);
}

fn light_background(a: Attributes, plain: Shaded) -> Shaded {
    return lit(own_ray, here, a, plain);
}
