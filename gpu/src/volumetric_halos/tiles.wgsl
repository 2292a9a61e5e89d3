// Square tiles of the images: passes visit those alone in which an image differs from zero ([RAY-2]).
// Glue: Tiles of images.

// Flags of tiles, each kind in a list of its own: seeds wait in the tile; an image can differ from zero; the number of the
// last group, counted from 1, behind which a ray was open; seeds can reach a ray that is open.
const TILE_SEEDED = 0;
const TILE_ACTIVE = 1;
const TILE_OPEN = 2;
const TILE_NEAR = 3;
// Then the number of tiles on each group's list.
const TILE_COUNTS = 4;

@group(2) @binding(6) var<storage, read_write> tile_flags: array<atomic<u32>>;
// The tiles that passes visit.
@group(2) @binding(7) var<storage, read_write> tile_list: array<u32>;

fn flag_place(flag: i32, tile: i32) -> i32 {
    return flag * (TILES_X * TILES_Y) + tile;
}

// The tile of a pixel of the images.
fn tile_of(at: vec2<i32>) -> i32 {
    return at.y / TILE * TILES_X + at.x / TILE;
}

fn set_flag(flag: i32, tile: i32, value: u32) {
    let place = flag_place(flag, tile);
    if (atomicLoad(&tile_flags[place]) != value) {
        atomicStore(&tile_flags[place], value);
    }
}

// Whether a ray can still see what halos change at a pixel.
fn is_near_open(at: vec2<i32>) -> bool {
    return atomicLoad(&tile_flags[flag_place(TILE_NEAR, tile_of(at))]) != 0u;
}

// The pixel of a listed tile that an invocation stands for; one beyond the images where the list has ended.
fn listed_pixel(group: vec3<u32>, own: vec3<u32>) -> vec2<i32> {
    let groups = TILE / 8;
    let number = i32(group.y) * (TILES_X * groups) + i32(group.x);
    let listed = number / (groups * groups);
    if (listed >= i32(atomicLoad(&tile_flags[flag_place(TILE_COUNTS, 0) + plane_group.number]))) {
        return vec2(IMAGE_X, IMAGE_Y);
    }
    let tile = i32(tile_list[listed]);
    let part = number % (groups * groups);
    return vec2(tile % TILES_X, tile / TILES_X) * TILE + vec2(part % groups, part / groups) * 8 + vec2<i32>(own.xy);
}

// Lists the tiles that the seeds of a group can reach, and those that were reached before: there images become zero.
@compute @workgroup_size(8, 8)
fn halo_tiles(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = vec2<i32>(id.xy);
    if (at.x >= TILES_X || at.y >= TILES_Y) {
        return;
    }
    let tile = at.y * TILES_X + at.x;
    var seeded = 0u;
    var open = 0u;
    for (var y = max(at.y - TILE_REACH, 0); y <= min(at.y + TILE_REACH, TILES_Y - 1); y++) {
        for (var x = max(at.x - TILE_REACH, 0); x <= min(at.x + TILE_REACH, TILES_X - 1); x++) {
            let other = y * TILES_X + x;
            seeded = max(seeded, atomicLoad(&tile_flags[flag_place(TILE_SEEDED, other)]));
            open = max(open, atomicLoad(&tile_flags[flag_place(TILE_OPEN, other)]));
        }
    }
    let is_reached = seeded != 0u;
    let was_reached = atomicLoad(&tile_flags[flag_place(TILE_ACTIVE, tile)]) != 0u;
    if (is_reached || was_reached) {
        let place = flag_place(TILE_COUNTS, 0) + plane_group.number;
        tile_list[atomicAdd(&tile_flags[place], 1u)] = u32(tile);
    }
    // Halos whose groups go on keep their intensities.
    let stays = is_reached || (was_reached && plane_group.all_end == 0);
    set_flag(TILE_ACTIVE, tile, select(0u, 1u, stays));
    set_flag(TILE_NEAR, tile, select(0u, 1u, open > u32(plane_group.number)));
}
