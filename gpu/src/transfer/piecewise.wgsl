// A piecewise-linear opacity over values ([STF-3]).
// Twin: reference/src/transfer/piecewise.rs

struct Node {
    // The value where the segment to the next node begins, and the segment's width.
    at: real,
    width: real,
    opacity: real,
    next_opacity: real,
    // i of an entry, where the function is read from a table.
    index: real,
}

@group(1) @binding(2) var<storage, read> nodes: array<Node>;

// The place of a value between nodes: i = node + w.
struct NodePlace {
    node: i32,
    w: real,
    alpha_u: real,
}

// The place of a value. Beyond the nodes the end nodes hold, and of several nodes at one value the last.
fn locate_value(s: real) -> NodePlace {
    // The number of nodes at or below the value.
    var low = 0;
    var high = NODES;
    while (low < high) {
        let middle = (low + high) / 2;
        if (nodes[middle].at <= s) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    let k = max(low - 1, 0);
    if (low == 0 || low == NODES) {
        return NodePlace(k, 0.0, nodes[k].opacity);
    }
    let w = (s - nodes[k].at) / nodes[k].width;
    return NodePlace(k, w, lerp(nodes[k].opacity, nodes[k].next_opacity, w));
}
