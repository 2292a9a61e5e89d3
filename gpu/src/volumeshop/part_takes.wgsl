// The share that a selection takes from the picture's volume (eq. 1; [VS-3]): f_S at sample k, 0 out of its box.
// Glue: A part asks its selection.

fn part_takes(k: i32) -> real {
    if (!is_in_selection(k) || (BY_VALUE && !look_here(k))) {
        return 0.0;
    }
    return membership_at(own_steps(k), here.s);
}
