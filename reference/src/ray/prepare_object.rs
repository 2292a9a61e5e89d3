//! The preparation of an object: its field, its function and its material.

use super::error::RenderError;
use super::sample::need::Needs;
use super::sample::{Camera, OverTwo, PreparedClip, PreparedObject, SampleShader};
use crate::field::{Field, Reconstruction, Rung, quantile_of_norms};
use crate::number::{Mat3, Real, Vec3};
use crate::transfer::{IndexTable, Piecewise, gate};
use drypoint_scene::counts::Counts;
use drypoint_scene::inputs::ObjectData;
use drypoint_scene::math;
use drypoint_scene::shot::{Clipping, GradientRange, Object, Shot};
use drypoint_scene::space::Grid;
use drypoint_scene::volume::Volume;

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

/// lo and hi − lo of |g| ([VAL-2]), times the power of two of [SPACE-4].
pub(super) fn gradient_range<R: Real>(field: &Field<'_, R>, range: GradientRange, counts: &mut Counts) -> (R, R) {
    let scaled = |g: f64| math::scale_by_power_of_two(g, -field.scale_exponent());
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
