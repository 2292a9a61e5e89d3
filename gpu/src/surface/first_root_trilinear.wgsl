// Roots in a cell of trilinear values, which are a cubic along the ray.
// Twin: reference/src/surface/first_root.rs

// The cubic of the cell that is searched.
var<private> cell_cubic: vec4<real>;

fn along_cell(u: real) -> real {
    return cubic_at(cell_cubic, u);
}

// The polar form of the cell: each axis takes its own coordinate. Corners lie at (y, z) = (0, 0), (1, 0), (0, 1), (1, 1).
fn polar(low: vec4<real>, high: vec4<real>, x: real, y: real, z: real) -> real {
    let a = mix_ends(low.x, high.x, x);
    let b = mix_ends(low.y, high.y, x);
    let c = mix_ends(low.z, high.z, x);
    let d = mix_ends(low.w, high.w, x);
    return mix_ends(mix_ends(a, b, y), mix_ends(c, d, y), z);
}

fn search_cell(walk: Traversal, before: real) -> CellSearch {
    let c = walk.cell;
    let low = vec4<real>(
        number_at(c), number_at(c + vec3(0, 1, 0)), number_at(c + vec3(0, 0, 1)), number_at(c + vec3(0, 1, 1)),
    ) - params.iso;
    let high = vec4<real>(
        number_at(c + vec3(1, 0, 0)),
        number_at(c + vec3(1, 1, 0)),
        number_at(c + vec3(1, 0, 1)),
        number_at(c + vec3(1, 1, 1)),
    ) - params.iso;
    // Corners on one side of the value exclude a root.
    let least = min(min(min(low.x, low.y), min(low.z, low.w)), min(min(high.x, high.y), min(high.z, high.w)));
    let most = max(max(max(low.x, low.y), max(low.z, low.w)), max(max(high.x, high.y), max(high.z, high.w)));
    if (least > 0.0 && before >= 0.0) {
        return CellSearch(false, 0.0, 1.0);
    }
    if (most < 0.0 && before <= 0.0) {
        return CellSearch(false, 0.0, -1.0);
    }
    let p = weights_at(walk, walk.enters, 0.0);
    let q = weights_at(walk, walk.leaves, 1.0);
    let one = polar(low, high, q.x, p.y, p.z) + polar(low, high, p.x, q.y, p.z) + polar(low, high, p.x, p.y, q.z);
    let two = polar(low, high, p.x, q.y, q.z) + polar(low, high, q.x, p.y, q.z) + polar(low, high, q.x, q.y, p.z);
    cell_cubic = vec4<real>(polar(low, high, p.x, p.y, p.z), one / 3.0, two / 3.0, polar(low, high, q.x, q.y, q.z));
    if (before * side_of(cell_cubic.x) < 0.0) {
        return CellSearch(true, walk.enters.t, 0.0);
    }
    let u = first_root_of(cell_cubic);
    if (u <= 1.0) {
        return CellSearch(true, walk.enters.t + u * (walk.leaves.t - walk.enters.t), 0.0);
    }
    return CellSearch(false, 0.0, side_of(cell_cubic.w));
}
