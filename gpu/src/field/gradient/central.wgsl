// Central differences on the voxels, then trilinear interpolation: the papers' gradient ([REC-2]).
// Twin: reference/src/field/gradient/central.rs

// The difference of two rows at the two corners of a cell, interpolated along x.
fn difference_of_rows(down: vec3<i32>, up: vec3<i32>, wx: real) -> real {
    let x = vec3(1, 0, 0);
    return lerp(voxel_at(up) - voxel_at(down), voxel_at(up + x) - voxel_at(down + x), wx);
}

// Along one axis, given by its unit step, at the four edges of the cell that run along x.
fn difference_along(at: Place, step: vec3<i32>) -> real {
    let c = at.cell;
    let a = difference_of_rows(c - step, c + step, at.w.x);
    let b = difference_of_rows(c + vec3(0, 1, 0) - step, c + vec3(0, 1, 0) + step, at.w.x);
    let e = difference_of_rows(c + vec3(0, 0, 1) - step, c + vec3(0, 0, 1) + step, at.w.x);
    let f = difference_of_rows(c + vec3(0, 1, 1) - step, c + vec3(0, 1, 1) + step, at.w.x);
    return 0.5 * lerp(lerp(a, b, at.w.y), lerp(e, f, at.w.y), at.w.z);
}

// The gradient along the index axes.
fn central_gradient(at: Place) -> vec3<real> {
    return vec3<real>(
        difference_along(at, vec3(1, 0, 0)),
        difference_along(at, vec3(0, 1, 0)),
        difference_along(at, vec3(0, 0, 1)),
    );
}
