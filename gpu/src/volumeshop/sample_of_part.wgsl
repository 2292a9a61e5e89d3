// Samples of a part in a place or of data of its own.

fn look_up_part(k: i32) -> bool {
    part_sample.k = k;
    part_sample.position = position(part_ray, k);
    part_sample.at = locate(part_sample.position);
    if (next_plane(part_ray, part_sample) > k) {
        return false;
    }
    note_sample(part_sample);
    part_sample.s = value_at(part_sample.at);
    return true;
}
