// Pictures of intersection transfer functions ([VS-4]): colours over the value at p and that at T p.
// Twin: reference/src/volumeshop/intersections.rs

// Pixels of pictures, and dabs.
@group(1) @binding(25) var<storage, read> intersection_tables: array<vec4<real>>;

// Two neighbouring pixels of a row, mixed.
fn intersection_row(at: i32, width: i32, w: real) -> vec4<real> {
    return mix_texels(intersection_tables[at], intersection_tables[at + min(width - 1, 1)], w);
}

// The colour and the opacity at shares of both ranges, in a picture whose pixels begin at `first`: bilinear between the
// centres of pixels, clamped. Rows are counted from the top.
fn intersection_at(first: i32, width: i32, height: i32, x: real, y: real) -> vec4<real> {
    let column = texel_cell(x * real(width - 1), width);
    let row = texel_cell((1.0 - y) * real(height - 1), height);
    let at = first + row.i * width + column.i;
    let below = at + width * min(height - 1, 1);
    return mix_texels(intersection_row(at, width, column.w), intersection_row(below, width, column.w), row.w);
}

// The place of a value within a range, from 0 to 1.
fn share_of_range(value: real, low: real, width: real) -> real {
    return (value - low) / width;
}
