// Empty-space skipping of seeds ([RAY-2]): a bit for each brick in which a sample can seed.
// Glue: Samples that are passed over.

@group(1) @binding(33) var<storage, read> seed_bricks: array<u32>;

// The first plane from sample k on that is not inside a brick without seeds; k where its own brick can seed.
fn skip_seed_brick(ray: Ray, sample: Sample) -> i32 {
    let brick = sample.at.cell / vec3(BRICK);
    let i = (brick.z * BRICKS_Y + brick.y) * BRICKS_X + brick.x;
    if ((seed_bricks[i >> 5u] & (1u << u32(i & 31))) != 0u) {
        return sample.k;
    }
    // The way to the brick's farther side, less a little.
    var way = real(4.0e6);
    for (var axis = 0; axis < 3; axis++) {
        let d = ray.along[axis] * ray.depth_step;
        let side = real(BRICK * brick[axis] + select(0, BRICK, d > 0.0));
        if (abs(d) > 1.0e-20) {
            way = min(way, (side - sample.position[axis]) / d - 0.01);
        }
    }
    return sample.k + max(i32(ceil(way + sample.offset)), 1);
}
