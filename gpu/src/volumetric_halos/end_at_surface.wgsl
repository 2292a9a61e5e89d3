// The plane of an iso-surface ([HATCH-14]) or a mesh ([VS-12]): the first one behind it, whose tint it takes.
// Glue: A choice of surfaces.

fn end_plane() -> i32 {
    return select(last_before_surface() + 1, NO_PLANE, hit >= NO_HIT);
}
