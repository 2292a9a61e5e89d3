// Colours of nodes ([VAL-3]).
// Glue: A buffer.

struct NodeColor {
    r: real,
    g: real,
    b: real,
}

@group(1) @binding(3) var<storage, read> colors: array<NodeColor>;

fn color_of(node: i32) -> vec3<real> {
    return vec3<real>(colors[node].r, colors[node].g, colors[node].b);
}

// The colour between nodes, linear and straight.
fn color_at(place: NodePlace) -> vec3<real> {
    if (place.w == 0.0) {
        return color_of(place.node);
    }
    return lerp3(color_of(place.node), color_of(place.node + 1), place.w);
}
