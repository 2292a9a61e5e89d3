//! How a colour is lit, at a sample or on an iso-surface: by Blinn–Phong or in tones, and black on silhouettes.

use crate::interactive_volume_illustration::{Silhouette, Toon};
use crate::number::{Real, Vec3};
use crate::shading::Phong;
use drypoint_scene::tables::{Scene, Shading, Surface, SurfaceLook};
use drypoint_scene::view::View;

/// What lights a colour.
pub(super) struct Lit<R> {
    model: Model<R>,
    silhouette: Option<Silhouette<R>>,
}

/// How light is reflected.
enum Model<R> {
    /// Not at all.
    Flat,
    /// [STF-11].
    Phong(Phong<R>),
    /// [HATCH-15].
    Toon(Toon<R>),
}

impl<R: Real> Lit<R> {
    /// By a table `[shading]`.
    pub(super) fn of_shading(shading: &Shading, scene: &Scene, view: &View) -> Self {
        let light = shading.light.unwrap_or(scene.light);
        let model = match shading.tones() {
            Some(tones) => Model::Toon(Toon::new(&tones, light, view)),
            None => Model::Phong(Phong::new(shading, scene.light, view)),
        };
        Self { model, silhouette: shading.silhouette.map(Silhouette::new) }
    }

    /// By the look of an iso-surface, with the light and the constants of `[shading]` or their defaults.
    pub(super) fn of_surface(surface: &Surface, scene: &Scene, view: &View) -> Self {
        let light = scene.shading.as_ref().and_then(|shading| shading.light).unwrap_or(scene.light);
        let model = match (surface.tones(), surface.look) {
            (Some(tones), _) => Model::Toon(Toon::new(&tones, light, view)),
            (None, SurfaceLook::Phong) => {
                Model::Phong(Phong::new(&scene.shading.clone().unwrap_or_default(), scene.light, view))
            }
            (None, _) => Model::Flat,
        };
        Self { model, silhouette: surface.silhouette.map(Silhouette::new) }
    }

    /// Ĥ of Blinn–Phong; 0 where nothing reads it.
    pub(super) fn half_vector(&self, v: Vec3<R>) -> Vec3<R> {
        match &self.model {
            Model::Phong(phong) => phong.half_vector(v),
            Model::Flat | Model::Toon(_) => Vec3::zero(),
        }
    }

    /// The colour of a place seen from v, with Ĥ of [`Lit::half_vector`].
    ///
    /// Without a normal it has the tone of N = v and is on no silhouette ([PREC-3]), but is unshaded by Blinn–Phong, whose
    /// highlight would be on every flat interior ([STF-11]).
    #[inline]
    pub(super) fn color(&self, c_u: [R; 3], normal: Option<Vec3<R>>, [v, half]: [Vec3<R>; 2]) -> [R; 3] {
        if let Some(silhouette) = self.silhouette
            && silhouette.is_black(normal.map_or(R::ONE, |n| n.dot(v)))
        {
            return [R::ZERO; 3];
        }
        match (&self.model, normal) {
            (Model::Phong(phong), Some(n)) => phong.shade(c_u, n, half),
            (Model::Toon(toon), n) => toon.shade(c_u, n.unwrap_or(v)),
            (Model::Flat, _) | (Model::Phong(_), None) => c_u,
        }
    }
}
