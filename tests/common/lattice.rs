//! The samples of a picture one by one, walked without anything that the caster does to be fast: every k of every ray
//! that lies in the box, with the value that the field has there.

use super::Stage;
use drypoint::reference::field::{Field, Rung, Sampler};
use drypoint::reference::number::{Real, Vec3};
use drypoint::reference::ray::lattice::IndexRay;
use drypoint::reference::with_sampler;
use drypoint::scene::glam::DVec3;

/// One sample of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sighted {
    /// Which plane.
    pub(crate) k: i64,
    /// The value of the field.
    pub(crate) value: f64,
    /// Whether a corner of its cell is masked.
    pub(crate) masked: bool,
    /// The unit gradient in world space; none where it is negligible.
    pub(crate) gradient: Option<DVec3>,
}

/// The samples inside the box of the ray of each pixel, in the number type of the caster.
pub(crate) fn sighted<R: Real>(stage: &Stage) -> Vec<Vec<Sighted>> {
    let (scene, grid) = (&stage.scene, stage.volume.grid());
    let shot = stage.resolved(stage.view());
    let object = shot.background();
    let field = Field::<R>::new(&stage.volume, object.reconstruction, Rung::Gradient).unwrap();
    let (view, ends) = (&shot.view, grid.index_box().map(Vec3::from_glam));
    let [width, height] = scene.picture.size;
    let pixels = (0..width * height).map(|t| [t % width, t / width].map(|i| i as f64 + 0.5));
    with_sampler!(field, |sampler| {
        pixels
            .map(|[i, j]| {
                let ray = IndexRay::<R>::new(&view.ray(i, j), view, &shot.lattice, grid);
                let [first, last] = ray.inside(ends);
                (first..=last)
                    .map(|k| {
                        let p = ray.position(k);
                        let g = sampler.gradient(p);
                        Sighted {
                            k,
                            value: sampler.value(p).to_f64(),
                            masked: stage.volume.mask().is_some_and(|mask| mask.touches_cell(sampler.cell(p))),
                            gradient: (g.length() > field.no_normal_below()).then(|| g.to_glam().normalize()),
                        }
                    })
                    .collect()
            })
            .collect()
    })
}
