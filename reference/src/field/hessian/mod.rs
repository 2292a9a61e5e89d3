//! The Hessian estimators of [REC-3] that are not a kernel's own derivative, one file each.

pub(super) mod central;
pub(super) mod gaussian;
