//! Samples of a transfer function over two quantities ([STF-4]), with the order in which quantities are evaluated.

use crate::field::Field;
use crate::labels::Labels;
use crate::number::Real;
use crate::ray::error::RenderError;
use crate::transfer::over::{
    AxisMeasure, CurvatureMeasure, GradientMagnitude, LabelDistance, OtherVolume, PointDistance, SampleLabel,
    SampleQuantities, SampleValue,
};
use crate::transfer::{NodePatch, TransferPlane};
use drypoint_scene::counts::Counts;
use drypoint_scene::inputs::ObjectData;
use drypoint_scene::math;
use drypoint_scene::shot::{Axis, LabelLookup, Object, SampleQuery};
use drypoint_scene::transfer::Rows;

/// A function over two quantities, with the measures of these quantities.
pub(crate) struct OverTwo<'v, R> {
    plane: TransferPlane<R>,
    measures: [Box<dyn AxisMeasure<R> + 'v>; 2],
    /// The query of the two quantities, before α_u is known.
    pub(crate) first: SampleQuery,
    /// The rest of the query of a visible sample.
    pub(crate) rest: SampleQuery,
}

impl<'v, R: Real> OverTwo<'v, R> {
    /// Prepares a function from its nodes and rows.
    ///
    /// # Errors
    /// The nodes do not make a function. A label volume or a further volume was not handed over or cannot be read. No
    /// voxel has a label.
    pub(crate) fn new(
        (at, opacity): (&[f64], &[f64]),
        rows: &Rows,
        data: &ObjectData<'v>,
        object: &Object,
        field: &Field<'_, R>,
        counts: &mut Counts,
    ) -> Result<Self, RenderError> {
        let [across, down] = [0, 1].map(|i| measure(&rows.over[i], i, rows.normalized, data, object.label_lookup));
        let measures = [across?, down?];
        for measure in &measures {
            if let Some((name, bytes)) = measure.bytes() {
                *counts.bytes.entry(name.into()).or_default() += bytes;
            }
            if let Some((name, voxels)) = measure.preprocess() {
                *counts.preprocess.entry(name.into()).or_default() += voxels;
            }
        }
        let scaled = |axis: &Axis<u32>, at: &[f64]| -> Vec<f64> {
            let by = if *axis == Axis::GradientMagnitude && !rows.normalized { -field.scale_exponent() } else { 0 };
            at.iter().map(|&a| math::scale_by_power_of_two(a, by)).collect()
        };
        let rows_at = scaled(&rows.over[1], &rows.at);
        let plane = TransferPlane::new(&scaled(&rows.over[0], at), opacity, &Rows { at: rows_at, ..rows.clone() })?;
        let (first, rest) = object.query.split(&rows.over);
        Ok(Self { plane, measures, first, rest })
    }

    /// The place of a sample between the nodes. Returns none if the sample is transparent.
    #[inline]
    pub(crate) fn locate(&self, here: &SampleQuantities<R>) -> Option<NodePatch<R>> {
        let [x, y] = &self.measures;
        self.plane.locate(x.at(here), y.at(here))
    }
}

/// The measure of a quantity.
fn measure<'v, R: Real>(
    axis: &Axis<u32>,
    which: usize,
    normalized: bool,
    data: &ObjectData<'v>,
    label_lookup: LabelLookup,
) -> Result<Box<dyn AxisMeasure<R> + 'v>, RenderError> {
    let (volume, labels) = (data.volume, || data.labels.ok_or(RenderError::NoLabels));
    Ok(match axis {
        Axis::Value => Box::new(SampleValue),
        Axis::GradientMagnitude if normalized => Box::new(GradientMagnitude::Normalized),
        Axis::GradientMagnitude => Box::new(GradientMagnitude::Scaled),
        Axis::K1 => Box::new(CurvatureMeasure::K1),
        Axis::K2 => Box::new(CurvatureMeasure::K2),
        Axis::Mean => Box::new(CurvatureMeasure::Mean),
        Axis::Gaussian => Box::new(CurvatureMeasure::Gaussian),
        Axis::AlongView => Box::new(CurvatureMeasure::AlongView),
        Axis::Distance(point) => Box::new(PointDistance::new(volume.grid(), *point)),
        Axis::Volume(_) => {
            let further = data.further[which].ok_or(RenderError::NoFurtherVolume)?;
            Box::new(OtherVolume::new(further, volume)?)
        }
        Axis::Label => Box::new(SampleLabel(Labels::new(labels()?, volume.grid(), volume.anatomy(), label_lookup))),
        Axis::DistanceToLabel(id) => {
            let distance = LabelDistance::new(volume, labels()?, *id);
            Box::new(distance.ok_or(RenderError::NoSuchLabel { id: *id })?)
        }
    })
}
