// The cells on a ray, from face to face. The ray's parameter t counts sample planes from the anchor.
// Twin: reference/src/surface/traversal.rs

// A place on the ray, and the axis of the face that lies there; -1 if none does.
struct Crossing {
    t: real,
    axis: i32,
}

// The crossing at which a ray leaves a block of cells, and the next cell along the axis; -1 outside the box.
struct BlockExit {
    crossing: Crossing,
    behind: i32,
}

// The ray crosses face i of an axis at t = (i - origin)/along, computed anew for each face, in the order of (t, axis).
struct Traversal {
    origin: vec3<real>,
    // Index displacement from plane to plane; 0 along an axis that the ray runs across.
    along: vec3<real>,
    cell: vec3<i32>,
    enters: Crossing,
    leaves: Crossing,
}

// The t at which the ray crosses a face of an axis.
fn crosses(walk: Traversal, axis: i32, face: real) -> real {
    return (face - walk.origin[axis]) / walk.along[axis];
}

// Whether a face lies before a crossing, in the order of faces.
fn is_crossed(walk: Traversal, axis: i32, face: i32, enters: Crossing) -> bool {
    let t = crosses(walk, axis, real(face));
    return t < enters.t || (t == enters.t && (enters.axis < 0 || axis < enters.axis));
}

// The exit from the aligned block of cells with this side.
fn leaves_block(walk: Traversal, side: i32) -> BlockExit {
    let last = vec3<i32>(last_cell());
    let low = box_low();
    let high = box_high();
    var first = BlockExit(Crossing(8.0e6, -1), -1);
    for (var a = 0; a < 3; a++) {
        if (walk.along[a] == 0.0) {
            continue;
        }
        let block = walk.cell[a] / side * side;
        var behind = -1;
        var face = low[a];
        if (walk.along[a] > 0.0) {
            face = high[a];
            if (block + side <= last[a]) {
                behind = block + side;
                face = real(behind);
            }
        } else if (block > 0) {
            behind = block - 1;
            face = real(block);
        }
        let t = crosses(walk, a, face);
        if (t < first.crossing.t) {
            first = BlockExit(Crossing(t, a), behind);
        }
    }
    return first;
}

// Moves to the crossing of a face, in the cell behind it. The cell along the face's own axis is set before.
fn seek(before: Traversal, enters: Crossing) -> Traversal {
    var walk = before;
    let ends = vec3<i32>(last_cell());
    for (var a = 0; a < 3; a++) {
        if (a == enters.axis) {
            continue;
        }
        let last = ends[a];
        var cell = min(i32(max(walk.origin[a] + walk.along[a] * enters.t, 0.0)), last);
        if (walk.along[a] > 0.0) {
            while (cell < last && is_crossed(walk, a, cell + 1, enters)) {
                cell++;
            }
            while (cell > 0 && !is_crossed(walk, a, cell, enters)) {
                cell--;
            }
        } else if (walk.along[a] < 0.0) {
            while (cell > 0 && is_crossed(walk, a, cell, enters)) {
                cell--;
            }
            while (cell < last && !is_crossed(walk, a, cell + 1, enters)) {
                cell++;
            }
        }
        walk.cell[a] = cell;
    }
    walk.enters = enters;
    walk.leaves = leaves_block(walk, 1).crossing;
    return walk;
}

// The first cell of a ray from t = near on. Beyond the box enters.t is NO_HIT.
fn enter_box(ray: Ray, near: real) -> Traversal {
    var walk: Traversal;
    walk.origin = ray.origin;
    walk.along = ray.along * ray.depth_step;
    let low = box_low();
    let high = box_high();
    let last = vec3<i32>(last_cell());
    var enters = Crossing(-8.0e6, -1);
    var leaves = real(8.0e6);
    for (var a = 0; a < 3; a++) {
        if (abs(walk.along[a]) < 1.0e-20) {
            walk.along[a] = 0.0;
            if (!(walk.origin[a] >= low[a] && walk.origin[a] <= high[a])) {
                leaves = -8.0e6;
            }
            continue;
        }
        let rises = walk.along[a] > 0.0;
        let t = crosses(walk, a, select(high[a], low[a], rises));
        if (t >= enters.t) {
            enters = Crossing(t, a);
        }
        leaves = min(leaves, crosses(walk, a, select(low[a], high[a], rises)));
    }
    if (near > enters.t || enters.axis < 0) {
        enters = Crossing(near, -1);
    }
    if (!(enters.t <= leaves)) {
        walk.enters = Crossing(NO_HIT, -1);
        return walk;
    }
    if (enters.axis >= 0) {
        walk.cell[enters.axis] = select(last[enters.axis], 0, walk.along[enters.axis] > 0.0);
    }
    return seek(walk, enters);
}

// Coordinates within the cell at t. On the axis of a crossed face they are exactly those of the face: `face` for a ray that
// runs upwards, else 1 - face.
fn weights_at(walk: Traversal, at: Crossing, face: real) -> vec3<real> {
    let long = long_axes();
    var w = vec3<real>();
    for (var a = 0; a < 3; a++) {
        if (long[a] == 0.0) {
            continue;
        }
        if (at.axis == a) {
            w[a] = select(1.0 - face, face, walk.along[a] > 0.0);
        } else {
            w[a] = clamp_01(walk.origin[a] + walk.along[a] * at.t - real(walk.cell[a]));
        }
    }
    return w;
}
