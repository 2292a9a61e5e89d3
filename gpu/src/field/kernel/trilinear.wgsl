// Trilinear interpolation, the papers' kernel ([REC-1]).
// Twin: reference/src/field/kernel/trilinear.rs

// The value at a place: three nested interpolations, along x, then y, then z.
fn value_at(at: Place) -> real {
    let c = at.cell;
    let a = lerp(number_at(c), number_at(c + vec3(1, 0, 0)), at.w.x);
    let b = lerp(number_at(c + vec3(0, 1, 0)), number_at(c + vec3(1, 1, 0)), at.w.x);
    let e = lerp(number_at(c + vec3(0, 0, 1)), number_at(c + vec3(1, 0, 1)), at.w.x);
    let f = lerp(number_at(c + vec3(0, 1, 1)), number_at(c + vec3(1, 1, 1)), at.w.x);
    return lerp(lerp(a, b, at.w.y), lerp(e, f, at.w.y), at.w.z);
}
