// Interpolation by the texture unit, whose weights have about 8 bits ([GPU-2]).
// Glue: The texture unit.

@group(1) @binding(8) var texture_unit: sampler;

// The number between the voxels of a texture that has `pad` of them before the volume's first.
fn between_voxels(numbers: texture_3d<f32>, p: vec3<real>, pad: i32) -> real {
    let place = (vec3<f32>(p) + (f32(pad) + 0.5)) / vec3<f32>(textureDimensions(numbers));
    return number_of(textureSampleLevel(numbers, texture_unit, place, 0.0));
}

// The index position of a place.
fn position_of(at: Place) -> vec3<real> {
    return vec3<real>(at.cell) + at.w;
}
