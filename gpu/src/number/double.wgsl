// Numbers in f64, for adapters that have them. A texel holds a number in two parts.
// Glue: A type.

alias real = f64;

// The number in a texel.
fn number_of(texel: vec4<f32>) -> real {
    return f64(texel.r) + f64(texel.g);
}
