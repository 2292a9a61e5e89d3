// Numbers in f32.
// Glue: A type.

alias real = f32;

// The number in a texel.
fn number_of(texel: vec4<f32>) -> real {
    return texel.r;
}
