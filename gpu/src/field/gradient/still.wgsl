// The gradient of a volume that is not moved.

fn moved_gradient(g: vec3<real>) -> vec3<real> {
    return g;
}
