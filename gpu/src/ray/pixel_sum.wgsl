// The mean of a pixel over its rays ([RAY-6]), over the background ([IO-6]).
// Twin: reference/src/ray/pixel_sum.rs

// Its rows begin at params.top_row.
@group(0) @binding(1) var<storage, read_write> picture: array<real>;

// Whether the pixel is drawn once more: layers of one ray stay as they are.
var<private> is_refined: bool;

// Pixels of the picture, across and down.
fn picture_size() -> vec2<i32> {
    return vec2(i32(params.picture_width), i32(params.picture_height));
}

// n of the n x n rays of a pixel.
fn rays_across() -> i32 {
    return i32(params.rays_across);
}

// The centre of a part of a pixel, in pixels from the middle of the picture, to the right and up.
fn point_of(pixel: vec2<i32>, part: i32, across: i32) -> vec2<real> {
    let x = real(2 * pixel.x - picture_size().x) * 0.5 + (real(part % across) + 0.5) / real(across);
    let y = real(2 * pixel.y - picture_size().y) * 0.5 + (real(part / across) + 0.5) / real(across);
    return vec2<real>(x, -y);
}

// The place of a pixel's numbers.
fn place_of(pixel: vec2<i32>) -> i32 {
    return ((pixel.y - i32(params.top_row)) * picture_size().x + pixel.x) * CHANNELS;
}

// Whether the driver has ended loops: from then on each has one turn. No compiler knows the number of turns, two.
fn has_ended_loops() -> bool {
    let most = 1 + i32(min(params.picture_width, 1.0));
    var turns = 0;
    for (; turns < most; turns++) {
    }
    return turns < most;
}

// The rays of a pixel, n side by side.
fn draw_pixel(pixel: vec2<i32>, n: i32) {
    let out = place_of(pixel);
    let behind = background_at(pixel.y * picture_size().x + pixel.x);
    is_unfinished = false;
    // A beauty alone is drawn part by part: drivers end shaders that run long. What came before stands in the picture.
    let first = i32(params.first_part);
    let end = min(i32(params.end_part), n * n);
    var sum = vec4<real>();
    if (first > 0) {
        sum = vec4<real>(picture[out], picture[out + 1], picture[out + 2], picture[out + 3]);
        is_unfinished = sum.r <= UNFINISHED;
    }
    for (var part = first; part < end; part++) {
        let point = point_of(pixel, part, n);
        begin_part(pixel, part, n);
        sum += over_background(cast_ray(ray_through(point.x, point.y)), behind);
        end_ray(part);
    }
    if (end < n * n) {
        picture[out] = sum.r;
        picture[out + 1] = sum.g;
        picture[out + 2] = sum.b;
        picture[out + 3] = sum.a;
    } else {
        write_channels(out, sum / real(n * n));
    }
    if (is_unfinished || has_ended_loops()) {
        picture[out] = UNFINISHED;
    }
}

@compute @workgroup_size(8, 8)
fn draw(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy) + vec2(0, i32(params.first_row));
    if (pixel.x < picture_size().x && pixel.y < i32(params.end_row)) {
        draw_pixel(pixel, rays_across());
    }
}
