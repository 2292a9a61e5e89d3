//! Rules of `[camera]`: needs, keys without effect, knobs.

use super::Rules;
use crate::tables::Projection;

/// The rules of `[camera]`.
pub(super) const RULES: Rules = Rules {
    idle: |scene, _, idle| {
        let camera = &scene.camera;
        match camera.projection {
            Projection::Perspective { .. } => idle.key("camera.height", "the camera is perspective: fov counts"),
            Projection::Orthographic { .. } => {
                idle.key("camera.fov", "the camera is orthographic: height counts");
                idle.key("camera.near", "the camera is orthographic: depths have any sign");
            }
        }
        if camera.eye.is_some() && camera.direction_given && scene.orbit.is_none() {
            idle.key("camera.target", "eye and direction say where the camera looks");
        }
    },
    ..Rules::new("camera")
};
