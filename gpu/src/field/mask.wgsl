// Cells with a corner whose voxel is no number in the file ([PREC-2]): a bit for each, x fastest.
// Glue: A buffer.

@group(1) @binding(22) var<storage, read> masked_cells: array<u32>;

fn is_masked(cell: vec3<i32>) -> bool {
    let i = (cell.z * MASK_Y + cell.y) * MASK_X + cell.x;
    return (masked_cells[i >> 5u] & (1u << u32(i & 31))) != 0u;
}
