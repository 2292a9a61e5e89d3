//! Bruckner and Gröller, VolumeShop: An Interactive System for Direct Volume Illustration, IEEE Visualization 2005.

use crate::number::BILINEAR;
use crate::shader::{Constant, Data, Shader, module};
use drypoint_scene::lighting::LightingTable;
use drypoint_scene::shot::{Lighting, LightingParams, Material, Shot};

/// The binding of the cells of a lighting table.
pub(crate) const LIGHTING: u32 = 24;

/// Adds the lighting function of samples. An iso-surface has a look of its own, and none is lit by one.
pub(crate) fn add_lighting(shader: &mut Shader, params: &LightingParams) {
    shader.add(&[BILINEAR, module!("lighting")]);
    shader.block.vector("light", params.light);
    shader.block.number("divisor_floor", params.divisor_floor);
    shader.constant("LIGHTING_WIDTH", Constant::Int(params.table.width() as i64));
    shader.constant("LIGHTING_HEIGHT", Constant::Int(params.table.height() as i64));
    shader.bind(LIGHTING, "the lighting table", Data::Reals(cells(&params.table)));
    shader.stages.shown.push("shade_by_table");
}

/// The cells of the shot's lighting table, which for light from the world depend on the camera; none without one.
pub(crate) fn lighting_cells(shot: &Shot) -> Option<Vec<f64>> {
    let [object] = &shot.objects;
    let Material::Regular(lit) = &object.material else { return None };
    match &lit.lighting {
        Lighting::Function(params) => Some(cells(&params.table)),
        Lighting::Flat | Lighting::Phong(_) | Lighting::Toon(_) => None,
    }
}

fn cells(table: &LightingTable) -> Vec<f64> {
    table.cells().as_flattened().to_vec()
}
