// The first place on a ray where the field has the value of an iso-surface ([HATCH-14]).
// Twin: reference/src/surface/first_root.rs

// The result of a search in one cell.
struct CellSearch {
    is_root: bool,
    t: real,
    // The side of the value, 1 or -1, where the ray leaves a cell without a root.
    side: real,
}

fn side_of(over: real) -> real {
    return select(real(-1.0), real(1.0), over > 0.0);
}

// The t of the first root from `near` to `end`; NO_HIT if there is none.
fn first_root(ray: Ray, near: real, end: real) -> real {
    var walk = enter_box(ray, near);
    if (walk.enters.t >= NO_HIT || walk.enters.t > end) {
        return NO_HIT;
    }
    // The side on which the ray left the cell before: a change of sign between two cells is a root on their face.
    var before = real(0.0);
    // A ray meets fewer cells than this, however faces round.
    let most = i32(last_cell().x + last_cell().y + last_cell().z) + 6;
    for (var met = 0; met < most; met++) {
        if (walk.leaves.t > end) {
            walk.leaves = Crossing(end, -1);
        }
        let passed = cells_passed(walk.cell);
        if (passed > 0) {
            before = 0.0;
        } else {
            let found = search_cell(walk, before);
            if (found.is_root) {
                return found.t;
            }
            before = found.side;
        }
        let exit = leaves_block(walk, max(passed, 1));
        if (exit.behind < 0 || exit.crossing.t > end) {
            break;
        }
        walk.cell[exit.crossing.axis] = exit.behind;
        walk = seek(walk, exit.crossing);
    }
    return NO_HIT;
}
