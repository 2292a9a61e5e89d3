// A volume without masked voxels: every cell can be inside an iso-surface.

fn can_be_inside(cell: vec3<i32>) -> bool {
    return true;
}
