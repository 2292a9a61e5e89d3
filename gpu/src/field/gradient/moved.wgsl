// The gradient of a moved field ([VS-2]): the transpose of L_T, the linear part of T, times the volume's.
// Glue: A choice of the place of a volume.

fn moved_gradient(g: vec3<real>) -> vec3<real> {
    return moved_x() * g.x + moved_y() * g.y + moved_z() * g.z;
}
