// Square tiles of the images: an intensity is computed only where seeds can reach a tile ([RAY-2]).
// Glue: Tiles of images.

// Numbers of tiles, each kind in a list of its own. The last group of planes, counted from 1, behind which a ray was open; 1
// where seeds can reach a ray that is open; then, for each halo, its last group that has seeds in the tile.
const TILE_OPEN = 0;
const TILE_NEAR = 1;
const TILE_SEEDED = 2;

@group(2) @binding(6) var<storage, read_write> tile_flags: array<atomic<u32>>;

fn flag_place(flag: i32, tile: vec2<i32>) -> i32 {
    return (flag * plane_group.tiles_y + tile.y) * plane_group.tiles_x + tile.x;
}

// The tile of a pixel of the images.
fn tile_of(at: vec2<i32>) -> vec2<i32> {
    return at / TILE;
}

fn set_flag(flag: i32, tile: vec2<i32>, value: u32) {
    let place = flag_place(flag, tile);
    if (atomicLoad(&tile_flags[place]) != value) {
        atomicStore(&tile_flags[place], value);
    }
}

// Whether a ray can still see what halos change at a pixel.
fn is_near_open(at: vec2<i32>) -> bool {
    return atomicLoad(&tile_flags[flag_place(TILE_NEAR, tile_of(at))]) != 0u;
}

// What is known of a tile.
struct TileState {
    // The last group of planes behind which a ray of the tile was open, and a ray that its seeds can reach.
    open: u32,
    open_near: u32,
    // The halo's last group whose seeds can reach the tile.
    seeded: u32,
}

var<workgroup> newest_flags: array<atomic<u32>, 2>;
var<workgroup> tile_found: TileState;

// The state of a tile, which all invocations of its workgroup find together.
fn tile_state(tile: vec2<i32>, halo: i32, own: i32) -> TileState {
    if (own < 2) {
        atomicStore(&newest_flags[own], 0u);
    }
    workgroupBarrier();
    let side = 2 * plane_group.tile_reach + 1;
    for (var i = own; i < side * side; i += TILE * TILE) {
        let other = tile - plane_group.tile_reach + vec2(i % side, i / side);
        if (all(other >= vec2(0)) && other.x < plane_group.tiles_x && other.y < plane_group.tiles_y) {
            atomicMax(&newest_flags[0], atomicLoad(&tile_flags[flag_place(TILE_OPEN, other)]));
            atomicMax(&newest_flags[1], atomicLoad(&tile_flags[flag_place(TILE_SEEDED + halo, other)]));
        }
    }
    workgroupBarrier();
    if (own == 0) {
        let open = atomicLoad(&tile_flags[flag_place(TILE_OPEN, tile)]);
        tile_found = TileState(open, atomicLoad(&newest_flags[0]), atomicLoad(&newest_flags[1]));
    }
    return workgroupUniformLoad(&tile_found);
}
