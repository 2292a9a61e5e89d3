//! The preparation of a shot: everything that is measured or built from its data once for each picture.

use super::brick_occupancy::BrickOccupancy;
use super::cell_mask::CellMask;
use super::composite::covering_objects;
use super::error::RenderError;
use super::lattice::{MOST_ACROSS, MOST_SAMPLES, samples_in};
use super::prepared::Prepared;
use super::prepared_combination::PreparedCombination;
use super::prepared_halos::PreparedHalos;
use super::prepared_meshes::PreparedMeshes;
use super::prepared_surface::PreparedSurface;
use super::sample::need::Needs;
use super::sample::{EyeAxes, Lit, OverTwo, PreparedClip, PreparedObject, SampleShader};
use crate::field::{Field, Reconstruction, Rung, quantile_of_norms};
use crate::labels::Labels;
use crate::number::{Mat3, Real, Vec3};
use crate::transfer::{IndexTable, Piecewise, gate};
use drypoint_scene::counts::Counts;
use drypoint_scene::inputs::{Inputs, ObjectData};
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::{Axis, BlendSpace, Clipping, GradientRange, MOST_PLANES, Object, Shot};
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;
use drypoint_scene::volume::{BRICK, Bricks, Volume};

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
    let maps: Vec<_> = (0..combination.cutaways.len()).map(|i| combination.funnel_of(i, prepared, counts)).collect();
    for (cutaway, map) in combination.cutaways.iter_mut().zip(maps) {
        cutaway.funnel = map;
    }
    prepared.combination = Some(combination);
}

/// Prepared fields, and ranges of |g|. Objects of one volume share them.
pub(super) struct Fields<'a, R> {
    rung: Rung,
    fields: Vec<(Reconstruction, Field<'a, R>)>,
    ranges: Vec<(&'a Volume, GradientRange, (R, R))>,
}

impl<'a, R: Real> Fields<'a, R> {
    /// An empty collection. Fields are prepared for the highest rung of the shot's objects.
    pub(super) fn new(shot: &Shot) -> Self {
        let rung = shot.objects.iter().map(|object| object.rung).max().unwrap_or(Rung::Value);
        Self { rung, fields: Vec::new(), ranges: Vec::new() }
    }

    /// The field of an object's volume.
    pub(super) fn of(&mut self, volume: &'a Volume, object: &Object) -> Result<Field<'a, R>, RenderError> {
        let how = object.reconstruction;
        let known = self.fields.iter().find(|(known, field)| *known == how && std::ptr::eq(field.volume(), volume));
        if let Some((_, field)) = known {
            return Ok(field.clone());
        }
        let field = Field::<R>::new(volume, how, self.rung)?;
        self.fields.push((how, field.clone()));
        Ok(field)
    }

    /// The highest rung of the shot's objects.
    pub(super) fn rung(&self) -> Rung {
        self.rung
    }

    /// The range of |g| of an object's volume.
    pub(super) fn range(&mut self, field: &Field<'a, R>, object: &Object, counts: &mut Counts) -> Option<(R, R)> {
        let range = object.gradient_range?;
        let volume = field.volume();
        let known = self.ranges.iter().find(|(known, of, _)| std::ptr::eq(*known, volume) && *of == range);
        if let Some((.., known)) = known {
            return Some(*known);
        }
        let found = gradient_range(field, range, counts);
        self.ranges.push((volume, range, found));
        Some(found)
    }
}

/// The properties of the picture's camera on which materials depend.
pub(crate) struct Camera<'c> {
    pub(crate) view: &'c View,
    pub(crate) rays_across: usize,
    /// The smallest voxel side of `[volume]`, in world units.
    pub(crate) voxel: f64,
}

impl<'c> Camera<'c> {
    /// The camera of a shot over the grid of `[volume]`.
    fn new(shot: &'c Shot, grid: &Grid) -> Self {
        Self { view: &shot.view, rays_across: shot.rays_across, voxel: grid.voxel() }
    }
}

/// The place where a volume is drawn.
pub(super) struct MovedGrid<R> {
    /// The grid of the volume there.
    pub(super) grid: Grid,
    /// L_Tᵀ; none if the volume is not moved.
    pub(super) moved: Option<Mat3<R>>,
}

/// Prepares a volume with its function and its material. Its samples may need any quantity.
pub(super) fn prepare_object<'a, R: Real>(
    (object, clipping): (&Object, &Clipping),
    data: &ObjectData<'a>,
    place: MovedGrid<R>,
    field: Field<'a, R>,
    camera: &Camera<'_>,
    fields: &mut Fields<'a, R>,
    counts: &mut Counts,
) -> Result<PreparedObject<'a, R>, RenderError> {
    // The function, and the range of |g| if something reads it.
    let gradient_range = fields.range(&field, object, counts);
    let (at, opacity, rows) = object.function.nodes();
    let (over_value, over_two) = match rows {
        None => (Piecewise::new(at, opacity)?, None),
        Some(rows) => {
            let over_two = OverTwo::new((at, opacity), rows, data, object, &field, counts)?;
            (gate::over_value(at, opacity, rows)?, Some(over_two))
        }
    };
    let table = object.function.table().map(|(index, nodes)| IndexTable::new(index, nodes));
    if let Some(table) = &table {
        counts.bytes.insert("table".into(), table.bytes() as u64);
    }
    // The styles of caps follow those of the function.
    let of_function = data.styles.len().saturating_sub(clipping.styles.len());
    let (styles, of_caps) = data.styles.split_at(of_function);
    let shader = SampleShader::new(object, camera, styles)?;
    if let Some(bytes) = shader.mipmap_bytes() {
        counts.bytes.insert("style_mipmaps".into(), bytes as u64);
    }
    Ok(PreparedObject {
        volume: data.volume,
        ends: data.volume.grid().index_box().map(Vec3::from_glam),
        grid: place.grid,
        moved: place.moved,
        clip: PreparedClip::new(clipping, of_caps)?,
        function: over_value,
        table,
        over_two,
        shader,
        query: object.query,
        needs: Needs::Anything,
        first: object.first,
        meeting: object.meeting,
        gradient_range,
        reference_length: object.reference_length,
        outside: object.reconstruction.outside,
        normal: object.normal,
        turn: object.turn,
        no_normal_below: field.no_normal_below(),
        field,
    })
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

/// lo and hi − lo of |g| ([VAL-2]), times the power of two of [SPACE-4].
pub(super) fn gradient_range<R: Real>(field: &Field<'_, R>, range: GradientRange, counts: &mut Counts) -> (R, R) {
    let scaled = |g: f64| drypoint_scene::math::scale_by_power_of_two(g, -field.scale_exponent());
    let [lo, hi] = match range {
        GradientRange::Fixed(range) => range.map(scaled),
        GradientRange::Quantile(q) => {
            let (hi, voxels) = quantile_of_norms(field, q);
            counts.preprocess.insert("gradients".into(), voxels);
            [0.0, hi]
        }
    };
    (R::from_f64(lo), R::from_f64(hi - lo))
}

/// The labels at the data's positions, if the function over the value has a row for each label.
fn labels_of<'a>(object: &Object, data: &ObjectData<'a>) -> Option<Labels<'a>> {
    let over = &object.function.nodes().2?.over;
    let volume = data.volume;
    let new = |labels| Labels::new(labels, volume.grid(), volume.anatomy(), object.label_lookup);
    data.labels.filter(|_| *over == [Axis::Value, Axis::Label]).map(new)
}
