// The magnitude of the seed image's gradient ([HALO-4]).
// Twin: reference/src/volumetric_halos/gradient_image.rs

// Half the difference of two taps in x and in y, over q pixels on both sides.
fn difference_in(x: i32, y: i32, layer: i32, step: vec2<i32>, taps: HaloTaps) -> vec4<real> {
    let near = step * taps.j;
    var d = seeds_at(x + near.x, y + near.y, layer) - seeds_at(x - near.x, y - near.y, layer);
    if (taps.f > 0.0) {
        let far = step * (taps.j + 1);
        let d_far = seeds_at(x + far.x, y + far.y, layer) - seeds_at(x - far.x, y - far.y, layer);
        d = (1.0 - taps.f) * d + taps.f * d_far;
    }
    return 0.5 * d;
}

// sqrt(dx^2 + dy^2), at most 1.
fn seed_gradient(x: i32, y: i32, layer: i32, taps: HaloTaps) -> vec4<real> {
    let dx = difference_in(x, y, layer, vec2(1, 0), taps);
    let dy = difference_in(x, y, layer, vec2(0, 1), taps);
    return min(sqrt(dx * dx + dy * dy), vec4<real>(1.0));
}

// H_0: the gradient of the seeds, or the seeds as they are.
@compute @workgroup_size(8, 8)
fn halo_source(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) own: vec3<u32>) {
    let at = vec3(listed_pixel(group, own), i32(group.z));
    if (at.x >= IMAGE_X || at.y >= IMAGE_Y) {
        return;
    }
    let layer = at.z * (IMAGE_X * IMAGE_Y);
    var result = seeds_at(at.x, at.y, layer);
    var g = vec4<real>();
    if (TAPS_ALIKE) {
        g = seed_gradient(at.x, at.y, layer, taps_of(4 * at.z, 0));
    }
    for (var c = 0; c < min(4, HALOS - 4 * at.z); c++) {
        let halo = 4 * at.z + c;
        if (halos[halo].from_gradient == 1.0) {
            if (!TAPS_ALIKE) {
                g[c] = seed_gradient(at.x, at.y, layer, taps_of(halo, 0))[c];
            }
            result[c] = g[c];
        }
    }
    image_after[layer + at.y * IMAGE_X + at.x] = result;
}
