// A picture behind the volume, premultiplied.
// Glue: A buffer.

@group(1) @binding(4) var<storage, read> backdrop: array<real>;

fn background_at(pixel: i32) -> vec4<real> {
    let at = 4 * pixel;
    return vec4<real>(backdrop[at], backdrop[at + 1], backdrop[at + 2], backdrop[at + 3]);
}
