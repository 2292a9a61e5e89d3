//! Picking: the first visible structure on the ray through a point of the picture ([HALO-12]).

use super::composite::{RayState, Step};
use super::prepared::Prepared;
use super::sample::need::Anything;
use crate::field::{Field, Sampler};
use crate::labels::Labels;
use crate::mesh::MeshHit;
use crate::number::{Real, Vec3};
use crate::surface::SurfaceHit;
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec3;

/// The accumulated opacity from which a structure counts as visible. Fainter haze and noise in front of it are ignored.
pub const VISIBLE: f64 = 1.0 / 16.0;

/// A place in the volume that was picked in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picked {
    /// The position in world space: that of the sample, or of the point on the iso-surface.
    pub world: DVec3,
    /// The position in the volume's index space.
    pub index: DVec3,
    /// Eye depth, as in the layers of depth.
    pub depth: f64,
    /// The value there; the iso-value on the iso-surface.
    pub value: f64,
    /// The shading normal ([NORM-1]), of length 1, in world space; on a cut the normal of the plane ([RAY-8]). None if
    /// the gradient is negligible ([PREC-3]), or if a gradient by regression was not prepared for the picture.
    pub normal: Option<DVec3>,
    /// A, the accumulated opacity, with this place included.
    pub opacity: f64,
    /// The label there; none if the renderer was given no labels.
    pub label: Option<u32>,
    /// Whether the place is on the opaque iso-surface.
    pub on_surface: bool,
    /// Index of the mesh on which the place lies; none if it lies on no mesh. Value and label are then those of the
    /// volume at the nearest place in its box.
    pub mesh: Option<usize>,
}

/// A candidate on a ray.
#[derive(Clone, Copy)]
enum Candidate {
    /// Sample k.
    Sample(i64),
    /// The iso-surface or a cut of it.
    Surface(SurfaceHit),
    /// A mesh.
    Mesh(MeshHit),
}

impl Candidate {
    /// The candidate that a step of one sample meets. Returns none for a line.
    fn of(step: &Step<'_>) -> Option<Self> {
        match *step {
            Step::Samples([k, _]) | Step::Share { k, .. } => Some(Self::Sample(k)),
            Step::Surface { hit, .. } => Some(Self::Surface(hit)),
            Step::Mesh { hit, .. } => Some(Self::Mesh(hit)),
            Step::Line { .. } => None,
        }
    }
}

/// Picks the first visible structure on the ray through a point, in pixels from the top left corner.
///
/// It is the first sample at which the accumulated opacity A reaches `visible`. If A stays below on the whole ray, it
/// is the first sample with the largest weight. The iso-surface and meshes are samples at their own depths. Both rules
/// converge to a place on the ray as the step becomes smaller.
///
/// Lines inside the picture are ignored. Returns none if nothing is visible on the ray, or if the point is outside the
/// picture.
pub(super) fn pick<R: Real>(
    prepared: &Prepared<'_, R>,
    labels: Option<&Labels<'_>>,
    point: [f64; 2],
    visible: f64,
) -> Option<Picked> {
    let is_inside = |axis: usize| (0.0..=prepared.view.size[axis] as f64).contains(&point[axis]);
    if !(is_inside(0) && is_inside(1)) {
        return None;
    }
    let mut state = RayState::new(prepared, &prepared.object.field, point);
    let mut steps = Vec::new();
    let mut counts = Counts::default();
    state.path_among((point, &[]), None, &mut steps, &mut counts);
    // The heaviest candidate so far: its weight, and A after it.
    let mut heaviest: Option<(Candidate, [f64; 2])> = None;
    for step in steps.into_iter().flat_map(Step::one_by_one) {
        let before = state.opacity().to_f64();
        let is_open = state.take::<Anything>(&step, None, &mut counts);
        let opacity = state.opacity().to_f64();
        let weight = opacity - before;
        if let Some(candidate) = Candidate::of(&step)
            && weight > 0.0
            && (opacity >= visible || heaviest.is_none_or(|(_, [most, _])| weight > most))
        {
            heaviest = Some((candidate, [weight, opacity]));
        }
        if !is_open || opacity >= visible {
            break;
        }
    }
    heaviest.map(|(candidate, [_, opacity])| state.picked(candidate, opacity, labels))
}

impl<'v, R: Real> RayState<'_, 'v, R, Field<'v, R>> {
    /// Describes a candidate.
    fn picked(&mut self, candidate: Candidate, opacity: f64, labels: Option<&Labels<'_>>) -> Picked {
        let of_object = match candidate {
            Candidate::Sample(k) => self.seen_of_objects(k),
            _ => None,
        };
        let (object, evaluator) = (&self.prepared.object, &self.evaluator);
        let (position, depth) = match candidate {
            Candidate::Sample(k) => (evaluator.position(k), evaluator.depth(k).to_f64()),
            Candidate::Surface(hit) => (evaluator.inside(hit.t), hit.t),
            Candidate::Mesh(hit) => (evaluator.inside(hit.t), hit.t),
        };
        // A moved object may lie outside the volume.
        let at = evaluator.sampler.place(if of_object.is_some() { evaluator.inside(depth) } else { position });
        let value = match (candidate, &self.prepared.surface) {
            (Candidate::Surface(_), Some(surface)) => surface.roots.iso(),
            _ => evaluator.sampler.value_at(at).to_f64(),
        };
        let gradient = object.field.has_gradient().then(|| evaluator.sampler.gradient_at(at));
        let cut = match candidate {
            Candidate::Sample(k) => evaluator.cut_at(k),
            Candidate::Surface(hit) => {
                hit.cut.map(|plane| object.clip.face(plane, &evaluator.dirs, &self.prepared.eye_axes))
            }
            Candidate::Mesh(_) => None,
        };
        let normal = gradient.and_then(|g| object.normal(g, evaluator.dirs.v));
        let normal = cut.map_or(normal, |cut| Some(cut.normal));
        let (value, normal) = of_object.unwrap_or((value, normal));
        let (normal, index, mesh) = match (candidate, &self.prepared.meshes) {
            (Candidate::Mesh(hit), Some(meshes)) => {
                let [origin, along] = evaluator.ray.line();
                (meshes.seen(&hit, evaluator.dirs.v).0, origin + along * hit.t, Some(hit.mesh))
            }
            _ => (normal, position.to_glam(), None),
        };
        Picked {
            world: object.volume.grid().to_world(index),
            index,
            depth,
            value,
            normal: normal.map(Vec3::to_glam),
            opacity,
            label: labels.map(|labels| labels.id_at(position)),
            on_surface: matches!(candidate, Candidate::Surface(_)),
            mesh,
        }
    }
}
