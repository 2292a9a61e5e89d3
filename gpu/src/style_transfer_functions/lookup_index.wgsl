// The index function ift ([STF-3]): from nodes to distinct styles.
// Twin: reference/src/style_transfer_functions/lookup.rs

@group(1) @binding(3) var<storage, read> styles_of_nodes: array<u32>;

fn style_of(node: i32) -> i32 {
    return i32(styles_of_nodes[node]);
}
