// The gradient in the world, and the normal ([NORM-1], [PREC-3]).
// Twin: reference/src/field/normal.rs

// The world gradient, times a power of two.
fn world_gradient(g: vec3<real>) -> vec3<real> {
    return to_world_x() * g.x + to_world_y() * g.y + to_world_z() * g.z;
}

// The gradient at a place, in world space.
fn gradient_at(at: Place) -> vec3<real> {
    return world_gradient(index_gradient(at));
}

// Whether a gradient has a normal: it is more than rounding.
fn has_normal(g: vec3<real>) -> bool {
    return length_of(g) > params.no_normal_below;
}

fn length_of(g: vec3<real>) -> real {
    return sqrt(dot(g, g));
}

// The normal that shades, seen from v: the outward one, turned as the scene says, of a gradient that has one.
fn normal_of(volume_gradient: vec3<real>, v: vec3<real>) -> vec3<real> {
    let g = moved_gradient(volume_gradient);
    let outward = g * (params.outwards / length_of(g));
    if (params.facing > 0.0 && dot(outward, v) < 0.0) {
        return -outward;
    }
    return outward;
}
