//! The gradient estimators of [REC-2] that read the voxels, one file each. Each gives its estimate in index space and
//! in stored units: interpolated, trilinear, from the estimates at the corners of the cell. The fourth, `analytic`, is
//! the derivative that each kernel has in its own file.

pub(super) mod central;
pub(super) mod regression;
pub(super) mod sobel;
