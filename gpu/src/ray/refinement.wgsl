// Adaptive antialiasing ([RAY-7]): five rays where the picture of one ray a pixel has edges, and nine where the five differ.
// Twin: reference/src/ray/refinement.rs

// The first picture: the beauty leads the numbers of each pixel.
@group(0) @binding(2) var<storage, read> first_picture: array<real>;

// R, G, B and A of a pixel of the first picture.
fn first_color(pixel: vec2<i32>) -> vec4<real> {
    let at = place_of(pixel);
    return vec4<real>(first_picture[at], first_picture[at + 1], first_picture[at + 2], first_picture[at + 3]);
}

// A colour as it is displayed.
fn displayed(c: vec4<real>) -> vec4<real> {
    return vec4<real>(linear_to_srgb(clamp_01(c.r)), linear_to_srgb(clamp_01(c.g)), linear_to_srgb(clamp_01(c.b)), c.a);
}

// Whether a pixel parts from one of its eight neighbours by more than the contrast in a channel.
fn is_at_edge(pixel: vec2<i32>) -> bool {
    let own = displayed(first_color(pixel));
    for (var y = max(pixel.y - 1, 0); y <= min(pixel.y + 1, picture_size().y - 1); y++) {
        for (var x = max(pixel.x - 1, 0); x <= min(pixel.x + 1, picture_size().x - 1); x++) {
            let apart = abs(displayed(first_color(vec2(x, y))) - own);
            if (any(apart > vec4<real>(params.contrast))) {
                return true;
            }
        }
    }
    return false;
}

// The parts of a refined pixel's 3 x 3, in the order in which they are cast: the middle, the corners, the others.
fn refined_part(i: i32) -> i32 {
    if (i == 0) {
        return 4;
    }
    let j = (i - 1) & 3;
    return select(2 * j + 1, 2 * (j & 1) + 6 * (j >> 1u), i < 5);
}

// Adds rays to a pixel. The middle one is cast again only for the means of layers.
fn draw_refined(pixel: vec2<i32>) {
    let behind = background_at(pixel.y * picture_size().x + pixel.x);
    is_unfinished = false;
    is_refined = true;
    let first = first_color(pixel);
    var sum = vec4<real>();
    var low = displayed(first);
    var high = low;
    var rays = 5;
    for (var i = 0; i < rays; i++) {
        let part = refined_part(i);
        var color = first;
        if (i > 0 || CHANNELS > 4) {
            let point = point_of(pixel, part, 3);
            begin_part(pixel, part, 3);
            color = over_background(cast_ray(ray_through(point.x, point.y)), behind);
            end_ray(i);
        }
        sum += color;
        let seen = displayed(color);
        low = min(low, seen);
        high = max(high, seen);
        if (i == 4 && any(high - low > vec4<real>(params.contrast))) {
            rays = 9;
        }
    }
    let out = place_of(pixel);
    write_channels(out, sum / real(rays));
    if (is_unfinished || first.r <= UNFINISHED || has_ended_loops()) {
        picture[out] = UNFINISHED;
    }
}

// Draws a pixel at an edge anew.
@compute @workgroup_size(8, 8)
fn refine(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy) + vec2(0, i32(params.first_row));
    if (pixel.x >= picture_size().x || pixel.y >= i32(params.end_row)) {
        return;
    }
    if (is_at_edge(pixel)) {
        draw_refined(pixel);
    }
}
