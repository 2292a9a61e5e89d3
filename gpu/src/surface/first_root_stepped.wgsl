// Roots in a cell of other kernels: values every quarter of a voxel, and a change of sign narrowed down.
// Twin: reference/src/surface/first_root.rs

// The cell that is searched.
var<private> cell_walk: Traversal;

// The value less that of the surface, at coordinates within the cell.
fn over_at(w: vec3<real>) -> real {
    return value_at(Place(cell_walk.cell, w)) - params.iso;
}

fn along_cell(t: real) -> real {
    return over_at(weights_at(cell_walk, Crossing(t, -1), 0.0));
}

fn search_cell(walk: Traversal, before: real) -> CellSearch {
    cell_walk = walk;
    let enters = walk.enters.t;
    let leaves = walk.leaves.t;
    let steps = max(ceil(sqrt(dot(walk.along, walk.along)) * (leaves - enters) * 4.0), 1.0);
    var start = enters;
    var at_start = over_at(weights_at(walk, walk.enters, 0.0));
    if (at_start == 0.0 || before * side_of(at_start) < 0.0) {
        return CellSearch(true, enters, 0.0);
    }
    for (var i = 1; i <= i32(steps); i++) {
        var end = leaves;
        var w = weights_at(walk, walk.leaves, 1.0);
        if (i < i32(steps)) {
            end = enters + (leaves - enters) * (real(i) / steps);
            w = weights_at(walk, Crossing(end, -1), 0.0);
        }
        let at_end = over_at(w);
        if (at_end == 0.0) {
            return CellSearch(true, end, 0.0);
        }
        if ((at_end > 0.0) != (at_start > 0.0)) {
            return CellSearch(true, bracketed(start, at_start, end, at_end), 0.0);
        }
        start = end;
        at_start = at_end;
    }
    return CellSearch(false, 0.0, side_of(at_start));
}
