// The rays of a picture, and the samples on them ([RAY-1]).
// Twin: reference/src/ray/lattice.rs

// The ray through a point of the picture, in pixels from the middle of the picture, to the right and up.
fn ray_through(x: real, y: real) -> Ray {
    var ray: Ray;
    let off = pixel_right() * x + pixel_up() * y;
    ray.v_eye = vec3<real>(0.0, 0.0, 1.0);
    ray.along = index_forward();
    ray.depth_step = params.step;
    ray.step = params.step;
    if (PERSPECTIVE) {
        let e = vec3<real>(-x * params.pixel, -y * params.pixel, 1.0);
        let cosine = 1.0 / sqrt(dot(e, e));
        ray.v_eye = e * cosine;
        ray.along = index_forward() + off;
        if (BY_RAY) {
            ray.depth_step = params.step * cosine;
            ray.origin = index_eye() + ray.along * (params.anchor_steps * ray.depth_step);
        } else {
            ray.step = params.step / cosine;
            ray.origin = anchor_middle() + off * (params.anchor_steps * params.step);
        }
    } else {
        ray.origin = anchor_middle() + off;
    }
    ray.v = view_right() * ray.v_eye.x + view_up() * ray.v_eye.y - view_forward() * ray.v_eye.z;
    return ray;
}

// The index position so many steps from the anchor.
fn place_on(ray: Ray, steps: real) -> vec3<real> {
    return ray.origin + ray.along * (steps * ray.depth_step);
}

// The index position of sample k, counted from the anchor.
fn position(ray: Ray, k: i32) -> vec3<real> {
    return place_on(ray, real(k));
}

// The eye depth of sample k, counted from the anchor.
fn depth_of(ray: Ray, k: i32) -> real {
    return (real(k) + params.anchor_steps) * ray.depth_step;
}

// Whether sample k may be asked for: beyond `near` and inside the box.
fn has_sample(ray: Ray, k: i32) -> bool {
    return k >= i32(params.first_plane) && in_box(position(ray, k));
}

// The planes at which a ray comes into a box and leaves it, counted from the anchor, with their fractions; the first is the
// larger one if it misses the box.
fn through_box(ray: Ray, low: vec3<real>, high: vec3<real>) -> vec2<real> {
    var near = real(-4.0e6);
    var far = real(4.0e6);
    for (var axis = 0; axis < 3; axis++) {
        let o = ray.origin[axis];
        let d = ray.along[axis] * ray.depth_step;
        if (abs(d) < 1.0e-20) {
            if (o < low[axis] || o > high[axis]) {
                return vec2<real>(4.0e6, -4.0e6);
            }
            continue;
        }
        let a = (low[axis] - o) / d;
        let b = (high[axis] - o) / d;
        near = max(near, min(a, b));
        far = min(far, max(a, b));
    }
    return vec2<real>(near, far);
}

// The samples inside the box, as the closed range x..=y; none where x > y. Inside is decided on the position itself.
fn samples_inside(ray: Ray) -> vec2<i32> {
    let through = through_box(ray, box_low(), box_high());
    if (!(through.x <= through.y + 2.0)) {
        return vec2(1, 0);
    }
    var first = max(i32(floor(through.x)) - 1, i32(params.first_plane));
    var last = i32(ceil(through.y)) + 1;
    while (first <= last && !in_box(position(ray, first))) {
        first++;
    }
    while (last >= first && !in_box(position(ray, last))) {
        last--;
    }
    return vec2(first, last);
}
