// The numbers that the kernel weighs: values minus the value of number 0, times a power of two.
// Glue: A buffer.

@group(1) @binding(0) var numbers: texture_3d<f32>;

// The number at a voxel; beyond the border the continued ones.
fn number_at(i: vec3<i32>) -> real {
    return number_of(textureLoad(numbers, i + vec3<i32>(NUMBERS_PAD), 0));
}
