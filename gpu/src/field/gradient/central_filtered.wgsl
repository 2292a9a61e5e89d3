// Central differences on the voxels, then trilinear interpolation, by the texture unit: the difference of interpolated
// numbers a voxel before and a voxel after is that of the voxels, interpolated ([REC-2]).
// Twin: reference/src/field/gradient/central.rs

// Along one axis, given by its unit step.
fn difference_along(at: Place, step: vec3<real>) -> real {
    let p = position_of(at);
    return 0.5 * (between_voxels(voxels, p + step, VOXELS_PAD) - between_voxels(voxels, p - step, VOXELS_PAD));
}

// The gradient along the index axes.
fn central_gradient(at: Place) -> vec3<real> {
    return vec3<real>(
        difference_along(at, vec3<real>(1.0, 0.0, 0.0)),
        difference_along(at, vec3<real>(0.0, 1.0, 0.0)),
        difference_along(at, vec3<real>(0.0, 0.0, 1.0)),
    );
}
