// From seeds to intensities: the seed image's gradient, and its spreading (3.2, [HALO-4], [HALO-5]).
// Twin: reference/src/volumetric_halos/spreading.rs

// H_0; H of the pass before, or filtered seeds; the image that is written.
@group(3) @binding(0) var<storage, read> source_image: array<vec4<real>>;
@group(3) @binding(1) var<storage, read> image_before: array<vec4<real>>;
@group(3) @binding(2) var<storage, read_write> image_after: array<vec4<real>>;

// Two taps, t = j + f rays before and behind a pixel, each linear between its two neighbours.
struct HaloTaps {
    j: i32,
    f: real,
}

// The taps of a halo's passes, from the shortest distance, q, on.
fn taps_of(halo: i32, exponent: i32) -> HaloTaps {
    let at = FIRST_TAPS + 2 * (halo * MOST_PASSES + exponent);
    return HaloTaps(i32(halo_numbers[at]), halo_numbers[at + 1]);
}

// A pixel of the image before; 0 beyond the border.
fn before_at(x: i32, y: i32, layer: i32) -> vec4<real> {
    if (x < 0 || y < 0 || x >= IMAGE_X || y >= IMAGE_Y) {
        return vec4<real>();
    }
    return image_before[layer + y * IMAGE_X + x];
}

// Weights [1 2 1]/4 in y.
fn column_of(x: i32, y: i32, layer: i32, taps: HaloTaps) -> vec4<real> {
    var sum = before_at(x, y - taps.j, layer) + before_at(x, y + taps.j, layer);
    if (taps.f > 0.0) {
        let far = before_at(x, y - taps.j - 1, layer) + before_at(x, y + taps.j + 1, layer);
        sum = (1.0 - taps.f) * sum + taps.f * far;
    }
    return 0.25 * (sum + 2.0 * before_at(x, y, layer));
}

// F: weights [1 2 1; 2 4 2; 1 2 1]/16, first in y, then in x.
fn filtered(x: i32, y: i32, layer: i32, taps: HaloTaps) -> vec4<real> {
    var sum = column_of(x - taps.j, y, layer, taps) + column_of(x + taps.j, y, layer, taps);
    if (taps.f > 0.0) {
        let far = column_of(x - taps.j - 1, y, layer, taps) + column_of(x + taps.j + 1, y, layer, taps);
        sum = (1.0 - taps.f) * sum + taps.f * far;
    }
    return 0.25 * (sum + 2.0 * column_of(x, y, layer, taps));
}

// H_i = delta F_i + (1 - delta F_i) H_0.
fn spread(f: real, source: real, delta: real) -> real {
    let part = delta * f;
    return part + (1.0 - part) * source;
}

// A pass of four halos. One whose passes are fewer begins later.
fn spread_four(x: i32, y: i32, four: i32) -> vec4<real> {
    let layer = four * (IMAGE_X * IMAGE_Y);
    let source = source_image[layer + y * IMAGE_X + x];
    var result = source;
    var f = vec4<real>();
    if (TAPS_ALIKE) {
        f = filtered(x, y, layer, taps_of(4 * four, plane_group.exponent));
    }
    for (var c = 0; c < min(4, HALOS - 4 * four); c++) {
        let halo = 4 * four + c;
        if (plane_group.exponent < i32(halos[halo].passes)) {
            if (!TAPS_ALIKE) {
                f[c] = filtered(x, y, layer, taps_of(halo, plane_group.exponent))[c];
            }
            result[c] = spread(f[c], source[c], halos[halo].delta);
        }
    }
    return result;
}

@compute @workgroup_size(8, 8)
fn halo_spread(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) own: vec3<u32>) {
    let at = vec3(listed_pixel(group, own), i32(group.z));
    if (at.x >= IMAGE_X || at.y >= IMAGE_Y) {
        return;
    }
    image_after[at.z * (IMAGE_X * IMAGE_Y) + at.y * IMAGE_X + at.x] = spread_four(at.x, at.y, at.z);
}

// The last pass. Values below the floor are 0; O = max(O, H), S = 0. Halos whose group goes on keep theirs.
@compute @workgroup_size(8, 8)
fn halo_end(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) own: vec3<u32>) {
    let at = vec3(listed_pixel(group, own), i32(group.z));
    if (at.x >= IMAGE_X || at.y >= IMAGE_Y) {
        return;
    }
    let place = at.z * (IMAGE_X * IMAGE_Y) + at.y * IMAGE_X + at.x;
    let result = spread_four(at.x, at.y, at.z);
    var h = halo_image[place];
    var o = occlusion_image[place];
    var s = seed_image[place];
    for (var c = 0; c < min(4, HALOS - 4 * at.z); c++) {
        let halo = 4 * at.z + c;
        if (group_ends(plane_group.end, i32(halos[halo].every))) {
            h[c] = select(result[c], real(0.0), result[c] < halos[halo].floor);
            o[c] = max(o[c], h[c]);
            s[c] = 0.0;
        }
    }
    if (plane_group.all_end == 1) {
        set_flag(TILE_SEEDED, tile_of(at.xy), 0u);
    }
    halo_image[place] = h;
    occlusion_image[place] = o;
    seed_image[place] = s;
}
