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

// H of the pass before. A pass that is alone in its dispatch reads the buffer, and another one the memory of the workgroup.
fn before_at(square: Square, at: vec2<i32>) -> real {
    if (IN_MEMORY) {
        return square_at(square, at);
    }
    return image_at(at, square.halo);
}

// Weights [1 2 1]/4 in y.
fn column_of(square: Square, x: i32, y: i32, taps: HaloTaps) -> real {
    var sum = before_at(square, vec2(x, y - taps.j)) + before_at(square, vec2(x, y + taps.j));
    if (taps.f > 0.0) {
        let far = before_at(square, vec2(x, y - taps.j - 1)) + before_at(square, vec2(x, y + taps.j + 1));
        sum = (1.0 - taps.f) * sum + taps.f * far;
    }
    return 0.25 * (sum + 2.0 * before_at(square, vec2(x, y)));
}

// F: weights [1 2 1; 2 4 2; 1 2 1]/16, first in y, then in x.
fn filtered(square: Square, x: i32, y: i32, taps: HaloTaps) -> real {
    var sum = column_of(square, x - taps.j, y, taps) + column_of(square, x + taps.j, y, taps);
    if (taps.f > 0.0) {
        let far = column_of(square, x - taps.j - 1, y, taps) + column_of(square, x + taps.j + 1, y, taps);
        sum = (1.0 - taps.f) * sum + taps.f * far;
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
    if (FROM_SEEDS) {
        return spread(f, square_at(source, at), halos[before.halo].delta);
    }
    return spread(f, source_image[image_place(at, before.halo)], halos[before.halo].delta);
}

// The square about a tile on which a dispatch needs the image before a pass. It lies at `first` in the memory of the workgroup.
fn square_before(exponent: i32, halo: i32, tile: vec2<i32>, first: i32) -> Square {
    var margin = 0;
    for (var later = plane_group.to_stage; later <= exponent; later++) {
        let taps = taps_of(halo, later);
        margin += taps.j + select(0, 1, taps.f > 0.0);
    }
    return Square(first, TILE + 2 * margin, tile * TILE - margin, halo);
}

// A pixel of a square, counted row by row.
fn pixel_of(square: Square, i: i32) -> vec2<i32> {
    return square.corner + vec2(i % square.side, i / square.side);
}

// The last of some passes at a pixel of a tile, after the passes before it on squares about the tile. All invocations of a
// workgroup call it together.
fn spread_in_memory(first_pass: i32, halo: i32, tile: vec2<i32>, own: i32) -> real {
    let source = square_before(first_pass, halo, tile, 0);
    let seeds = seed_layer(halo, halo_group(halo));
    for (var i = own; i < source.side * source.side; i += TILE * TILE) {
        let at = pixel_of(source, i);
        if (FROM_SEEDS) {
            tile_numbers[i] = source_of(at, halo, seeds);
        } else {
            tile_numbers[i] = image_at(at, halo);
        }
    }
    workgroupBarrier();
    var before = source;
    var free = source.side * source.side;
    for (var exponent = first_pass; exponent > plane_group.to_stage; exponent--) {
        let after = square_before(exponent - 1, halo, tile, free);
        for (var i = own; i < after.side * after.side; i += TILE * TILE) {
            tile_numbers[free + i] = passed(source, before, pixel_of(after, i), exponent);
        }
        workgroupBarrier();
        // The image before is not needed any more, unless it is H_0.
        free = select(before.first, free + after.side * after.side, FROM_SEEDS && exponent == first_pass);
        before = after;
    }
    return passed(source, before, pixel_of_tile(tile, own), plane_group.to_stage);
}

fn pixel_of_tile(tile: vec2<i32>, own: i32) -> vec2<i32> {
    return tile * TILE + vec2(own % TILE, own / TILE);
}

// The last stage of a dispatch at a pixel of a tile. FROM_SEEDS tells whether H_0 is the first one, and IN_MEMORY whether several
// stages follow each other.
fn spread_tile(halo: i32, tile: vec2<i32>, own: i32) -> real {
    let at = pixel_of_tile(tile, own);
    // A halo with fewer passes begins later.
    let first_pass = min(plane_group.from_stage, passes_of(halo) - 1);
    if (first_pass >= plane_group.to_stage) {
        if (IN_MEMORY) {
            return spread_in_memory(first_pass, halo, tile, own);
        }
        return passed(Square(), Square(0, 0, vec2(0), halo), at, first_pass);
    }
    if (FROM_SEEDS) {
        return source_of(at, halo, seed_layer(halo, halo_group(halo)));
    }
    if (!is_in_image(at)) {
        return 0.0;
    }
    return source_image[image_place(at, halo)];
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
