//! `[camera]`: from where the volume is seen ([RAY-5], [RAY-6]).

use crate::document::declare::{choices, table};
use crate::document::describe::Table;
use crate::document::fault::Problem;
use crate::document::kind::{Bounds, Number, Numbers, Rule, WORLD_LENGTH};
use crate::tables::Length;
use glam::DVec3;

table! {
    /// The table `[camera]`.
    ///
    /// `direction` is read after `eye`: without `eye`, whether it was given says nothing.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Camera {
        /// Projection of points.
        projection: Projection = Projection::Perspective { fov: FOV }, key("RAY-6", Projected::KIND,
            |c| {
                Some(match c.projection {
                    Projection::Perspective { .. } => Projected::Perspective,
                    Projection::Orthographic { .. } => Projected::Orthographic,
                })
            },
            |c, projected| {
                c.projection = match projected {
                    Projected::Perspective => Projection::Perspective { fov: FOV },
                    Projected::Orthographic => Projection::Orthographic { height: None },
                }
            });
        /// Vertical field of view in degrees; perspective.
        fov: key("RAY-6", Number { bounds: Bounds::between(0.0, 180.0), unit: ", in degrees" },
            |c| match c.projection {
                Projection::Perspective { fov } => Some(fov),
                Projection::Orthographic { .. } => None,
            },
            |c, v| {
                if let Projection::Perspective { fov } = &mut c.projection {
                    *fov = v;
                }
            });
        /// From the bottom to the top of the picture; orthographic.
        height: key("RAY-5", WORLD_LENGTH,
            |c| match c.projection {
                Projection::Perspective { .. } => None,
                Projection::Orthographic { height } => height,
            },
            |c, v| {
                if let Projection::Orthographic { height } = &mut c.projection {
                    *height = Some(v);
                }
            }).absent("what shows the whole box of the volume");
        /// Place of the camera, in world space. With `direction` beside it, `target` is unused.
        eye: Option<DVec3> = None, key("RAY-5", POINT).absent("so far from the target that the whole box is seen");
        /// Whether the scene gave `direction` beside `eye`: it then replaces `target`. False without `eye`.
        direction_given: bool = false;
        /// The way the camera looks, in world space, of any length.
        direction: DVec3 = DVec3::new(-1.0, -0.4, -0.3), key("RAY-5", DIRECTION,
            |c| (c.eye.is_none() || c.direction_given).then(|| c.direction.to_array()),
            |c, v| {
                c.direction = DVec3::from_array(v);
                c.direction_given = c.eye.is_some();
            });
        /// Point that the camera looks at, in world space.
        target: Option<DVec3> = None, key("RAY-5", POINT).absent("the centre of the volume's box");
        /// Up in the picture, in world space.
        up: DVec3 = DVec3::Z, key("RAY-6", DIRECTION);
        /// Smallest eye depth of a sample; perspective.
        near: Option<Length> = None, key("RAY-1", WORLD_LENGTH).absent("`sampling.step`");
    }
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
        /// From the bottom to the top of the picture, in the world; none: [RAY-5]'s default.
        height: Option<Length>,
    },
}

choices! {
    /// `projection` without its parameters.
    #[derive(Clone, Copy, PartialEq)]
    enum Projected {
        /// Through the eye.
        Perspective = "perspective",
        /// Along parallel rays.
        Orthographic = "orthographic",
    }
}

/// Vertical field of view of a first picture, in degrees.
const FOV: f64 = 30.0;

/// A point in world space.
const POINT: Numbers<3> = Numbers { what: "a point [x, y, z]", bounds: Bounds::ANY, rule: Rule::Free };

/// A direction in world space, of any length.
const DIRECTION: Numbers<3> = Numbers { what: "a direction [x, y, z]", bounds: Bounds::ANY, rule: Rule::Direction };

/// The description of `[camera]`.
pub(crate) static TABLE: Table<Camera> = Table {
    check: |camera, check| {
        if !camera.direction_given && camera.eye.is_some() && camera.eye == camera.target {
            check.fault_in(
                "eye",
                Problem::Contradiction {
                    what: "camera.eye and camera.target are one point".into(),
                    remedy: "move one of them, or give camera.direction".into(),
                },
            );
        }
    },
    ..Camera::description("[camera]", "From where the volume is seen: along `direction` at the target, or from `eye`.")
};
