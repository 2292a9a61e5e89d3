//! The opaque meshes of a picture, where rays end ([VS-12]).

use super::lattice::IndexRay;
use super::sample::Lit;
use crate::mesh::{MeshHit, MeshSearch};
use crate::number::{Real, Vec3};
use drypoint_scene::counts::Counts;
use drypoint_scene::mesh::TriangleMesh;
use drypoint_scene::shot::{MOST_PLANES, MeshParams};
use drypoint_scene::space::Grid;

/// Meshes prepared for rays.
pub(super) struct PreparedMeshes<'a, R> {
    search: MeshSearch<'a>,
    looks: Vec<Look<R>>,
}

/// The look of a mesh.
struct Look<R> {
    /// Linear colour.
    rgb: [R; 3],
    lit: Lit<R>,
}

impl<'a, R: Real> PreparedMeshes<'a, R> {
    /// Prepares the meshes of a shot. Returns none if there are none.
    pub(super) fn new(
        params: &[MeshParams],
        meshes: &'a [TriangleMesh],
        grid: &Grid,
        counts: &mut Counts,
    ) -> Option<Self> {
        let search = MeshSearch::new(meshes, grid)?;
        counts.bytes.insert("meshes".into(), search.bytes() as u64);
        let look = |mesh: &MeshParams| Look { rgb: mesh.rgb.map(R::from_f64), lit: Lit::new(&mesh.lit) };
        Some(Self { search, looks: params.iter().map(look).collect() })
    }

    /// Takes over the lights of the shot for another camera.
    pub(super) fn turn(&mut self, params: &[MeshParams]) {
        for (look, mesh) in self.looks.iter_mut().zip(params) {
            look.lit = Lit::new(&mesh.lit);
        }
    }

    /// The nearest place on a ray from a depth on.
    pub(super) fn nearest(&self, ray: &IndexRay<R>, near: f64) -> Option<MeshHit> {
        // Beyond this depth sample planes coincide.
        let far = MOST_PLANES * ray.depth_step.to_f64();
        self.search.nearest(ray.line(), [near.max(-far), far])
    }

    /// The normal at a place, on the side of v, and the lit colour there.
    pub(super) fn seen(&self, hit: &MeshHit, v: Vec3<R>) -> (Option<Vec3<R>>, [R; 3]) {
        let normal = self.search.normal(hit, v.to_glam()).map(Vec3::from_glam);
        let look = &self.looks[hit.mesh];
        (normal, look.lit.color(look.rgb, normal, [v, look.lit.half_vector(v)]))
    }
}
