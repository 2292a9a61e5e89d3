// Adaptive antialiasing ([RAY-7]): 3 x 3 rays where the picture of one ray a pixel has edges.
// Twin: reference/src/ray/refinement.rs

// The first picture: the beauty leads the numbers of each pixel.
@group(0) @binding(2) var<storage, read> first_picture: array<real>;

// A channel of the pixel as it is displayed.
fn displayed(pixel: vec2<i32>) -> vec4<real> {
    let at = place_of(pixel);
    let r = linear_to_srgb(clamp_01(first_picture[at]));
    let g = linear_to_srgb(clamp_01(first_picture[at + 1]));
    let b = linear_to_srgb(clamp_01(first_picture[at + 2]));
    return vec4<real>(r, g, b, first_picture[at + 3]);
}

// Whether a pixel parts from one of its eight neighbours by more than the contrast in a channel.
fn is_at_edge(pixel: vec2<i32>) -> bool {
    let own = displayed(pixel);
    for (var y = max(pixel.y - 1, 0); y <= min(pixel.y + 1, picture_size().y - 1); y++) {
        for (var x = max(pixel.x - 1, 0); x <= min(pixel.x + 1, picture_size().x - 1); x++) {
            let apart = abs(displayed(vec2(x, y)) - own);
            if (any(apart > vec4<real>(params.contrast))) {
                return true;
            }
        }
    }
    return false;
}

// Draws a pixel at an edge anew.
@compute @workgroup_size(8, 8)
fn refine(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy) + vec2(0, i32(params.first_row));
    if (pixel.x >= picture_size().x || pixel.y >= i32(params.end_row)) {
        return;
    }
    if (!is_at_edge(pixel)) {
        return;
    }
    is_refined = true;
    draw_pixel(pixel, 3);
    let at = place_of(pixel);
    if (first_picture[at] <= UNFINISHED) {
        picture[at] = UNFINISHED;
    }
}
