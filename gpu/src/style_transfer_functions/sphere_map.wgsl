// The lookup of a lit sphere by a normal ([STF-1]).
// Twin: reference/src/style_transfer_functions/sphere_map.rs

struct SphereMap {
    // Its first texel, and the texels along its side.
    first: u32,
    side: u32,
    // Its first mip-map among the maps, and how many it has ([STF-10]).
    levels: u32,
    level_count: u32,
}

// Linear premultiplied texels of all maps, row by row from the top.
@group(1) @binding(10) var<storage, read> texels: array<vec4<f32>>;
// The styles in the order of their indices j, then their mip-maps.
@group(1) @binding(11) var<storage, read> sphere_maps: array<SphereMap>;

// Two neighbouring texels of a row, mixed.
fn texels_of_row(at: i32, next: i32, w: real) -> vec4<real> {
    return mix_texels(vec4<real>(texels[at]), vec4<real>(texels[at + next]), w);
}

// Linear premultiplied (r, g, b, alpha_d) of the normal (N_x, N_y, +-N_z): bilinear, x then y, at
// x = (N_x + 1) S/2 - 1/2, y = (1 - N_y) S/2 - 1/2.
fn sample_sphere(map: i32, n: vec2<real>) -> vec4<real> {
    let side = i32(sphere_maps[map].side);
    let half_side = real(side) * 0.5;
    let x = texel_cell((n.x + 1.0) * half_side - 0.5, side);
    let y = texel_cell((1.0 - n.y) * half_side - 0.5, side);
    // With a single texel the cell has no second one, and the weight is 0.
    let next = select(0, 1, side > 1);
    let at = i32(sphere_maps[map].first) + y.i * side + x.i;
    return mix_texels(texels_of_row(at, next, x.w), texels_of_row(at + next * side, next, x.w), y.w);
}
