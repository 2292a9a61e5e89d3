//! Nagy, Schneider, Westermann, *Interactive Volume Illustration*, VMV 2002.

use crate::shader::{Constant, Data, Shader, module};
use drypoint_scene::shot::ToonParams;

/// Adds tones with hard steps.
pub(crate) fn add_toon(shader: &mut Shader, toon: &ToonParams) {
    shader.add(&[module!("toon")]);
    shader.block.vector("light", toon.light);
    shader.block.number("toon_offset", toon.offset);
    shader.constant("TONES", Constant::Int(toon.tones.len() as i64));
    let tone = |tone: &drypoint_scene::shot::Tone| [tone.at, tone.color[0], tone.color[1], tone.color[2]];
    shader.bind(6, "the tones", Data::Reals(toon.tones.iter().flat_map(tone).collect()));
    shader.stages.shown.push("shade_toon");
}

/// Adds black silhouettes, by the offset of their test.
pub(crate) fn add_silhouette(shader: &mut Shader, offset: f64) {
    shader.add(&[module!("silhouette")]);
    shader.block.number("silhouette_offset", offset);
    shader.stages.shown.push("shade_silhouette");
}

/// Adds view-dependent opacity of a strength.
pub(crate) fn add_view_opacity(shader: &mut Shader, strength: f64) {
    shader.add(&[module!("view_opacity")]);
    shader.block.number("view_opacity", strength);
    shader.stages.shown.push("grow_opacity");
}
