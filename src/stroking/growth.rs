//! Settings of growing strokes: the table of hatching in world units.

use super::lengths::in_world;
use crate::Failure;
use drypoint_reference::interactive_volume_illustration as room;
use drypoint_scene::space::Grid;
use drypoint_scene::tables::{
    DirectionRule, Family, Hatching as Table, Interpolate, LineLighting, Reference, Scene, StoredAt,
};

/// Least `chord`, in voxels. The number of a stroke's vertices grows with 1/√chord, and a default stroke has some 600
/// there.
const LEAST_CHORD: f64 = 1e-4;

/// Least `min_step`, in voxels. A stroke of 30 voxels takes up to ten million steps there.
const LEAST_STEP: f64 = 1e-6;

/// Converts the table to world units.
pub(super) fn growth_settings(scene: &Scene, table: &Table, grid: &Grid) -> Result<room::HatchParams, Failure> {
    let length = |length, key: &str| in_world(scene, length, &format!("hatching.{key}"), grid);
    let directions = &table.directions;
    // Lengths so small that strokes would not end are refused.
    let chord = length(table.chord, "chord")?;
    if chord < LEAST_CHORD * grid.voxel() {
        let what = format!("hatching.chord is below {LEAST_CHORD} voxels, where strokes have no end of vertices");
        let place = scene.given.position("hatching.chord");
        return Err(Failure::new(what, place, format!("write \"{LEAST_CHORD} voxels\" or more")));
    }
    let min_step = length(table.min_step, "min_step")?;
    if min_step < LEAST_STEP * grid.voxel() {
        let steps = length(table.length, "length")? / min_step;
        let what = format!("hatching.min_step is below {LEAST_STEP} voxels, and a stroke could take {steps:.1e} steps");
        let place = scene.given.position("hatching.min_step");
        return Err(Failure::new(what, place, format!("write \"{LEAST_STEP} voxels\" or more")));
    }
    let axis = directions.axis.unwrap_or_else(|| room::longest_axis(grid));
    let center = directions.center.unwrap_or_else(|| grid.centre());
    Ok(room::HatchParams {
        length: length(table.length, "length")?,
        cross_length: table.cross_length,
        jitter: table.stroke.jitter,
        seed: table.seed,
        tolerance: length(table.tolerance, "tolerance")?,
        min_step,
        offset: length(table.offset, "offset")?,
        chord,
        max_angle: table.max_angle,
        family: match table.family {
            Family::Larger => room::CurvatureFamily::Larger,
            Family::Max => room::CurvatureFamily::Max,
            Family::Min => room::CurvatureFamily::Min,
        },
        rule: match directions.rule {
            DirectionRule::Raw => room::DirectionEstimator::Raw,
            DirectionRule::Scaled => room::DirectionEstimator::Scaled(room::Thresholds {
                gap: directions.gap,
                noise: directions.noise,
                deviation: directions.deviation.unwrap_or(0.0),
                agree: directions.agree,
            }),
        },
        stored: directions.is_stored().then_some(room::DirectionStorage {
            between: match directions.interpolate {
                Interpolate::Tensor => room::DirectionInterpolation::Tensor,
                Interpolate::Flipped => room::DirectionInterpolation::Flipped,
            },
            all: directions.grid == StoredAt::All,
        }),
        smooth: length(directions.smooth, "directions.smooth")?,
        reference: match directions.reference {
            Reference::Cylindrical => room::ReferenceField::Cylindrical { axis, center },
            Reference::Axial => room::ReferenceField::Axial { axis },
            Reference::Radial => room::ReferenceField::Radial { center },
        },
    })
}

/// Converts the table's light on lines.
pub(super) fn line_light(table: &LineLighting) -> room::LineLight {
    room::LineLight {
        diffuse: table.diffuse,
        p: table.p,
        specular: table.specular,
        s: table.s,
        front: table.front,
        back: table.back,
        self_shadow: table.self_shadow,
        table: table.table.map(|side| room::LineLightTable::new(side, table.p, table.s)),
    }
}
