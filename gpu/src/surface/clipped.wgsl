// An iso-surface that planes cut: a ray meets what they leave of it, or a plane that cuts its inside open ([RAY-8]).
// Twin: reference/src/surface/clipped.rs

// The plane on which the ray meets the surface; -1: the surface itself.
var<private> hit_plane: i32;

fn find_surface(ray: Ray) {
    hit_plane = -1;
    let kept = kept_of(ray, params.near_steps, NO_HIT);
    if (kept.start > kept.end) {
        return;
    }
    if (kept.entry >= 0 && is_inside_surface(ray.origin + ray.along * (kept.start * ray.depth_step))) {
        hit = kept.start;
        hit_plane = kept.entry;
        return;
    }
    let root = first_root(ray, kept.start, NO_HIT);
    if (root <= kept.end) {
        hit = root;
    }
}

// The cut of the ray's samples: its plane and its first sample.
var<private> cut_of_samples: vec2<i32>;

// While the surface is met the ray's cut is that of the surface.
fn cut_surface(ray: Ray, seen: Front) -> Front {
    cut_of_samples = vec2(cut_plane, cut_k);
    cut_plane = hit_plane;
    cut_k = last_before_surface();
    return seen;
}

fn leave_surface(ray: Ray, seen: Front) -> Front {
    cut_plane = cut_of_samples.x;
    cut_k = cut_of_samples.y;
    return seen;
}
