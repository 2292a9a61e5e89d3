// Bricks of cells without the value of the surface ([RAY-2]): a bit for each brick that can have it.
// Twin: reference/src/surface/active.rs

@group(1) @binding(23) var<storage, read> surface_bricks: array<u32>;

fn pass_brick(cell: vec3<i32>) -> i32 {
    let brick = cell / vec3(BRICK);
    let i = (brick.z * BRICKS_Y + brick.y) * BRICKS_X + brick.x;
    return select(BRICK, 0, (surface_bricks[i >> 5u] & (1u << u32(i & 31))) != 0u);
}
