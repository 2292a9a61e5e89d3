// The cell of a position, and the fractions within it ([REC-1], [SPACE-1]).
// Twin: reference/src/field/place.rs

struct Place {
    // min(floor(x), max(N - 2, 0)) on each axis.
    cell: vec3<i32>,
    // x - cell; 0 on an axis of length 1.
    w: vec3<real>,
}

// The place of a position inside the box.
fn locate(p: vec3<real>) -> Place {
    let cell = vec3<i32>(floor(min(max(p, vec3<real>()), last_cell())));
    return Place(cell, (p - vec3<real>(cell)) * long_axes());
}
