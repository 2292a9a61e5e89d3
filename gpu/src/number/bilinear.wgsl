// Bilinear interpolation between the cells of a table or the texels of a picture.
// Twin: reference/src/bilinear.rs

// Channel by channel, a + w (b - a).
fn mix_texels(a: vec4<real>, b: vec4<real>, w: real) -> vec4<real> {
    return a + (b - a) * w;
}

// A coordinate as its cell and the place in it.
struct TexelCell {
    i: i32,
    w: real,
}

// The cell min(floor(x), max(S - 2, 0)) of a coordinate clamped to [0, S - 1].
fn texel_cell(x: real, side: i32) -> TexelCell {
    let clamped = min(max(x, 0.0), real(side - 1));
    let i = min(i32(floor(clamped)), max(side - 2, 0));
    return TexelCell(i, clamped - real(i));
}
