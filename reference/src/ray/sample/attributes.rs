//! The attributes of a visible sample, and directions that are constant along a ray.

use crate::number::{Real, Vec3};
use drypoint_scene::view::View;

/// The attributes of a visible sample beyond its value. Attributes that the scene does not need have neutral values.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SampleAttributes<R> {
    /// Eye depth.
    pub(crate) depth: R,
    /// World gradient, times the power of two of [SPACE-4].
    pub(crate) gradient: Vec3<R>,
    /// N in world space; none if the gradient is negligible ([PREC-3]) or not needed.
    pub(crate) normal: Option<Vec3<R>>,
    /// |g| of [VAL-2], in [0, 1].
    pub(crate) magnitude: R,
    /// The scene's κ; 0 if there is no normal.
    pub(crate) kappa: R,
    /// κ₁ and κ₂.
    pub(crate) principal: [R; 2],
}

impl<R: Real> SampleAttributes<R> {
    /// The attributes of a sample without a normal: κ = 0 ([PREC-3]).
    #[inline(always)]
    pub(crate) fn neutral() -> Self {
        let zero = R::ZERO;
        Self { depth: zero, gradient: Vec3::zero(), normal: None, magnitude: zero, kappa: zero, principal: [zero; 2] }
    }
}

/// Directions that are constant along a ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ViewDirs<R> {
    /// v, towards the eye, in world space.
    pub(crate) v: Vec3<R>,
    /// v in eye space.
    pub(crate) v_eye: Vec3<R>,
    /// Ĥ in world space if there is Phong shading, else 0.
    pub(crate) half: Vec3<R>,
}

/// The rows of the rotation from world to eye space, for directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EyeAxes<R>(pub(crate) [Vec3<R>; 3]);

impl<R: Real> EyeAxes<R> {
    /// The axes of a camera.
    pub(crate) fn new(view: &View) -> Self {
        Self([view.right, view.up, -view.forward].map(Vec3::from_glam))
    }

    /// N in eye space. A sample without a normal has N = v ([PREC-3]).
    #[inline]
    pub(crate) fn normal(&self, attributes: &SampleAttributes<R>, dirs: &ViewDirs<R>) -> Vec3<R> {
        attributes.normal.map_or(dirs.v_eye, |n| Vec3::new(n.dot(self.0[0]), n.dot(self.0[1]), n.dot(self.0[2])))
    }
}
