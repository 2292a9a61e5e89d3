//! The rules of the tables of a scene for its plan, one file a table: needs, keys without effect, knobs.

mod annotation;
mod camera;
mod clip;
mod contours;
mod halo;
mod hatching;
mod mesh;
mod object;
mod outlines;
mod pen;
mod picture;
mod sampling;
mod scene;
mod shading;
mod stipples;
mod style_mipmaps;
mod styles;
mod surface;
mod transfer;
mod volume;

pub use halo::halos_in_effect;

use super::{Asks, At, Idle, Ladder, Pass, Plan, Settings};
use crate::tables::Scene;

/// The rules of a table. Those of a list of tables run for each item.
pub(crate) struct Rules {
    /// The table's key, such as `contours`; empty for the top of the file.
    table: &'static str,
    /// The number of items, if the table is one of a list.
    items: Option<fn(&Scene) -> usize>,
    /// Asks for the needs of the table's effect.
    pub(super) asks: fn(&Scene, &mut Asks),
    /// Asks for the work that the table must do for the effects, after all effects have asked.
    pub(super) serves: fn(&Scene, &mut Asks),
    /// Lists the table's keys that have no effect beside their neighbours, given all that the plan needs.
    pub(super) idle: fn(&Scene, &Plan, &mut Idle),
    /// The table's keys that trade accuracy for time, with their settings ([COST-1]).
    pub(crate) knobs: &'static [(&'static str, Ladder)],
}

impl Rules {
    /// The rules of a table that asks nothing.
    const fn new(table: &'static str) -> Self {
        Self { table, items: None, asks: |_, _| {}, serves: |_, _| {}, idle: |_, _, _| {}, knobs: &[] }
    }
}

/// The rules of all tables that ask something, in the order of the file.
static ALL: [Rules; 22] = [
    scene::RULES,
    volume::RULES,
    clip::RULES,
    camera::RULES,
    picture::RULES,
    pen::RULES,
    sampling::RULES,
    transfer::RULES,
    styles::RULES,
    shading::RULES,
    contours::RULES,
    style_mipmaps::RULES,
    halo::RULES,
    object::COMBINE,
    object::RULES,
    object::INTERSECTION,
    stipples::RULES,
    hatching::RULES,
    outlines::RULES,
    surface::RULES,
    mesh::RULES,
    annotation::RULES,
];

/// The rules of the tables of a scene, those of a list of tables once for each item.
pub(crate) fn rules(scene: &Scene) -> impl Iterator<Item = (At, &'static Rules)> {
    ALL.iter().flat_map(|rules| {
        let single = rules.items.is_none().then(|| At { key: rules.table.into(), item: None });
        let count = rules.items.map_or(0, |items| items(scene));
        let items = (0..count).map(|i| At { key: format!("{}[{i}]", rules.table), item: Some(i) });
        single.into_iter().chain(items).map(move |at| (at, rules))
    })
}
