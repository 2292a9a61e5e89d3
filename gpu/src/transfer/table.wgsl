// A function that is read from a table ([STF-3]).
// Twin: reference/src/transfer/table.rs

// From a place between entries to a place between nodes.
fn between_nodes(entry: NodePlace) -> NodePlace {
    var i = nodes[entry.node].index;
    if (entry.w > 0.0) {
        i = min(lerp(i, nodes[entry.node + 1].index, entry.w), params.last_node);
    }
    let node = floor(i);
    return NodePlace(i32(node), i - node, entry.alpha_u);
}
