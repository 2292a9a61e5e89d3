// A selection volume: trilinear, whatever the kernel of the data ([VS-2]). Its list holds the voxels of its box.
// Twin: reference/src/volumeshop/membership.rs

fn membership_at(steps: real, s: real) -> real {
    let at = locate(place_on(selection_ray, steps) - first_member());
    return on_grid(0, vec3(MEMBERS_X, MEMBERS_Y, MEMBERS_Z), at);
}
