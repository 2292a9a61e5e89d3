// Samples of a part that is a piece of the picture's volume, at its place.

// Looks up the value of sample k.
fn take_value(k: i32) -> bool {
    if (!look_here(k)) {
        return false;
    }
    part_sample.s = here.s;
    return true;
}
