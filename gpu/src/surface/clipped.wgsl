// An iso-surface that planes cut: a ray meets what they leave of it, or a plane that cuts its inside open ([RAY-8]).

// The plane on which the ray meets the surface; -1: the surface itself.
var<private> hit_plane: i32;

// Whether a place is inside the surface, or on it. A place outside the box is not, nor is one in a masked cell.
fn is_inside_surface(p: vec3<real>) -> bool {
    if (!in_box(p)) {
        return false;
    }
    let at = locate(p);
    let over = value_at(at) - params.iso;
    return can_be_inside(at.cell) && select(over <= 0.0, over >= 0.0, OUTSIDE_IS_LOW);
}

fn find_surface(ray: Ray) {
    hit = NO_HIT;
    hit_plane = -1;
    // The part of the ray that planes leave, and the plane through which the ray comes to it.
    var start = params.near_steps;
    var end = real(NO_HIT);
    for (var i = 0; i < PLANES; i++) {
        let a = beyond(i, ray.origin);
        let b = growth(i, ray);
        if (abs(b) < 1.0e-20) {
            if (a > 0.0) {
                return;
            }
            continue;
        }
        let t = -a / b;
        if (b < 0.0 && t > start) {
            start = t;
            hit_plane = i;
        } else if (b > 0.0 && t < end) {
            end = t;
        }
    }
    if (start > end) {
        return;
    }
    if (hit_plane >= 0 && is_inside_surface(ray.origin + ray.along * (start * ray.depth_step))) {
        hit = start;
        return;
    }
    hit_plane = -1;
    let root = first_root(ray, start);
    if (root <= end) {
        hit = root;
    }
}

// From here on the ray's cut is that of the surface.
fn cut_surface(ray: Ray, seen: Front) -> Front {
    cut_plane = hit_plane;
    cut_k = last_before_surface();
    return seen;
}

// The colour of an opaque surface under a cap, which lies over its own.
fn under_cap(own: Shaded, cap: Shaded) -> Shaded {
    return Shaded(lerp3(own.rgb, cap.rgb, cap.alpha), own.alpha);
}
