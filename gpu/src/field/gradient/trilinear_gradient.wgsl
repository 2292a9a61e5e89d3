// The derivative of trilinear interpolation, which jumps between cells ([REC-2]).
// Twin: reference/src/field/kernel/trilinear.rs

// The difference of two rows along x, interpolated along x.
fn difference_of_numbers(down: vec3<i32>, up: vec3<i32>, wx: real) -> real {
    let x = vec3(1, 0, 0);
    return lerp(number_at(up) - number_at(down), number_at(up + x) - number_at(down + x), wx);
}

// The step along x of a row.
fn step_along_x(i: vec3<i32>) -> real {
    return number_at(i + vec3(1, 0, 0)) - number_at(i);
}

fn index_gradient(at: Place) -> vec3<real> {
    let c = at.cell;
    let y = c + vec3(0, 1, 0);
    let z = c + vec3(0, 0, 1);
    let yz = c + vec3(0, 1, 1);
    let w = at.w;
    return vec3<real>(
        lerp(lerp(step_along_x(c), step_along_x(y), w.y), lerp(step_along_x(z), step_along_x(yz), w.y), w.z),
        lerp(difference_of_numbers(c, y, w.x), difference_of_numbers(z, yz, w.x), w.z),
        lerp(difference_of_numbers(c, z, w.x), difference_of_numbers(y, yz, w.x), w.y),
    );
}
