// The value of a further volume some of whose voxels are no numbers ([STF-4], [PREC-2]).
// Twin: reference/src/transfer/over/other_volume.rs

// Cells that touch such a voxel: a bit for each, x fastest, of one volume after the other.
@group(1) @binding(17) var<storage, read> further_masks: array<u32>;

// The value, counted from the lowest of the volume, which holds outside its box and in masked cells. `mask` is the first
// word of the volume's mask.
fn further_value_unmasked(first: i32, dims: vec3<i32>, mask: i32, position: vec3<real>) -> real {
    let place = further_place(first, dims, position);
    if (!place.is_there) {
        return 0.0;
    }
    let c = place.at.cell;
    let i = (c.z * dims.y + c.y) * dims.x + c.x;
    if ((further_masks[mask + (i >> 5u)] & (1u << u32(i & 31))) != 0u) {
        return 0.0;
    }
    return on_grid(first + 12, dims, place.at);
}
