// Samples of a part that is a piece of the picture's volume, at its place.
// Twin: reference/src/ray/composite/part_ray.rs

// Looks up the value of sample k.
fn take_value(k: i32) -> bool {
    if (!look_here(k)) {
        return false;
    }
    part_sample.s = here.s;
    return true;
}
