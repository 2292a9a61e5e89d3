// Empty-space skipping ([RAY-2]): how far each brick of 4 x 4 x 4 cells is from the next one that can show something, in
// bricks, a byte each. All bricks that are closer on every axis show nothing.
// Twin: reference/src/ray/brick_occupancy.rs

@group(1) @binding(5) var<storage, read> bricks: array<u32>;

// The first plane from sample k on that is not inside bricks that show nothing; k where its own brick shows something.
fn skip_brick(ray: Ray, sample: Sample) -> i32 {
    let brick = sample.at.cell / vec3(BRICK);
    let i = (brick.z * BRICKS_Y + brick.y) * BRICKS_X + brick.x;
    let far = i32((bricks[i >> 2u] >> u32(8 * (i & 3))) & 255u);
    if (far == 0) {
        return sample.k;
    }
    // The way to the farther sides of those bricks, less a little.
    let d = ray.along * ray.depth_step;
    let side = BRICK * (brick + select(vec3(1 - far), vec3(far), d > vec3<real>()));
    let parallel = abs(d) <= vec3<real>(1.0e-20);
    let way = select((vec3<real>(side) - sample.position) / d, vec3<real>(4.0e6), parallel);
    return sample.k + max(i32(ceil(min(way.x, min(way.y, way.z)) + sample.offset - 0.01)), 1);
}
