// A transfer function over two quantities ([STF-4]; 4.2): rows of nodes along a first quantity, stacked along a second one.
// Twin: reference/src/transfer/plane.rs

// A sample's coordinate along an axis: a number, or the id of a label.
struct Coordinate {
    number: real,
    id: u32,
}

fn coordinate(number: real) -> Coordinate {
    return Coordinate(number, 0u);
}

// The places in two rows, which are the same where one row holds alone; w, the share of the second row; alpha_u.
// Nodes are counted through all rows.
struct NodePatch {
    below: NodePlace,
    above: NodePlace,
    w: real,
    alpha_u: real,
}

// The patch of the sample that is visited.
var<private> node_patch: NodePatch;

// Numbers: places of nodes, opacities of nodes, places of rows. Words: the first node of each row and the end of the
// last one, ids of nodes, ids of rows.
@group(1) @binding(13) var<storage, read> plane_numbers: array<real>;
@group(1) @binding(14) var<storage, read> plane_words: array<u32>;

// A stop k, counted from the first one, and the fraction w on the way to the next one. An id has its own stop or none.
struct Stop {
    k: i32,
    w: real,
    is_there: bool,
}

// The last stop at or below a number, of those from `first` up to `end`, or the first one. If w rounds to 1, the next stop.
fn find_number(x: real, first: i32, end: i32) -> Stop {
    var low = first;
    var high = end;
    while (low < high) {
        let middle = (low + high) / 2;
        if (plane_numbers[middle] <= x) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    if (low == first || low == end) {
        return Stop(max(low - first, 1) - 1, 0.0, true);
    }
    let a = plane_numbers[low - 1];
    let w = (x - a) / (plane_numbers[low] - a);
    if (w < 1.0) {
        return Stop(low - 1 - first, w, true);
    }
    return Stop(low - first, 0.0, true);
}

fn find_id(id: u32, first: i32, end: i32) -> Stop {
    var low = first;
    var high = end;
    while (low < high) {
        let middle = (low + high) / 2;
        if (plane_words[middle] < id) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return Stop(low - first, 0.0, low < end && plane_words[min(low, end - 1)] == id);
}

struct RowPlace {
    place: NodePlace,
    is_there: bool,
}

// The place of a coordinate in a row.
fn place_in_row(row: i32, x: Coordinate) -> RowPlace {
    let first = i32(plane_words[row]);
    let end = i32(plane_words[row + 1]);
    var stop: Stop;
    if (ACROSS_IS_ID) {
        stop = find_id(x.id, PLANE_ROWS + 1 + first, PLANE_ROWS + 1 + end);
    } else {
        stop = find_number(x.number, first, end);
    }
    if (!stop.is_there) {
        return RowPlace();
    }
    let node = first + stop.k;
    var alpha_u = plane_numbers[PLANE_NODES + node];
    if (stop.w != 0.0) {
        alpha_u = lerp(alpha_u, plane_numbers[PLANE_NODES + node + 1], stop.w);
    }
    return RowPlace(NodePlace(node, stop.w, alpha_u), true);
}

fn patch_alone(place: NodePlace, share: real) -> NodePatch {
    return NodePatch(place, place, 0.0, share * place.alpha_u);
}

// The place of two coordinates; alpha_u = 0 where nothing is there. A row without a node at a label has opacity 0 and
// does not affect the colour.
fn locate_patch(x: Coordinate, y: Coordinate) -> NodePatch {
    var row: Stop;
    if (DOWN_IS_ID) {
        let ids = PLANE_ROWS + 1 + select(0, PLANE_NODES, ACROSS_IS_ID);
        row = find_id(y.id, ids, ids + PLANE_ROWS);
    } else {
        row = find_number(y.number, 2 * PLANE_NODES, 2 * PLANE_NODES + PLANE_ROWS);
    }
    if (!row.is_there) {
        return NodePatch();
    }
    let below = place_in_row(row.k, x);
    var above: RowPlace;
    if (row.w != 0.0) {
        above = place_in_row(row.k + 1, x);
    }
    if (below.is_there && above.is_there) {
        let alpha_u = lerp(below.place.alpha_u, above.place.alpha_u, row.w);
        return NodePatch(below.place, above.place, row.w, alpha_u);
    }
    if (below.is_there) {
        return patch_alone(below.place, 1.0 - row.w);
    }
    if (above.is_there) {
        return patch_alone(above.place, row.w);
    }
    return NodePatch();
}

// Whether a sample with the two quantities known can be seen.
fn is_in_plane(ray: Ray, sample: Sample, a: Attributes) -> bool {
    node_patch = locate_patch(across(ray, sample, a), down(ray, sample, a));
    return node_patch.alpha_u > 0.0;
}
