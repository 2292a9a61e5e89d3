// Catmull-Rom: interpolates the voxels, exact for quadratics ([REC-1]).
// Twin: reference/src/field/kernel/catmull_rom.rs

const KERNEL_TAPS = 4;

// The pieces of the kernel from outside in, and their derivatives. Second ones jump and are no estimate ([REC-3]).
fn catmull_rom_outer(t: real) -> real {
    return -(0.5 * t * t * (1.0 - t));
}

fn catmull_rom_inner(t: real) -> real {
    return 0.5 * t * (1.0 + t * (4.0 - 3.0 * t));
}

fn catmull_rom_outer_first(t: real) -> real {
    return 0.5 * t * (3.0 * t - 2.0);
}

fn catmull_rom_inner_first(t: real) -> real {
    return 0.5 + t * (4.0 - 4.5 * t);
}

// Weights of samples -1 ... 2 for 0 <= t <= 1.
fn kernel_taps(t: real) -> Taps {
    let u = 1.0 - t;
    let zero = real(0.0);
    return Taps(
        array<real, 6>(
            catmull_rom_outer(u), catmull_rom_inner(u), catmull_rom_inner(t), catmull_rom_outer(t), zero, zero,
        ),
        array<real, 6>(
            -catmull_rom_outer_first(u),
            -catmull_rom_inner_first(u),
            catmull_rom_inner_first(t),
            catmull_rom_outer_first(t),
            zero,
            zero,
        ),
        array<real, 6>(),
    );
}
