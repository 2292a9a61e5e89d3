// Points that an opaque iso-surface hides ([STIP-15]). Lengths are in voxels.
// Twin: reference/src/volume_stippling/hidden.rs

struct SurfacePoint {
    // Index position.
    x: real,
    y: real,
    z: real,
    // The outward normal of the point's voxel, in the world.
    normal_x: real,
    normal_y: real,
    normal_z: real,
    // The farthest foot on the surface.
    reach: real,
}

// For each point 1 if it is seen, 2 if it is hidden.
@group(0) @binding(1) var<storage, read_write> results: array<u32>;
@group(0) @binding(2) var<storage, read> points: array<SurfacePoint>;

fn line_from(origin: vec3<real>, along: vec3<real>) -> Ray {
    var ray: Ray;
    ray.origin = origin;
    ray.along = along;
    ray.depth_step = 1.0;
    return ray;
}

// A place on a line, moved into the box where rounding leaves it.
fn place_on(line: Ray, t: real) -> vec3<real> {
    return min(max(line.origin + line.along * t, box_low()), box_high());
}

// The index displacement for one voxel along a unit vector of the world.
fn voxel_along(n: vec3<real>) -> vec3<real> {
    return voxel_x() * n.x + voxel_y() * n.y + voxel_z() * n.z;
}

// The surface's outward normal at a place; 0 where it has none.
fn surface_normal(p: vec3<real>) -> vec3<real> {
    let g = gradient_at(locate(p));
    if (!has_normal(g)) {
        return vec3<real>();
    }
    return normal_of(g, vec3<real>());
}

struct Foot {
    is_there: bool,
    at: vec3<real>,
}

// The nearest place of the surface on the line along a point's normal. One whose own normal points along comes first: the
// other belongs to the other side of a thin wall.
fn foot_of(p: vec3<real>, n: vec3<real>, reach: real) -> Foot {
    let up = line_from(p, voxel_along(n));
    let down = line_from(p, -voxel_along(n));
    let ahead = first_root(up, 0.0, reach);
    let behind = first_root(down, 0.0, reach);
    if (ahead > reach && behind > reach) {
        return Foot();
    }
    if (behind > reach) {
        return Foot(true, place_on(up, ahead));
    }
    if (ahead > reach) {
        return Foot(true, place_on(down, behind));
    }
    var near = place_on(up, ahead);
    var far = place_on(down, behind);
    if (ahead > behind) {
        near = place_on(down, behind);
        far = place_on(up, ahead);
    }
    if (dot(surface_normal(near), n) <= 0.0 && dot(surface_normal(far), n) > 0.0) {
        return Foot(true, far);
    }
    return Foot(true, near);
}

// Whether the surface lies between the eye and a place, or at the place itself. The line runs away from the eye, and t = 0
// is the place.
fn is_hidden(p: vec3<real>) -> bool {
    if (!PERSPECTIVE) {
        return meets_surface(line_from(p, index_forward()), -4.0e6);
    }
    let way = p - index_eye();
    let depth = dot(depth_of_index(), way);
    return depth >= params.near && meets_surface(line_from(p, way / depth), params.near - depth);
}

@compute @workgroup_size(64)
fn test(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x;
    if (i >= u32(params.points)) {
        return;
    }
    let point = points[i];
    let n = vec3<real>(point.normal_x, point.normal_y, point.normal_z);
    var p = vec3<real>(point.x, point.y, point.z);
    let foot = foot_of(p, n, point.reach);
    if (foot.is_there && !is_cut_away(foot.at)) {
        let of_surface = surface_normal(foot.at);
        let out = select(of_surface, n, all(of_surface == vec3<real>()));
        p = foot.at + voxel_along(out) * params.in_front;
    }
    results[i] = select(1u, 2u, is_hidden(p));
}
