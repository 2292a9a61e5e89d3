//! `[camera]`: from where the volume is seen ([RAY-5], [RAY-6]).

use crate::tables::Length;
use glam::DVec3;

/// The table `[camera]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Perspective or orthographic.
    pub projection: Projection,
    /// The way the camera looks, any length; used where `eye` is none.
    pub direction: DVec3,
    /// Where the camera stands, in world space; none: [RAY-5]'s default from `direction`.
    pub eye: Option<DVec3>,
    /// Whether the scene gave `direction` itself: with `eye`, it then replaces `target`.
    pub direction_given: bool,
    /// What the camera looks at, in world space; none: the centre of the volume's box.
    pub target: Option<DVec3>,
    /// Up in the picture.
    pub up: DVec3,
    /// Smallest eye depth of a sample, perspective; none: the step.
    pub near: Option<Length>,
}

/// How points are projected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Through the eye.
    Perspective {
        /// Vertical field of view in degrees.
        fov: f64,
    },
    /// Along parallel rays.
    Orthographic {
        /// World units from the bottom to the top of the picture; none: [RAY-5]'s default.
        height: Option<f64>,
    },
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            projection: Projection::Perspective { fov: 30.0 },
            direction: DVec3::new(-1.0, -0.4, -0.3),
            eye: None,
            direction_given: false,
            target: None,
            up: DVec3::Z,
            near: None,
        }
    }
}
