//! Blinn–Phong shading ([STF-11]), and the colours that light falls on.

use crate::number::ELEMENTARY;
use crate::shader::{Constant, Shader, module};
use drypoint_scene::shot::PhongParams;

/// Colours under a light of their own.
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

/// Adds the reflection of light.
pub(crate) fn add(shader: &mut Shader, phong: &PhongParams, of: LitColors) {
    shader.add(&[ELEMENTARY, module!("phong")]);
    let block = &mut shader.block;
    block.vector(of.light(), phong.light);
    block.number(of.number("ambient"), phong.ambient);
    block.number(of.number("diffuse"), phong.diffuse);
    block.number(of.number("specular"), phong.specular);
    block.number(of.number("shininess"), phong.shininess);
    let s = phong.shininess;
    let is_whole = Constant::Bool(s.fract() == 0.0 && (0.0..=64.0).contains(&s));
    match of {
        LitColors::Samples => {
            shader.add(&[module!("phong_of_samples")]);
            shader.constant("WHOLE_SHININESS", is_whole);
        }
        LitColors::Surface => {
            shader.add(&[module!("phong_of_surface")]);
            shader.constant("SURFACE_WHOLE_SHININESS", is_whole);
        }
    }
    of.push(shader, ["shade_phong", "shade_surface_by_phong"]);
}
