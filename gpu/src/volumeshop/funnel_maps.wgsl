// The maps of funnels, from far depths: coverage and covered depth, dilated and smoothed (7; [VS-7]). Rows of a funnel hold its
// guard band, and beyond it is nothing.
// Twin: reference/src/volumeshop/funnel.rs

struct Funnel {
    // The guard band in pixels, and the place of its first depth.
    guard: i32,
    first: i32,
    // Pixels by which depths are dilated, up and down; then, from `halves` on, to the left and right in each of these rows.
    radius: i32,
    halves: i32,
    // Taps to each side, and the place of the middle one.
    reach: i32,
    middle: i32,
}

@group(0) @binding(0) var<storage, read> funnels: array<Funnel>;
@group(0) @binding(1) var<storage, read> funnel_halves: array<i32>;
@group(0) @binding(2) var<storage, read> funnel_taps: array<real>;
@group(0) @binding(3) var<storage, read> far_depths: array<real>;
// Coverage and covered depth: dilated, smoothed along rows, and as maps.
@group(0) @binding(4) var<storage, read_write> dilated: array<vec2<real>>;
@group(0) @binding(5) var<storage, read_write> smooth_rows_of: array<vec2<real>>;
@group(0) @binding(6) var<storage, read_write> maps: array<vec2<real>>;

fn banded(funnel: Funnel) -> vec2<i32> {
    return vec2(FUNNEL_X, FUNNEL_Y) + 2 * funnel.guard;
}

// The largest depth within x^2 + y^2 <= (1.5 sigma)^2, whole pixels.
@compute @workgroup_size(8, 8)
fn dilate(@builtin(global_invocation_id) id: vec3<u32>) {
    let funnel = funnels[id.z];
    let size = banded(funnel);
    let at = vec2<i32>(id.xy);
    if (any(at >= size)) {
        return;
    }
    var most = real(-3.0e38);
    for (var y = max(at.y - funnel.radius, 0); y <= min(at.y + funnel.radius, size.y - 1); y++) {
        let half_width = funnel_halves[funnel.halves + abs(y - at.y)];
        for (var x = max(at.x - half_width, 0); x <= min(at.x + half_width, size.x - 1); x++) {
            most = max(most, far_depths[funnel.first + y * size.x + x]);
        }
    }
    dilated[funnel.first + at.y * size.x + at.x] = select(vec2<real>(), vec2<real>(1.0, most), most > -1.0e38);
}

@compute @workgroup_size(8, 8)
fn smooth_rows(@builtin(global_invocation_id) id: vec3<u32>) {
    let funnel = funnels[id.z];
    let size = banded(funnel);
    let at = vec2<i32>(id.xy);
    if (any(at >= size)) {
        return;
    }
    var sum = vec2<real>();
    let row = funnel.first + at.y * size.x;
    for (var x = max(at.x - funnel.reach, 0); x <= min(at.x + funnel.reach, size.x - 1); x++) {
        sum += dilated[row + x] * funnel_taps[funnel.middle + x - at.x];
    }
    smooth_rows_of[row + at.x] = sum;
}

// c~ and d^ = K*(cd)/c~ of each pixel of the picture; no coverage where there is no cut.
@compute @workgroup_size(8, 8)
fn map_funnels(@builtin(global_invocation_id) id: vec3<u32>) {
    let funnel = funnels[id.z];
    let size = banded(funnel);
    let pixel = vec2<i32>(id.xy);
    if (pixel.x >= FUNNEL_X || pixel.y >= FUNNEL_Y) {
        return;
    }
    let at = pixel + funnel.guard;
    var sum = vec2<real>();
    for (var y = max(at.y - funnel.reach, 0); y <= min(at.y + funnel.reach, size.y - 1); y++) {
        sum += smooth_rows_of[funnel.first + y * size.x + at.x] * funnel_taps[funnel.middle + y - at.y];
    }
    let place = (i32(id.z) * FUNNEL_Y + pixel.y) * FUNNEL_X + pixel.x;
    maps[place] = select(vec2<real>(), vec2<real>(sum.x, sum.y / sum.x), sum.x > 1.0e-6);
}
