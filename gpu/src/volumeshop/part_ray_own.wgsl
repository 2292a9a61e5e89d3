// Samples of a part in a place or of data of its own.
// Twin: reference/src/ray/composite/part_ray.rs

// Looks up the value of sample k, whose place is known and no masked cell.
fn take_value(k: i32) -> bool {
    note_sample(part_sample);
    part_sample.s = value_at(part_sample.at);
    return true;
}
