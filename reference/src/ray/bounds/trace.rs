//! A ray of a picture from its first sample to its end.

use super::aimed_ray::AimedRay;
use super::cast::{Traced, Tracer};
use super::halos::BandHalos;
use super::meshes::MetMesh;
use super::objects::BoundedObjects;
use super::positions::RayOrigin;
use super::ray_halos::RayHalos;
use super::surface::{BoundedHit, SurfaceErrors};
use crate::number::{Bounded, Decision, Vec3};
use crate::ray::prepared::Prepared;

/// Casts the ray through a point of the picture, in pixels from the top left corner. Halos come with the place of the
/// ray among those of the picture.
#[inline]
pub(super) fn trace<'p, 'v>(
    prepared: &'p Prepared<'v, Bounded>,
    point: [f64; 2],
    origin: RayOrigin,
    surface: Option<&SurfaceErrors>,
    halos: Option<(&'p BandHalos<'_>, [usize; 2])>,
) -> Traced {
    let object = &prepared.object;
    let aimed = AimedRay::new(prepared, point, origin);
    let halos = halos.map(|(band, ray)| RayHalos::new(band, ray, aimed.steps));
    let mut tracer = Tracer::new(prepared, aimed.evaluator(object), [aimed.steps, aimed.depth_step], halos);
    let v = tracer.evaluator.dirs.v;
    let mut objects = BoundedObjects::new(prepared, point, &aimed);
    let cut_is_open = tracer.evaluator.ray.cut_is_open(&object.clip.planes, v);
    if cut_is_open || objects.as_ref().is_some_and(|objects| objects.cut_is_open(v)) {
        tracer.mark(Decision::Cut);
    }
    // The end of the ray.
    let on_surface = surface.and_then(|errors| tracer.hit(errors));
    let mesh = prepared.meshes.as_ref().and_then(|meshes| {
        let ends = meshes.ends().map(Vec3::from_glam);
        MetMesh::new(prepared, &aimed.in_grid(&object.grid, ends), aimed.start())
    });
    let on_mesh = mesh.as_ref().and_then(|mesh| tracer.found(mesh.met));
    let (hit, mesh) = nearer(&mut tracer, on_surface, on_mesh.zip(mesh));
    let lines = prepared.lines_at(point);
    tracer.lines = tracer.lines_before(lines, hit);
    let is_alone = prepared.surface.as_ref().is_some_and(|surface| surface.alone);
    let is_open = match &mut objects {
        Some(objects) => tracer.samples_among(objects, hit),
        None => (is_alone || tracer.samples(hit, !lines.is_empty())) && tracer.lay_lines_left(),
    };
    match (hit, mesh) {
        (Some(hit), Some(mesh)) if is_open => tracer.mesh(&mesh, hit),
        (Some(hit), None) if is_open => tracer.surface(hit),
        (None, _) if is_open => tracer.leave_halos(),
        _ => {}
    }
    tracer.traced
}

/// The nearer one of the surface and a mesh, where the ray ends.
#[inline]
fn nearer(
    tracer: &mut Tracer<'_, '_>,
    on_surface: Option<BoundedHit>,
    on_mesh: Option<(BoundedHit, MetMesh)>,
) -> (Option<BoundedHit>, Option<MetMesh>) {
    let Some((hit, mesh)) = on_mesh else { return (on_surface, None) };
    let Some(other) = on_surface else { return (Some(hit), Some(mesh)) };
    if (hit.t - other.t).abs() <= hit.error + other.error {
        tracer.mark(Decision::Surface);
    }
    if hit.t < other.t { (Some(hit), Some(mesh)) } else { (on_surface, None) }
}
