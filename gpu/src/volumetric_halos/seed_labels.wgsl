// h_l: 1 for samples of a halo's labels, else 0 (3.1, [HALO-2]).
// Twin: reference/src/volumetric_halos/seed.rs

@group(1) @binding(32) var<storage, read> seed_labels: array<u32>;

fn by_label(halo: i32, sample: Sample, h: real) -> real {
    let first = i32(halos[halo].first_label);
    let count = i32(halos[halo].labels);
    if (count < 0 || !(h > 0.0)) {
        return h;
    }
    let label = label_at(sample.position);
    for (var i = 0; i < count; i++) {
        if (seed_labels[first + i] == label) {
            return h;
        }
    }
    return 0.0;
}
