//! Facts of a shot's data for renderers that read no voxels themselves.

use super::error::RenderError;
use super::prepare::within_planes;
use super::prepare_object::Fields;
use crate::mesh::MeshSearch;
use crate::number::Real;
use crate::transfer::over::LabelDistance;
use drypoint_scene::counts::Counts;
use drypoint_scene::inputs::{Inputs, ObjectData};
use drypoint_scene::math;
use drypoint_scene::measured::Measured;
use drypoint_scene::shot::{Axis, Number, Object, Reconstruction, Shot};
use drypoint_scene::volume::Volume;

/// Measures the data of each object of a shot, in their order. Objects of one volume share its numbers.
///
/// # Errors
/// The reconstruction does not exist, sample planes coincide, or there are too many samples. Labels were not handed
/// over, or no voxel has a label.
pub fn measure(shot: &Shot, inputs: &Inputs<'_>) -> Result<Vec<Measured>, RenderError> {
    match shot.number {
        Number::F64 => measure_in::<f64>(shot, inputs),
        Number::F32 => measure_in::<f32>(shot, inputs),
    }
}

fn measure_in<R: Real>(shot: &Shot, inputs: &Inputs<'_>) -> Result<Vec<Measured>, RenderError> {
    let main = inputs.main.volume;
    within_planes(shot, main.grid())?;
    let mut fields = Fields::<R>::new(shot);
    let mut known: Vec<(&Volume, Reconstruction, Measured)> = Vec::new();
    let mut all = Vec::new();
    for (object, data) in shot.objects.iter().zip(std::iter::once(&inputs.main).chain(&inputs.parts)) {
        let (volume, how) = (data.volume, object.reconstruction);
        let field = fields.of(volume, object)?;
        // The numbers of the field, once for each volume and reconstruction.
        let is_same = |(of, by, _): &&(&Volume, Reconstruction, Measured)| std::ptr::eq(*of, volume) && *by == how;
        let of_field = match known.iter().find(is_same) {
            Some((.., known)) => known.clone(),
            None => {
                let of_field = field.measured(fields.rung());
                known.push((volume, how, of_field.clone()));
                of_field
            }
        };
        let back = |g: R| math::scale_by_power_of_two(g.to_f64(), field.scale_exponent());
        let range = fields.range(&field, object, &mut Counts::default());
        all.push(Measured {
            gradient_range: range.map(|(lo, width)| [back(lo), back(width)]),
            label_distances: label_distances::<R>(object, data)?,
            bricks: object.skip_empty.then(|| field.bricks()),
            ..of_field
        });
    }
    let boxes = MeshSearch::new(inputs.meshes, main.grid()).map(|search| search.boxes());
    if let (Some(main), Some(boxes)) = (all.first_mut(), boxes) {
        main.mesh_boxes = boxes;
    }
    Ok(all)
}

/// The distances of voxels to labels, for each quantity of an object's function that is such a distance ([STF-4]).
fn label_distances<R: Real>(object: &Object, data: &ObjectData<'_>) -> Result<[Option<Vec<f64>>; 2], RenderError> {
    let mut distances = [None, None];
    let rows = object.function.nodes().2;
    for (axis, distance) in rows.iter().flat_map(|rows| &rows.over).zip(&mut distances) {
        if let Axis::DistanceToLabel(id) = *axis {
            let labels = data.labels.ok_or(RenderError::NoLabels)?;
            let found = LabelDistance::<R>::new(data.volume, labels, id).ok_or(RenderError::NoSuchLabel { id })?;
            *distance = Some(found.at_voxels());
        }
    }
    Ok(distances)
}
