//! The preparation of a shot: everything that is measured or built from its data once for each picture.

use super::brick_occupancy::BrickOccupancy;
use super::cell_mask::CellMask;
use super::composite::{covering_objects, depth_of_part};
use super::error::RenderError;
use super::lattice::{MOST_ACROSS, MOST_SAMPLES, samples_in};
use super::prepare_object::{Fields, MovedGrid, prepare_object};
use super::prepared::Prepared;
use super::prepared_combination::{PreparedCombination, PreparedFunnel};
use super::prepared_halos::PreparedHalos;
use super::prepared_meshes::PreparedMeshes;
use super::prepared_surface::PreparedSurface;
use super::sample::need::Needs;
use super::sample::{Camera, EyeAxes, Lit, SampleShader};
use crate::labels::Labels;
use crate::number::Real;
use crate::volumeshop::{FunnelMap, guard};
use drypoint_scene::counts::Counts;
use drypoint_scene::inputs::{Inputs, ObjectData};
use drypoint_scene::parallel;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::{Axis, BlendSpace, MOST_PLANES, Object, Shot};
use drypoint_scene::space::Grid;
use drypoint_scene::volume::{BRICK, Bricks};

/// Prepares a shot for casting.
pub(super) fn prepare<'a, R: Real>(
    shot: &Shot,
    inputs: &Inputs<'a>,
    counts: &mut Counts,
) -> Result<Prepared<'a, R>, RenderError> {
    let object = shot.background();
    let data = &inputs.main;
    let volume = data.volume;
    within_planes(shot, volume.grid())?;
    let mut fields = Fields::new(shot);
    // The field, and which of its bricks can show something.
    let field = fields.of(volume, object)?;
    counts.bytes.extend(field.bytes());
    let bricks = object.skip_empty.then(|| field.bricks());
    if let Some(bricks) = &bricks {
        counts.bytes.insert("bricks".into(), bricks.bytes() as u64);
    }
    let surface = shot.surface.as_ref().map(|s| PreparedSurface::new(s, &field, bricks.as_ref(), counts));
    let skip = bricks.as_ref().map(|bricks| skip::<R>(bricks, object, data));
    let cells =
        bricks.as_ref().and_then(|bricks| CellMask::new(bricks, object.reconstruction.kernel, &object.function));
    if let Some(cells) = &cells {
        counts.bytes.insert("cells".into(), cells.bytes() as u64);
    }
    if let Some(labels) = data.labels {
        counts.bytes.insert("labels".into(), labels.bytes() as u64);
    }
    if let Some(skip) = &skip {
        counts.bytes.insert("skip".into(), skip.bytes() as u64);
    }
    let asks_samples = |layer| !matches!(layer, LayerKind::Beauty | LayerKind::Counts | LayerKind::Halo(_));
    let collects = shot.layers.iter().any(|&layer| asks_samples(layer));
    let encode = shot.blend_space == BlendSpace::Srgb;
    let camera = Camera::new(shot, volume.grid());
    let place = MovedGrid { grid: volume.grid().clone(), moved: None };
    let mut prepared = prepare_object((object, &shot.clipping), data, place, field, &camera, &mut fields, counts)?;
    let plain = matches!(prepared.shader, SampleShader::Regular { .. });
    let more = !plain
        || prepared.table.is_some()
        || prepared.over_two.is_some()
        || prepared.gradient_range.is_some()
        || collects
        || encode;
    prepared.needs = Needs::new(object.query, more);
    let of_alpha = prepared.over_two.as_ref().map(|over_two| over_two.first);
    let rounded = |at| R::from_f64(at).to_f64();
    let halos = PreparedHalos::new(shot, data, bricks.as_ref(), of_alpha, rounded)?;
    if let Some(skip) = halos.as_ref().and_then(|halos| halos.skip.as_ref()) {
        counts.bytes.insert("skip_seeds".into(), skip.bytes() as u64);
    }
    let combination = shot.combination.as_ref();
    let combination =
        combination.map(|c| PreparedCombination::new((shot, c), inputs, &camera, &mut fields, counts)).transpose()?;
    let mut prepared = Prepared {
        object: prepared,
        combination,
        view: shot.view.clone(),
        lattice: shot.lattice,
        skip,
        cells,
        lines: None,
        surface,
        meshes: PreparedMeshes::new(&shot.meshes, inputs.meshes, volume.grid(), counts),
        halos,
        stop_at: R::from_f64(shot.stop_at),
        encode,
        collects,
        covering: covering_objects(&shot.layers),
        layers: shot.layers.clone(),
        eye_axes: EyeAxes::new(&shot.view),
        rays_across: shot.rays_across,
        refine_above: shot.refine_above,
    };
    map_funnels(&mut prepared, counts);
    Ok(prepared)
}

/// Maps the funnels of smooth cutaways, as the camera sees them ([VS-7]).
fn map_funnels<R: Real>(prepared: &mut Prepared<'_, R>, counts: &mut Counts) {
    let Some(mut combination) = prepared.combination.take() else { return };
    let maps: Vec<_> = (0..combination.cutaways.len()).map(|i| funnel_of(i, &combination, prepared, counts)).collect();
    for (cutaway, map) in combination.cutaways.iter_mut().zip(maps) {
        cutaway.funnel = map;
    }
    prepared.combination = Some(combination);
}

