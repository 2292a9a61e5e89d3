// The id of the nearest voxel ([STF-13]).
// Twin: reference/src/labels.rs

// Of two voxels at equal distance the lower index holds.
fn label_on_grid(p: vec3<real>) -> u32 {
    let at = label_place(p);
    let upper = select(vec3<i32>(), label_strides(), at.w > vec3<real>(0.5));
    return label_of_voxel(label_voxel(at.cell) + upper.x + upper.y + upper.z);
}
