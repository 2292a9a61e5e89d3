// The kernel's own derivatives ([REC-3]).
// Glue: The Hessian of samples by the kernel's taps.

fn index_second(at: Place) -> Second {
    return tensor_second(numbers, at.cell + vec3(NUMBERS_PAD), KERNEL_TAPS, taps_at(at));
}
