// Voxels in the units of the numbers, for estimators that do not read the kernel's numbers.
// Glue: A buffer.

@group(1) @binding(1) var voxels: texture_3d<f32>;

// The voxel, beyond the border continued.
fn voxel_at(i: vec3<i32>) -> real {
    return number_of(textureLoad(voxels, i + vec3<i32>(VOXELS_PAD), 0));
}
