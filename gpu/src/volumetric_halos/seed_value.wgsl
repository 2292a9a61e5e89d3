// h_v: the opacity, or a piecewise-linear function over the value ([HALO-2]).
// Twin: reference/src/volumetric_halos/seed.rs

// The function of a halo's nodes: at, width to the next one, h, h of the next one. Beyond the nodes the end nodes hold, and
// of several nodes at one value the last.
fn nodes_at(halo: i32, s: real) -> real {
    let first = i32(halos[halo].first_node);
    let count = i32(halos[halo].nodes);
    // The number of nodes at or below the value.
    var below = 0;
    while (below < count && halo_numbers[first + 4 * below] <= s) {
        below++;
    }
    let at = first + 4 * max(below - 1, 0);
    if (below == 0 || below == count) {
        return halo_numbers[at + 2];
    }
    return lerp(halo_numbers[at + 2], halo_numbers[at + 3], (s - halo_numbers[at]) / halo_numbers[at + 1]);
}

fn by_value(halo: i32, sample: Sample, h: real) -> real {
    if (halos[halo].value == 1.0) {
        return h * seed_alpha_u;
    }
    if (halos[halo].value == 2.0) {
        return h * nodes_at(halo, sample.s);
    }
    return h;
}
