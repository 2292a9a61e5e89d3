//! Selections that follow the camera by their interaction states ([VS-9]).

use crate::camera::number;
use crate::document::Edit;
use crate::key::KeyPath;
use drypoint::scene::glam::DVec3;
use drypoint::scene::tables::{InteractionState, Motion, Scene};
use drypoint::scene::view::View;
use toml_edit::{Array, Value};

/// Returns the edits by which the selections of a scene take M', the motion for the second view in place of M for the
/// first. `boxes` are the corners of what the objects select, before it is moved; what is empty stays.
pub(crate) fn edits(scene: &Scene, boxes: &[Option<[DVec3; 8]>], views: [&View; 2]) -> Vec<Edit> {
    let mut edits = Vec::new();
    for (i, (object, corners)) in scene.objects.iter().zip(boxes).enumerate() {
        let Some(corners) = corners.filter(|_| object.interaction != InteractionState::Integrated) else { continue };
        let centre = corners.iter().sum::<DVec3>() / 8.0;
        let moved = Motion::of(object.interaction.motion(object.motion.map(centre), centre, views));
        let key = KeyPath::from("object").item(i);
        edits.extend(["move", "scale", "rotate", "center"].map(|name| Edit::remove(key.name(name))));
        let row = |row: [f64; 4]| Value::Array(row.into_iter().map(number).collect::<Array>());
        let rows = moved.matrix.into_iter().flatten().map(row).collect::<Array>();
        edits.push(Edit::set(key.name("matrix"), Value::Array(rows)));
    }
    edits
}
