// The gradient of a volume that is not moved.
// Glue: A choice of the place of a volume.

fn moved_gradient(g: vec3<real>) -> vec3<real> {
    return g;
}
