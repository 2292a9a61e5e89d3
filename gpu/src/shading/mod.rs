//! Blinn–Phong shading ([STF-11]).

use crate::number::ELEMENTARY;
use crate::shader::{Constant, Shader, module};
use drypoint_scene::shot::PhongParams;

/// Adds the reflection of light.
pub(crate) fn add(shader: &mut Shader, phong: &PhongParams) {
    shader.add(&[ELEMENTARY, module!("phong")]);
    let block = &mut shader.block;
    block.vector("light", phong.light);
    block.number("ambient", phong.ambient);
    block.number("diffuse", phong.diffuse);
    block.number("specular", phong.specular);
    block.number("shininess", phong.shininess);
    let s = phong.shininess;
    shader.constant("WHOLE_SHININESS", Constant::Bool(s.fract() == 0.0 && (0.0..=64.0).contains(&s)));
    shader.stages.shown.push("shade_phong");
}
