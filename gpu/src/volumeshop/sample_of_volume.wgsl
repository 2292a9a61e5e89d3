// Samples of a part that is a piece of the picture's volume, at its place.

fn look_up_part(k: i32) -> bool {
    part_sample.k = k;
    part_sample.position = position(part_ray, k);
    part_sample.at = locate(part_sample.position);
    if (next_plane(part_ray, part_sample) > k || !look_here(k)) {
        return false;
    }
    part_sample.s = here.s;
    return true;
}
