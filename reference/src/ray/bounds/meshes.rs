//! The mesh at which a ray ends, and the places at which an f32 renderer may meet it ([VS-12]).
//!
//! The error of a depth follows from that of the ray's positions and from how steeply the ray meets the triangle. If
//! several triangles may be the nearest, their colours are united. If none is met for certain, the hit is open.

use super::cast::{Shown, Tracer, union};
use super::surface::{BoundedHit, MOST, Met};
use crate::mesh::{LineErrors, PossibleHit};
use crate::number::{Bounded, Decision};
use crate::ray::lattice::IndexRay;
use crate::ray::prepared::Prepared;
use crate::surface::SurfaceHit;

/// The places at which a ray may meet a mesh first.
pub(super) struct MetMesh {
    pub(super) met: Met,
    /// The reference's hit comes first, if it finds one.
    possible: Vec<PossibleHit>,
}

impl MetMesh {
    /// The places on a ray with the errors of its positions about the meshes. In f32 it starts at the depth `middle`.
    #[inline]
    pub(super) fn new(prepared: &Prepared<'_, Bounded>, ray: &IndexRay<Bounded>, middle: f64) -> Option<Self> {
        let meshes = prepared.meshes.as_ref()?;
        let position = ray.errors().into_iter().fold(0.0, f64::max);
        let near = prepared.near_of(ray);
        let mut possible = meshes.possible(ray, LineErrors { position, start: middle }, near);
        let Some(hit) = meshes.nearest(ray, near) else {
            let met = if possible.is_empty() { Met::Nowhere } else { Met::Open(None) };
            return Some(Self { met, possible: Vec::new() });
        };
        // Depths of shaders are counted from the start, in steps, and rounded twice.
        let rounded = 2.0 * f64::from(f32::EPSILON) * ((hit.t - middle).abs() + hit.t.abs());
        let is_met = |other: &PossibleHit| other.hit.is_in_triangle_of(&hit);
        let is_certain = possible.iter().any(|other| other.is_certain);
        let error =
            possible.iter().map(|other| (other.hit.t - hit.t).abs() + other.error).fold(0.0, f64::max) + rounded;
        possible.sort_by_key(|other| !is_met(other));
        let [_, along] = ray.line();
        let is_near = along.abs().max_element() * error <= MOST;
        let is_known = is_certain && is_near && possible.first().is_some_and(is_met);
        let (t, cut) = (hit.t, None);
        let met = if is_known { Met::At(BoundedHit { t, error, cut }) } else { Met::Open(Some(SurfaceHit { t, cut })) };
        Some(Self { met, possible })
    }
}

impl Tracer<'_, '_> {
    /// Composites the mesh behind the samples.
    #[inline]
    pub(super) fn mesh(&mut self, mesh: &MetMesh, hit: BoundedHit) {
        let Some(meshes) = &self.prepared.meshes else { return };
        let v = self.evaluator.dirs.v;
        let mut ended: Option<Shown> = None;
        for possible in &mesh.possible {
            let shown = self.merged(|tracer| {
                let rgb = meshes.possible_color(possible, v);
                Some(tracer.opaque(rgb))
            });
            if ended.is_some() && self.parts(ended, shown) {
                self.mark(Decision::Surface);
            }
            ended = ended.map_or(shown, |before| union(Some(before), shown));
        }
        if let Some(shown) = ended {
            self.end(&shown, hit);
        }
    }
}
