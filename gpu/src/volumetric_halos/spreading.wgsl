// From seeds to intensities: the seed image's gradient, and its spreading (3.2, [HALO-4], [HALO-5]). A workgroup computes a tile
// of a halo's image. Stages that follow each other in a dispatch keep their images in the memory of the workgroup, with a margin
// about the tile as wide as the stages behind reach.
// Twin: reference/src/volumetric_halos/spreading.rs

// The number of the stage that makes H_0; lower ones are the exponents of passes.
const SOURCE_STAGE = 12;

// N of each halo, then j and f of its taps, from the shortest distance, q, on.
@group(2) @binding(7) var<storage, read> halo_taps: array<real>;

// H_0; H of the pass before; the image that is written.
@group(3) @binding(0) var<storage, read> source_image: array<real>;
@group(3) @binding(1) var<storage, read> image_before: array<real>;
@group(3) @binding(2) var<storage, read_write> image_after: array<real>;

var<workgroup> tile_numbers: array<real, TILE_NUMBERS>;

// Two taps, t = j + f rays before and behind a pixel, each linear between its two neighbours.
struct HaloTaps {
    j: i32,
    f: real,
}

fn taps_of(halo: i32, exponent: i32) -> HaloTaps {
    let at = halo * (2 * SOURCE_STAGE + 1) + 2 * exponent + 1;
    return HaloTaps(i32(halo_taps[at]), halo_taps[at + 1]);
}

// N.
fn passes_of(halo: i32) -> i32 {
    return i32(halo_taps[halo * (2 * SOURCE_STAGE + 1)]);
}

// A seed of a group of planes; 0 beyond the border.
fn planted_at(at: vec2<i32>, layer: i32) -> real {
    if (!is_in_image(at)) {
        return 0.0;
    }
    return seed_image[image_place(at, layer)];
}

// A square of pixels that lies in the memory of a workgroup.
struct Square {
    first: i32,
    side: i32,
    corner: vec2<i32>,
    halo: i32,
}

fn square_at(square: Square, at: vec2<i32>) -> real {
    let own = at - square.corner;
    return tile_numbers[square.first + own.y * square.side + own.x];
}

// H of the pass before in its buffer; 0 beyond the border.
fn image_at(at: vec2<i32>, halo: i32) -> real {
    if (!is_in_image(at)) {
        return 0.0;
    }
    return image_before[image_place(at, halo)];
}

// Whether H_0 is the first stage of a dispatch.
fn begins_with_seeds() -> bool {
    return plane_group.from_stage == SOURCE_STAGE;
}

// Whether a pass is alone in its dispatch.
fn is_alone() -> bool {
    return plane_group.from_stage == plane_group.to_stage;
}

// H of the pass before. A pass alone reads the buffer, and another one the memory of the workgroup.
fn before_at(square: Square, at: vec2<i32>) -> real {
    if (is_alone()) {
        return image_at(at, square.halo);
    }
    return square_at(square, at);
}

// The weights of the nearer and of the farther neighbour of a tap.
fn neighbour_weight(taps: HaloTaps, farther: i32) -> real {
    return select(1.0 - taps.f, taps.f, farther == 1);
}

// The neighbours of a tap beside the nearer one: none if it lies at a pixel.
fn farther_neighbours(taps: HaloTaps) -> i32 {
    return select(0, 1, taps.f > 0.0);
}

// Weights [1 2 1]/4 in y.
fn column_of(square: Square, x: i32, y: i32, taps: HaloTaps) -> real {
    var sum = real(0.0);
    for (var k = 0; k <= farther_neighbours(taps); k++) {
        let t = taps.j + k;
        sum += neighbour_weight(taps, k) * (before_at(square, vec2(x, y - t)) + before_at(square, vec2(x, y + t)));
    }
    return 0.25 * (sum + 2.0 * before_at(square, vec2(x, y)));
}

// F: weights [1 2 1; 2 4 2; 1 2 1]/16, first in y, then in x.
fn filtered(square: Square, x: i32, y: i32, taps: HaloTaps) -> real {
    var sum = real(0.0);
    for (var k = 0; k <= farther_neighbours(taps); k++) {
        let t = taps.j + k;
        sum += neighbour_weight(taps, k) * (column_of(square, x - t, y, taps) + column_of(square, x + t, y, taps));
    }
    return 0.25 * (sum + 2.0 * column_of(square, x, y, taps));
}

// H_i = delta F_i + (1 - delta F_i) H_0.
fn spread(f: real, source: real, delta: real) -> real {
    let part = delta * f;
    return part + (1.0 - part) * source;
}

