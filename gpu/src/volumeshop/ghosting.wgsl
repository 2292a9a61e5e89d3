// Ghosting: how far the background before an object fades (6.2; [VS-7]).
// Twin: reference/src/volumeshop/ghosting.rs

// max(0, 1 - gamma (2 - e)).
fn ghosting_factor(gamma: real, enhancement: real) -> real {
    return max(1.0 - gamma * (2.0 - enhancement), 0.0);
}

// e = 1 - min(1, s_alpha + (1 - |N|)): the enhancement of a sample whose opacity eq. 8 enhances by s_alpha.
fn enhancement_of(s_alpha: real, magnitude: real) -> real {
    return 1.0 - min(s_alpha + (1.0 - magnitude), 1.0);
}
