// Boxes about triangles, and the rays that meet them ([VS-12]).
// Twin: reference/src/mesh/tree.rs

// The inverse of a ray's displacement; 0 along an axis that it runs across.
fn inverse_of(along: vec3<real>) -> vec3<real> {
    var inverse = vec3<real>();
    for (var axis = 0; axis < 3; axis++) {
        if (abs(along[axis]) > 1.0e-20) {
            inverse[axis] = 1.0 / along[axis];
        }
    }
    return inverse;
}

// Whether a ray is in a box somewhere in start..=end. A box that it passes closely counts as met.
fn meets_box(
    origin: vec3<real>, inverse: vec3<real>, low: vec3<real>, high: vec3<real>, start: real, end: real,
) -> bool {
    var enter = start;
    var leave = end;
    for (var axis = 0; axis < 3; axis++) {
        let o = origin[axis];
        let margin = params.mesh_slack * (abs(o) + max(abs(low[axis]), abs(high[axis])));
        let below = low[axis] - margin - o;
        let above = high[axis] + margin - o;
        if (inverse[axis] == 0.0) {
            if (below > 0.0 || above < 0.0) {
                return false;
            }
            continue;
        }
        let a = below * inverse[axis];
        let b = above * inverse[axis];
        enter = max(enter, min(a, b));
        leave = min(leave, max(a, b));
    }
    return enter - params.mesh_slack * abs(enter) <= leave + params.mesh_slack * abs(leave);
}
