// The last sample at which a part has members ([VS-7]).
// Twin: reference/src/ray/composite/part_ray.rs

// Its plane, counted from the anchor; NOT_MET if there is none.
fn last_member() -> real {
    var last = real(-NOT_MET);
    for (var k = part_range.y; k >= part_range.x; k--) {
        let found = part_set(k, part_membership(k));
        if (found.weight > 0.0 && found.mu > 0.0) {
            last = real(k);
            break;
        }
    }
    // A sample that is looked up for what it shows is looked up again.
    part_k = NO_SAMPLE;
    here_k = NO_SAMPLE;
    return last;
}
