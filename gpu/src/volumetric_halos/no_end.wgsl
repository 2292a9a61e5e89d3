// Rays that end with their samples.
// Glue: A choice of surfaces.

fn end_plane() -> i32 {
    return NO_PLANE;
}
