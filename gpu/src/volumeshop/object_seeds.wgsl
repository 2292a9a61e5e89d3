// The seeds of a part's set, by its own samples ([VS-2]).
// Twin: reference/src/ray/composite/object_seeds.rs

// Looks up sample k, which lies in the range: it can seed where it shows nothing.
fn look_to_sow(k: i32) -> bool {
    if (part_k == k && part_can_show) {
        return true;
    }
    part_k = NO_SAMPLE;
    place_part(k);
    return next_number(part_ray, part_sample) <= k && take_value(k);
}

// The seeds at sample k with the membership of its selection set.
fn sow_part(k: i32, weight: real) {
    if (!(weight > 0.0) || !is_in_part(k) || !look_to_sow(k)) {
        return;
    }
    part_sample.place = node_place(locate_value(part_sample.s));
    sow(part_ray, part_sample, 0);
    join_seeds(weight, 1.0);
}

// The seeds at sample k of a part that takes nothing from the background.
fn sow_beside(k: i32) {
    if (!is_in_part(k) || (BY_VALUE && !look_to_sow(k))) {
        return;
    }
    sow_part(k, membership_at(steps_to(k), part_sample.s));
}
