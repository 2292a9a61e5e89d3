// Trilinear interpolation, the papers' kernel, by the texture unit ([REC-1]).
// Twin: reference/src/field/kernel/trilinear.rs

// The value at a place.
fn value_at(at: Place) -> real {
    return between_voxels(numbers, position_of(at), NUMBERS_PAD);
}
