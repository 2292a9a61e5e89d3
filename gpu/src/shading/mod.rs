//! Blinn–Phong shading ([STF-11]), and the kinds of colours that are lit.

use crate::module::module;
use crate::number::{ELEMENTARY, NUMBER};
use crate::shader::{Constant, Shader};
use drypoint_scene::shot::PhongParams;

/// Colours with a light of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LitColors {
    /// Colours of samples of the volume.
    Samples,
    /// The colour of an iso-surface.
    Surface,
}

impl LitColors {
    /// The name of a number of the light.
    pub(crate) fn number(self, name: &str) -> String {
        match self {
            Self::Samples => name.to_owned(),
            Self::Surface => format!("surface_{name}"),
        }
    }

    /// The name of the direction to the light.
    pub(crate) fn light(self) -> &'static str {
        match self {
            Self::Samples => "light",
            Self::Surface => "surface_light",
        }
    }

    /// Adds the stage that shades these colours.
    pub(crate) fn push(self, shader: &mut Shader, [samples, surface]: [&'static str; 2]) {
        match self {
            Self::Samples => shader.stages.lit.push(samples),
            Self::Surface => shader.stages.on_surface.push(surface),
        }
    }
}

/// The name of the direction to the light of meshes.
pub(crate) const MESH_LIGHT: &str = "mesh_light";

/// Adds the reflection of light on meshes.
pub(crate) fn add_to_meshes(shader: &mut Shader, phong: &PhongParams) {
    let is_whole = add_phong(shader, phong, MESH_LIGHT, |name| format!("mesh_{name}"));
    shader.add(&[module!("shading_of_meshes")]);
    shader.constant("MESH_WHOLE_SHININESS", is_whole);
}

/// Adds Blinn–Phong with numbers of these names. Returns whether the shininess is a small integer.
fn add_phong(shader: &mut Shader, phong: &PhongParams, light: &'static str, name: impl Fn(&str) -> String) -> Constant {
    shader.add(&[NUMBER, ELEMENTARY, module!("shading")]);
    let (block, s) = (&mut shader.block, phong.shininess);
    block.vector(light, phong.light);
    for (key, value) in
        [("ambient", phong.ambient), ("diffuse", phong.diffuse), ("specular", phong.specular), ("shininess", s)]
    {
        block.number(name(key), value);
    }
    Constant::Bool(s.fract() == 0.0 && (0.0..=64.0).contains(&s))
}

/// Adds the reflection of light.
pub(crate) fn add(shader: &mut Shader, phong: &PhongParams, of: LitColors) {
    let is_whole = add_phong(shader, phong, of.light(), |name| of.number(name));
    match of {
        LitColors::Samples => {
            shader.add(&[module!("shading_of_samples")]);
            shader.constant("WHOLE_SHININESS", is_whole);
        }
        LitColors::Surface => {
            shader.add(&[module!("shading_of_surface")]);
            shader.constant("SURFACE_WHOLE_SHININESS", is_whole);
        }
    }
    of.push(shader, ["shade_phong", "shade_surface_by_phong"]);
}
