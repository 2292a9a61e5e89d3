// The beauty of a finished picture in a viewer's texture: premultiplied, in linear light.
// Glue: An entry point.

@group(0) @binding(0) var<storage, read> finished: array<real>;
@group(0) @binding(1) var shown: texture_storage_2d<rgba16float, write>;
// The scalars of the picture's shader: width and height in pixels lie at SIZE.
@group(0) @binding(2) var<storage, read> numbers: array<real>;

@compute @workgroup_size(8, 8)
fn present(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    let size = vec2(i32(numbers[SIZE]), i32(numbers[SIZE + 1]));
    if (all(pixel < size)) {
        let i = (pixel.y * size.x + pixel.x) * CHANNELS + BEAUTY;
        let color = vec4<f32>(f32(finished[i]), f32(finished[i + 1]), f32(finished[i + 2]), f32(finished[i + 3]));
        textureStore(shown, pixel, color);
    }
}
