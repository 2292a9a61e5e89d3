// Sums of layers that go on from plane to plane.
// Glue: Sums of layers.

fn sums_go_on() {
    ray_sums.is_met = ray_sums.first.depth < NOWHERE;
}
