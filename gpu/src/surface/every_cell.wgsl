// A volume without masked voxels: every cell can be inside an iso-surface.
// Glue: A choice of the mask.

fn can_be_inside(cell: vec3<i32>) -> bool {
    return true;
}
