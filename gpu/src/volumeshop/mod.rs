//! Bruckner and Gröller, VolumeShop: An Interactive System for Direct Volume Illustration, IEEE Visualization 2005.

pub(crate) mod funnel;
pub(crate) mod objects;
pub(crate) mod part;
pub(crate) mod selection;

use crate::module::{Module, module};
use crate::number::BILINEAR;
use crate::shader::{Constant, Data, Shader};
use drypoint_scene::lighting::LightingTable;
use drypoint_scene::shot::{
    Combination, Cut, Cutaway, Lighting, LightingParams, Material, Membership, Object, SelectionParams, Shot,
};

/// The binding of the cells of a lighting table.
const LIGHTING: u32 = 24;

/// A ray among objects.
pub(crate) const CAST_AMONG: &[Module] = &[module!("spans"), module!("cast_among")];

/// Adds the lighting function of samples. An iso-surface has its own light, which is never a lighting function.
pub(crate) fn add_lighting(shader: &mut Shader, params: &LightingParams) {
    shader.add(&[BILINEAR, module!("lighting")]);
    shader.block.vector("light", params.light);
    shader.block.number("divisor_floor", params.divisor_floor);
    let table = params.source.table();
    shader.constant("LIGHTING_WIDTH", Constant::Int(table.width() as i64));
    shader.constant("LIGHTING_HEIGHT", Constant::Int(table.height() as i64));
    shader.bind(LIGHTING, "the lighting table", Data::Lighting(cells(&table)));
    shader.stages.lit.push("shade_by_table");
}

/// The cells of the lighting tables of objects. For light from the world they depend on the camera.
pub(crate) fn lighting_cells<'o>(objects: impl Iterator<Item = &'o Object>) -> Vec<Vec<f64>> {
    let tables = objects.filter_map(|object| match &object.material {
        Material::Regular(lit) => match &lit.lighting {
            Lighting::Function(params) => Some(cells(&params.source.table())),
            Lighting::Flat | Lighting::Phong(_) | Lighting::Toon(_) => None,
        },
        Material::Style(_) => None,
    });
    tables.collect()
}

/// Whether a selection can have members.
pub(crate) fn has_members(selection: &SelectionParams) -> bool {
    selection.index_box.is_some() || matches!(selection.membership, Membership::Value(_))
}

/// The cutaways of a shot that have a depth.
pub(crate) fn cutaways(combination: &Combination) -> impl Iterator<Item = &Cutaway> {
    combination.cutaways.iter().filter(|cutaway| {
        let selection = &combination.selections[combination.parts[cutaway.part].object];
        has_members(selection) && (cutaway.cut == Cut::Object || selection.index_box.is_some())
    })
}

/// Whether a shot has a smooth cutaway.
pub(crate) fn has_funnel(shot: &Shot) -> bool {
    shot.combination.iter().flat_map(cutaways).any(|cutaway| cutaway.funnel > 0.0)
}

fn cells(table: &LightingTable) -> Vec<f64> {
    table.cells().as_flattened().to_vec()
}
