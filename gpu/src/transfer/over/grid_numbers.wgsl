// Numbers on grids beside the volume, trilinear between voxels ([STF-4]).
// Glue: Numbers on any grid.

@group(1) @binding(16) var<storage, read> grid_numbers: array<real>;

// Along x. On an axis of length 1 the second neighbour is the first, here and below.
fn along_row(first: i32, dims: vec3<i32>, cell: vec3<i32>, w: real) -> real {
    let row = first + (cell.z * dims.y + cell.y) * dims.x;
    return lerp(grid_numbers[row + cell.x], grid_numbers[row + min(cell.x + 1, dims.x - 1)], w);
}

// Three nested interpolations, along x, then y, then z, of a list that begins at `first`.
fn on_grid(first: i32, dims: vec3<i32>, at: Place) -> real {
    let c = at.cell;
    let up = min(c + vec3(1), dims - vec3(1));
    let near = lerp(along_row(first, dims, c, at.w.x), along_row(first, dims, vec3(c.x, up.y, c.z), at.w.x), at.w.y);
    let far = lerp(
        along_row(first, dims, vec3(c.x, c.y, up.z), at.w.x),
        along_row(first, dims, vec3(c.x, up.yz), at.w.x),
        at.w.y,
    );
    return lerp(near, far, at.w.z);
}
