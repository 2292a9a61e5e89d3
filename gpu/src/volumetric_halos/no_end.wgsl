// Rays that end with their samples.

fn end_plane() -> i32 {
    return NO_PLANE;
}
