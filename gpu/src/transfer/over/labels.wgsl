// Ids of the voxels of a label volume, as many in a word as fit ([STF-13]).
// Twin: reference/src/labels.rs

@group(1) @binding(15) var<storage, read> label_words: array<u32>;

fn label_of_voxel(i: i32) -> u32 {
    let in_word = 32 / LABEL_BITS;
    return extractBits(label_words[i / in_word], u32((i % in_word) * LABEL_BITS), u32(LABEL_BITS));
}

// The place of a position on the labels' own grid, inside its box.
fn label_place(p: vec3<real>) -> Place {
    let cell = vec3<i32>(floor(min(max(p, vec3<real>()), label_last_cell())));
    return Place(cell, (p - vec3<real>(cell)) * label_long_axes());
}

// The voxel at the lower corner of a cell.
fn label_voxel(cell: vec3<i32>) -> i32 {
    return (cell.z * LABELS_Y + cell.y) * LABELS_X + cell.x;
}

// From a voxel to its neighbours along x, y and z in linear order; 0 on an axis of length 1.
fn label_strides() -> vec3<i32> {
    return vec3(1, LABELS_X, LABELS_X * LABELS_Y) * vec3<i32>(label_long_axes());
}
