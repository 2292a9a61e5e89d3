// An iso-surface that no plane cuts.

fn find_surface(ray: Ray) {
    hit = first_root(ray, params.near_steps, NO_HIT);
}
