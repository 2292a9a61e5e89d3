// The id with the highest sum of trilinear weights among the eight voxels around ([STF-13]).
// Twin: reference/src/labels.rs

// Of equal sums, the smallest id holds.
fn label_on_grid(p: vec3<real>) -> u32 {
    let at = label_place(p);
    let start = label_voxel(at.cell);
    let stride = label_strides();
    let rest = vec3<real>(1.0) - at.w;
    var ids: array<u32, 8>;
    var weights: array<real, 8>;
    for (var c = 0; c < 8; c++) {
        let upper = vec3(c & 1, (c >> 1u) & 1, c >> 2u);
        ids[c] = label_of_voxel(start + dot(upper, stride));
        let w = select(rest, at.w, upper == vec3(1));
        weights[c] = w.x * w.y * w.z;
    }
    var highest = real(-1.0);
    var best = 0xffffffffu;
    for (var i = 0; i < 8; i++) {
        var sum = real(0.0);
        for (var c = 0; c < 8; c++) {
            sum += select(real(0.0), weights[c], ids[c] == ids[i]);
        }
        if (sum > highest || (sum == highest && ids[i] < best)) {
            highest = sum;
            best = ids[i];
        }
    }
    return best;
}
