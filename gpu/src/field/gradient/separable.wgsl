// The derivative of the kernel ([REC-2]).
// Glue: The gradient of samples by the kernel's taps.

fn index_gradient(at: Place) -> vec3<real> {
    return tensor_gradient(numbers, at.cell + vec3(NUMBERS_PAD), KERNEL_TAPS, taps_at(at));
}
