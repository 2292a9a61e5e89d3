//! The meshes of a picture ([VS-12]).

use super::Illumination;
use crate::tables::{MeshTable, Scene};
use crate::view::View;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// An opaque mesh, at which rays end. Its triangles are data beside the shot, in the world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshParams {
    /// The file.
    pub file: PathBuf,
    /// Its colour, linear.
    pub rgb: [f64; 3],
    /// How the colour is lit.
    pub lit: Illumination,
}

impl MeshParams {
    /// The meshes of a scene.
    pub(super) fn all(scene: &Scene, view: &View) -> Vec<Self> {
        let lit = Illumination::of_mesh(scene, view);
        let mesh = |mesh: &MeshTable| {
            let [r, g, b, _] = mesh.color;
            Self { file: mesh.file.clone(), rgb: [r, g, b], lit: lit.clone() }
        };
        scene.meshes.iter().map(mesh).collect()
    }
}
