// The magnitude of the seed image's gradient ([HALO-4]).
// Twin: reference/src/volumetric_halos/gradient_image.rs

// Half the difference of two taps in x or in y, over q pixels on both sides.
fn difference_in(at: vec2<i32>, halo: i32, layer: i32, step: vec2<i32>, taps: HaloTaps) -> real {
    let near = step * taps.j;
    var d = seeds_at(at + near, halo, layer) - seeds_at(at - near, halo, layer);
    if (taps.f > 0.0) {
        let far = step * (taps.j + 1);
        let d_far = seeds_at(at + far, halo, layer) - seeds_at(at - far, halo, layer);
        d = (1.0 - taps.f) * d + taps.f * d_far;
    }
    return 0.5 * d;
}

// sqrt(dx^2 + dy^2), at most 1.
fn seed_gradient(at: vec2<i32>, halo: i32, layer: i32) -> real {
    let taps = taps_of(halo, 0);
    let dx = difference_in(at, halo, layer, vec2(1, 0), taps);
    let dy = difference_in(at, halo, layer, vec2(0, 1), taps);
    return min(sqrt(dx * dx + dy * dy), 1.0);
}

// H_0: the gradient of the seeds, or the seeds as they are; 0 beyond the border.
fn source_of(at: vec2<i32>, halo: i32, layer: i32) -> real {
    if (!is_in_image(at)) {
        return 0.0;
    }
    if (halos[halo].from_gradient == 1.0) {
        return seed_gradient(at, halo, layer);
    }
    return seeds_at(at, halo, layer);
}
