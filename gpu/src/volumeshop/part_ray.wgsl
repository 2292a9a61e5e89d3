// A part of an object on a ray: a selection or a ghost, and its set at a sample (eqs. 2, 3; [VS-2]).
// Twin: reference/src/ray/composite/part_ray.rs

var<private> part_ray: Ray;
// The samples at which it can show something.
var<private> part_range: vec2<i32>;
// The sample that was looked up last, its plane and whether it can show something.
var<private> part_sample: Sample;
var<private> part_k: i32;
var<private> part_can_show: bool;

fn aim_part(x: real, y: real) {
    aim_selection(x, y);
    part_ray = ray_through(x, y);
    part_k = NO_SAMPLE;
    begin_ray(part_ray);
    let left = samples_left(part_ray, samples_inside(part_ray));
    part_range = vec2(max(left.x, selection_range.x), min(left.y, selection_range.y));
}

fn is_in_part(k: i32) -> bool {
    return part_range.x <= k && k <= part_range.y;
}

fn place_part(k: i32) {
    part_sample = sample_on(part_ray, k);
}

// Looks up sample k once, which lies in the range.
fn look_at_part(k: i32) -> bool {
    if (part_k != k) {
        part_k = k;
        place_part(k);
        part_can_show = next_plane(part_ray, part_sample) <= k && take_value(k);
    }
    return part_can_show;
}

// f_S at sample k; 0 out of the range.
fn part_membership(k: i32) -> real {
    if (!is_in_part(k) || (BY_VALUE && !look_at_part(k))) {
        return 0.0;
    }
    return membership_at(steps_to(k), part_sample.s);
}

// The set at sample k with the membership of its selection set.
fn part_set(k: i32, weight: real) -> Found {
    if (!(weight > 0.0) || !is_in_part(k) || !look_at_part(k)) {
        return Found();
    }
    part_sample.place = node_place(locate_value(part_sample.s));
    if (!(part_sample.place.alpha_u > 0.0)) {
        return Found();
    }
    let first = measured_first(part_ray, part_sample);
    if (!is_seen(part_ray, part_sample, first)) {
        return Found();
    }
    let a = measured_rest(part_ray, part_sample, first);
    let shaded = shown(part_ray, part_sample, a);
    return Found(a, shaded.rgb, weight, both(weight, shaded.alpha), 1.0);
}

// The colour and the opacity of its sample before light falls on them, by the attributes of a set that it meets.
fn unlit_part(a: Attributes) -> Shaded {
    return unlit(part_ray, part_sample, a);
}

fn light_part(a: Attributes, plain: Shaded) -> Shaded {
    return lit(part_ray, part_sample, a, plain);
}

// Its sample in the numbers of the picture's volume, and its attributes as those of the moved field.
fn seen_part(found: Found, shaded: Shaded) -> Together {
    var sample = part_sample;
    sample.s = sample.s * params.value_factor + params.value_offset;
    var a = found.a;
    a.gradient = moved_gradient(a.gradient) * params.gradient_factor;
    return Together(shaded, sample, a);
}
