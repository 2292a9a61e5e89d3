// The far side of a selection's oriented box ([VS-7]).

// The plane at which the ray leaves the box, counted from the anchor, with its fraction; NOT_MET if it misses it.
fn far_side() -> real {
    var near = real(-NOT_MET);
    var far = real(NOT_MET);
    let low = box_low();
    let high = box_high();
    for (var axis = 0; axis < 3; axis++) {
        let o = selection_ray.origin[axis];
        let d = selection_ray.along[axis] * selection_ray.depth_step;
        if (abs(d) < 1.0e-20) {
            if (o < low[axis] || o > high[axis]) {
                return -NOT_MET;
            }
            continue;
        }
        let a = (low[axis] - o) / d;
        let b = (high[axis] - o) / d;
        near = max(near, min(a, b));
        far = min(far, max(a, b));
    }
    return select(real(-NOT_MET), far, near <= far);
}