// A pass at a pixel, of H_0 and H before; 0 beyond the border.
fn passed(source: Square, before: Square, at: vec2<i32>, exponent: i32) -> real {
    if (!is_in_image(at)) {
        return 0.0;
    }
    let f = filtered(before, at.x, at.y, taps_of(before.halo, exponent));
    var h0: real;
    if (begins_with_seeds()) {
        h0 = square_at(source, at);
    } else {
        h0 = source_image[image_place(at, before.halo)];
    }
    return spread(f, h0, halos[before.halo].delta);
}

// The square about a tile on which a dispatch needs the image before a pass. It lies at `first` in the memory of the workgroup.
fn square_before(exponent: i32, halo: i32, tile: vec2<i32>, first: i32) -> Square {
    var margin = 0;
    for (var later = plane_group.to_stage; later <= exponent; later++) {
        let taps = taps_of(halo, later);
        margin += taps.j + farther_neighbours(taps);
    }
    return Square(first, TILE + 2 * margin, tile * TILE - margin, halo);
}

// A pixel of a square, counted row by row.
fn pixel_of(square: Square, i: i32) -> vec2<i32> {
    return square.corner + vec2(i % square.side, i / square.side);
}

fn pixel_of_tile(tile: vec2<i32>, own: i32) -> vec2<i32> {
    return tile * TILE + vec2(own % TILE, own / TILE);
}

// The last stage of a dispatch at a pixel of a tile, after the stages before it on squares about the tile. All invocations of a
// workgroup call it together.
fn spread_tile(halo: i32, tile: vec2<i32>, own: i32) -> real {
    // A halo with fewer passes begins later: until then H is H_0.
    let first_pass = min(plane_group.from_stage, passes_of(halo) - 1);
    let passes = first_pass - plane_group.to_stage + 1;
    let source = square_before(first_pass, halo, tile, 0);
    if (passes <= 0 || !is_alone()) {
        let seeds = seed_layer(halo, halo_group(halo));
        for (var i = own; i < source.side * source.side; i += TILE * TILE) {
            let at = pixel_of(source, i);
            if (begins_with_seeds()) {
                tile_numbers[i] = source_of(at, halo, seeds);
            } else {
                tile_numbers[i] = image_at(at, halo);
            }
        }
    }
    if (passes <= 0) {
        // The square is the tile.
        return tile_numbers[own];
    }
    workgroupBarrier();
    var before = source;
    var free = source.side * source.side;
    var result: real;
    for (var exponent = first_pass; exponent >= plane_group.to_stage; exponent--) {
        // After the last pass the square is the tile, whose pixels need no memory.
        let after = square_before(exponent - 1, halo, tile, free);
        for (var i = own; i < after.side * after.side; i += TILE * TILE) {
            result = passed(source, before, pixel_of(after, i), exponent);
            if (exponent > plane_group.to_stage) {
                tile_numbers[free + i] = result;
            }
        }
        workgroupBarrier();
        // The image before is not needed any more, unless it is H_0.
        let keeps = begins_with_seeds() && exponent == first_pass;
        free = select(before.first, free + after.side * after.side, keeps);
        before = after;
    }
    return result;
}

// Stages of spreading that follow each other. After the last one values below the floor are 0, and O = max(O, H).
@compute @workgroup_size(16, 16)
fn halo_spread(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) index: u32) {
    let halo = i32(group.z);
    let tile = vec2<i32>(group.xy);
    let own = i32(index);
    let state = tile_state(tile, halo, own);
    let is_last = plane_group.to_stage == 0;
    let visited = u32(plane_group.number);
    if (is_last && halo == 0 && own == 0) {
        set_flag(TILE_NEAR, tile, select(0u, 1u, state.open_near > visited));
    }
    // A tile that the group before has reached becomes 0.
    let planes = halo_group(halo);
    if (!group_ends(plane_group.end, i32(halos[halo].every)) || i32(state.seeded) < planes - 1) {
        return;
    }
    var result = real(0.0);
    let is_hidden_tile = is_last && state.open <= visited;
    if (i32(state.seeded) == planes && !is_hidden_tile) {
        result = spread_tile(halo, tile, own);
    }
    let at = pixel_of_tile(tile, own);
    if (!is_in_image(at)) {
        return;
    }
    let place = image_place(at, halo);
    if (!is_last) {
        image_after[place] = result;
        return;
    }
    let h = select(result, real(0.0), result < halos[halo].floor);
    halo_image[place] = h;
    occlusion_image[place] = max(occlusion_image[place], h);
    // The seeds of the group before make room for those of the next one.
    seed_image[image_place(at, seed_layer(halo, planes - 1))] = 0.0;
}
