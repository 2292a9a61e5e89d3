// Clip planes ([RAY-8]).
// Twin: scene/src/clip/plane.rs

struct Plane {
    // The outward normal and the offset in index space: beyond the plane lies what n.p - offset > 0.
    x: real,
    y: real,
    z: real,
    offset: real,
    // The unit normal in the world.
    world_x: real,
    world_y: real,
    world_z: real,
    // The cap of cuts: 1 if there is one, its straight linear colour and the factor of a cut's opacity; or 2 and the place of
    // a sphere.
    has_cap: real,
    r: real,
    g: real,
    b: real,
    opacity: real,
}

@group(1) @binding(7) var<storage, read> planes: array<Plane>;

fn beyond(plane: i32, p: vec3<real>) -> real {
    return dot(vec3<real>(planes[plane].x, planes[plane].y, planes[plane].z), p) - planes[plane].offset;
}

fn is_cut(p: vec3<real>) -> bool {
    for (var i = 0; i < PLANES; i++) {
        if (beyond(i, p) > 0.0) {
            return true;
        }
    }
    return false;
}

// The growth of n.p - offset from sample to sample.
fn growth(plane: i32, ray: Ray) -> real {
    return dot(vec3<real>(planes[plane].x, planes[plane].y, planes[plane].z), ray.along * ray.depth_step);
}

// The part of a ray that planes leave, from t = start to end; planes that are crossed into it and out of it, -1 for none.
struct Kept {
    start: real,
    end: real,
    entry: i32,
    exit: i32,
}

// The part of a ray that planes leave; nothing where start > end.
fn kept_of(ray: Ray, start: real, end: real) -> Kept {
    var kept = Kept(start, end, -1, -1);
    for (var i = 0; i < PLANES; i++) {
        let a = beyond(i, ray.origin);
        let b = growth(i, ray);
        if (abs(b) < 1.0e-20) {
            if (a > 0.0) {
                return Kept(1.0, 0.0, -1, -1);
            }
            continue;
        }
        let t = -a / b;
        if (b < 0.0 && t > kept.start) {
            kept.start = t;
            kept.entry = i;
        } else if (b > 0.0 && t < kept.end) {
            kept.end = t;
            kept.exit = i;
        }
    }
    return kept;
}
