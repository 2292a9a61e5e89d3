// The inside of an iso-surface that planes cut open ([RAY-8]).
// Twin: reference/src/surface/clipped.rs

// Whether a place is inside the surface, or on it. A place outside the box is not, nor is one in a masked cell.
fn is_inside_surface(p: vec3<real>) -> bool {
    if (!in_box(p)) {
        return false;
    }
    let at = locate(p);
    let over = value_at(at) - params.iso;
    return can_be_inside(at.cell) && select(over <= 0.0, over >= 0.0, OUTSIDE_IS_LOW);
}
