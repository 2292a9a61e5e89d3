//! The opaque meshes of a picture, where rays end ([VS-12]).

use super::lattice::IndexRay;
use super::sample::Lit;
use crate::mesh::{LineErrors, MeshHit, MeshSearch, PossibleHit};
use crate::number::{Bounded, Real, Vec3};
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec3;
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
        self.search.nearest(ray.line(), searched(ray, near))
    }

    /// The box about all triangles, in the index space of the volume.
    pub(super) fn ends(&self) -> [DVec3; 2] {
        self.search.ends()
    }

    /// The normal at a place, on the side of v, and the lit colour there.
    pub(super) fn seen(&self, hit: &MeshHit, v: Vec3<R>) -> (Option<Vec3<R>>, [R; 3]) {
        let normal = self.search.normal(hit, v.to_glam()).map(Vec3::from_glam);
        let look = &self.looks[hit.mesh];
        (normal, look.lit.color(look.rgb, normal, [v, look.lit.half_vector(v)]))
    }
}

impl PreparedMeshes<'_, Bounded> {
    /// The places on a ray, from a depth on, at which an f32 renderer may meet a mesh first.
    #[inline]
    pub(super) fn possible(&self, ray: &IndexRay<Bounded>, errors: LineErrors, near: f64) -> Vec<PossibleHit> {
        self.search.possible(ray.line(), errors, searched(ray, near))
    }

    /// The lit colour at a possible hit, seen from v.
    #[inline]
    pub(super) fn possible_color(&self, possible: &PossibleHit, v: Vec3<Bounded>) -> [Bounded; 3] {
        let look = &self.looks[possible.hit.mesh];
        let normal = self.search.possible_normal(possible, v);
        look.lit.color(look.rgb, normal, [v, look.lit.half_vector(v)])
    }
}

/// The depths at which meshes are searched on a ray, from `near` on. Beyond them sample planes coincide.
fn searched<R: Real>(ray: &IndexRay<R>, near: f64) -> [f64; 2] {
    let far = MOST_PLANES * ray.depth_step.to_f64();
    [near.max(-far), far]
}
