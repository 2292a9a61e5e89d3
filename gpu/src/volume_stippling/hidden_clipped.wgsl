// A surface that planes cut: a cut through its inside hides, too ([RAY-8]).
// Twin: reference/src/volume_stippling/hidden.rs

// Whether a line meets what planes leave of the surface, at t = start to 0.
fn meets_surface(line: Ray, start: real) -> bool {
    let kept = kept_of(line, start, 0.0);
    if (kept.start > kept.end) {
        return false;
    }
    if (kept.entry >= 0 && is_inside_surface(line.origin + line.along * kept.start)) {
        return true;
    }
    return first_root(line, kept.start, kept.end) <= kept.end;
}

fn is_cut_away(p: vec3<real>) -> bool {
    return is_cut(p);
}
