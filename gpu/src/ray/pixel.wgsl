// The mean of a pixel over its rays ([RAY-6]), over the background ([IO-6]).

@group(0) @binding(1) var<storage, read_write> picture: array<real>;

// The centre of a part of a pixel, in pixels from the middle of the picture, to the right and up.
fn point_of(pixel: vec2<i32>, part: i32, across: i32) -> vec2<real> {
    let x = real(2 * pixel.x - WIDTH) * 0.5 + (real(part % across) + 0.5) / real(across);
    let y = real(2 * pixel.y - HEIGHT) * 0.5 + (real(part / across) + 0.5) / real(across);
    return vec2<real>(x, -y);
}

// The rays of a pixel, n side by side.
fn draw_pixel(pixel: vec2<i32>, n: i32) {
    let at = (pixel.y - i32(params.first_row)) * WIDTH + pixel.x;
    let behind = background_at(pixel.y * WIDTH + pixel.x);
    var sum = vec4<real>();
    begin_pixel();
    for (var part = 0; part < n * n; part++) {
        let point = point_of(pixel, part, n);
        sum += over_background(cast_ray(ray_through(point.x, point.y)), behind);
        end_ray(part);
    }
    let mean = sum / real(n * n);
    let out = at * CHANNELS;
    write_channels(out, mean);
}

@compute @workgroup_size(8, 8)
fn draw(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy) + vec2(0, i32(params.first_row));
    if (pixel.x < WIDTH && pixel.y < i32(params.end_row)) {
        draw_pixel(pixel, RAYS_ACROSS);
    }
}
