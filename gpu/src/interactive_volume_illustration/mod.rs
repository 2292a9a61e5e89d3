//! Nagy, Schneider, Westermann, *Interactive Volume Illustration*, VMV 2002.

use crate::module::module;
use crate::shader::{Constant, Data, Shader};
use crate::shading::LitColors;
use drypoint_scene::shot::{Tone, ToonParams};

/// The binding of tones.
const TONES: u32 = 6;

/// Numbers of a tone.
const TONE: usize = 4;

/// Adds tones with hard steps. The tones of an iso-surface follow those of samples.
pub(crate) fn add_toon(shader: &mut Shader, toon: &ToonParams, of: LitColors) {
    shader.add(&[module!("toon")]);
    shader.block.vector(of.light(), toon.light);
    shader.block.number(of.number("toon_offset"), toon.offset);
    let tone = |tone: &Tone| [tone.at, tone.color[0], tone.color[1], tone.color[2]];
    let numbers: Vec<f64> = toon.tones.iter().flat_map(tone).collect();
    let before = shader.data.iter_mut().find_map(|(binding, _, data)| match data {
        Data::Reals(before) if *binding == TONES => Some(before),
        _ => None,
    });
    let first = before.as_ref().map_or(0, |before| before.len() / TONE);
    let end = Constant::Int((first + toon.tones.len()) as i64);
    match before {
        Some(before) => before.extend(numbers),
        None => shader.bind(TONES, "the tones", Data::Reals(numbers)),
    }
    match of {
        LitColors::Samples => {
            shader.add(&[module!("toon_of_samples")]);
            shader.constant("TONES", end);
        }
        LitColors::Surface => {
            shader.add(&[module!("toon_of_surface")]);
            shader.constant("FIRST_SURFACE_TONE", Constant::Int(first as i64));
            shader.constant("SURFACE_TONES", end);
        }
    }
    of.push(shader, ["shade_toon", "shade_surface_by_toon"]);
}

/// Adds black silhouettes, with the offset of their test.
pub(crate) fn add_silhouette(shader: &mut Shader, offset: f64, of: LitColors) {
    shader.add(&[module!("silhouette")]);
    shader.block.number(of.number("silhouette_offset"), offset);
    shader.add(&[match of {
        LitColors::Samples => module!("silhouette_of_samples"),
        LitColors::Surface => module!("silhouette_of_surface"),
    }]);
    of.push(shader, ["shade_silhouette", "shade_surface_silhouette"]);
}

/// Adds view-dependent opacity of a strength.
pub(crate) fn add_view_opacity(shader: &mut Shader, strength: f64) {
    shader.add(&[module!("view_opacity")]);
    shader.block.number("view_opacity", strength);
    shader.stages.lit.push("grow_opacity");
}
