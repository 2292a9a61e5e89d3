// A surface that no plane cuts.
// Twin: reference/src/volume_stippling/hidden.rs

// Whether a line meets the surface at t = start to 0.
fn meets_surface(line: Ray, start: real) -> bool {
    return first_root(line, start, 0.0) <= 0.0;
}

fn is_cut_away(p: vec3<real>) -> bool {
    return false;
}