/// The map of a cutaway's funnel. Returns none for a hard cut.
fn funnel_of<R: Real>(
    cutaway: usize,
    combination: &PreparedCombination<'_, R>,
    prepared: &Prepared<'_, R>,
    counts: &mut Counts,
) -> Option<PreparedFunnel> {
    let params = combination.cutaways[cutaway].params;
    if params.funnel <= 0.0 {
        return None;
    }
    let of_halos = prepared.halos.as_ref().filter(|halos| halos.seeds.is_some());
    let margin = of_halos.map_or(0, |halos| halos.guard().div_ceil(prepared.rays_across));
    let (size, guard) = (prepared.view.size.map(|n| n + 2 * margin), guard(params.funnel));
    let [width, height] = size.map(|n| n + 2 * guard);
    let row = |y: usize| {
        let mut counts = Counts::default();
        let centre = |i: usize| i as f64 - (guard + margin) as f64 + 0.5;
        let depth = |x: usize| {
            depth_of_part(prepared, combination, [centre(x), centre(y)], (params.part, params.cut), &mut counts)
        };
        let depths: Vec<f64> = (0..width).map(depth).collect();
        (depths, counts)
    };
    let rows: Vec<(Vec<f64>, Counts)> = parallel::map(height, &row);
    let mut depths = Vec::with_capacity(width * height);
    for (row, own) in rows {
        depths.extend(row);
        counts.add(&own);
    }
    Some(PreparedFunnel { map: FunnelMap::new(size, params.funnel, &depths), size, margin })
}

/// Takes over the camera's data, the picture's size and its rays from the same shot with another camera, size or rays.
pub(super) fn turn<R: Real>(prepared: &mut Prepared<'_, R>, shot: &Shot) -> Result<(), RenderError> {
    let grid = prepared.object.volume.grid();
    within_planes(shot, grid)?;
    let camera = Camera::new(shot, grid);
    prepared.eye_axes = EyeAxes::new(&shot.view);
    prepared.object.shader.turn(shot.background(), &camera);
    if let Some(prepared) = &mut prepared.combination {
        prepared.turn(shot, &camera);
    }
    if let Some(halos) = &mut prepared.halos {
        halos.list = PreparedHalos::list(shot);
    }
    if let (Some(prepared), Some(surface)) = (&mut prepared.surface, &shot.surface) {
        prepared.lit = Lit::new(&surface.lit);
    }
    if let Some(meshes) = &mut prepared.meshes {
        meshes.turn(&shot.meshes);
    }
    prepared.view = shot.view.clone();
    (prepared.rays_across, prepared.refine_above) = (shot.rays_across, shot.refine_above);
    map_funnels(prepared, &mut Counts::default());
    Ok(())
}

/// Checks that sample planes can be distinguished all along the rays ([RAY-1]), and that the number of samples is not
/// too large.
///
/// # Errors
/// Sample planes coincide, or there are too many samples.
pub fn within_planes(shot: &Shot, grid: &Grid) -> Result<(), RenderError> {
    let Shot { lattice, view, .. } = shot;
    let planes = lattice.planes(view, grid);
    if planes >= MOST_PLANES {
        return Err(RenderError::TooManyPlanes { planes });
    }
    let samples = samples_in(lattice, view, grid) * (shot.rays_across * shot.rays_across) as f64;
    if samples > MOST_SAMPLES {
        return Err(RenderError::Endless { samples });
    }
    let steps = 2.0 * grid.radius() / lattice.step;
    if steps > MOST_ACROSS { Err(RenderError::TooManySteps { steps }) } else { Ok(()) }
}

/// Marks the bricks in which the function can show something.
fn skip<R: Real>(bricks: &Bricks, object: &Object, data: &ObjectData<'_>) -> BrickOccupancy {
    let labels = labels_of(object, data);
    // Number of cells of the volume. An axis of length 1 has one.
    let cells = data.volume.dims().map(|n| n.max(2) - 1);
    let occurring = |brick: [usize; 3]| {
        let end = std::array::from_fn(|a| ((brick[a] + 1) * BRICK).min(cells[a]));
        labels.as_ref().map(|labels| labels.ids_in(brick.map(|i| i * BRICK), end))
    };
    let rounded = |at| R::from_f64(at).to_f64();
    // Finding the labels that occur reads each voxel, so this is tested last.
    let can_be = |range, among: Option<&[u32]>| object.function.can_be_visible(range, among, rounded);
    BrickOccupancy::new(bricks, |brick, range| can_be(range, None) && can_be(range, occurring(brick).as_deref()))
}

/// The labels at the data's positions, if the function over the value has a row for each label.
fn labels_of<'a>(object: &Object, data: &ObjectData<'a>) -> Option<Labels<'a>> {
    let over = &object.function.nodes().2?.over;
    let volume = data.volume;
    let new = |labels| Labels::new(labels, volume.grid(), volume.anatomy(), object.label_lookup);
    data.labels.filter(|_| *over == [Axis::Value, Axis::Label]).map(new)
}
