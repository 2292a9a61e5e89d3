//! Reconstructions that cannot be.

/// A field that cannot be prepared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// `analytic` Hessians of a kernel that has no continuous second derivative ([REC-3]).
    #[error("hessian `analytic` needs a kernel that is twice differentiable; `{kernel}` is not, `bspline` is")]
    NotSmooth {
        /// Its name in a scene.
        kernel: &'static str,
    },
}
