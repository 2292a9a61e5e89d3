// Values by a kernel that weighs numbers along each axis ([REC-1]).
// Glue: The value of samples by the kernel's taps.

// The kernel's taps at a place, for each axis.
fn taps_at(at: Place) -> array<Taps, 3> {
    return array<Taps, 3>(kernel_taps(at.w.x), kernel_taps(at.w.y), kernel_taps(at.w.z));
}

// The value at a place.
fn value_at(at: Place) -> real {
    return tensor_value(numbers, at.cell + vec3(NUMBERS_PAD), KERNEL_TAPS, taps_at(at));
}
