// An iso-surface that no plane cuts.
// Glue: A choice of clip planes.

fn find_surface(ray: Ray) {
    hit = first_root(ray, params.near_steps, NO_HIT);
}
