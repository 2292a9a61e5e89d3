//! The light on a colour at a sample or on an iso-surface: Blinn–Phong, tones or a lighting function. Silhouettes are
//! black.

use super::{SampleAttributes, ViewDirs};
use crate::interactive_volume_illustration::{SilhouetteTest, Toon};
use crate::number::{Real, Vec3};
use crate::shading::Phong;
use crate::volumeshop::LightingFunction;
use drypoint_scene::shot::{Illumination, Lighting};

/// The light of a colour.
pub(crate) struct Lit<R> {
    model: Model<R>,
    silhouette: Option<SilhouetteTest<R>>,
}

/// A reflection of light.
enum Model<R> {
    /// No shading.
    Flat,
    /// [STF-11].
    Phong(Phong<R>),
    /// [HATCH-15].
    Toon(Toon<R>),
    /// [VS-5].
    Function(LightingFunction<R>),
}

impl<R: Real> Lit<R> {
    /// Prepares the light of a shot.
    pub(crate) fn new(lit: &Illumination) -> Self {
        let model = match &lit.lighting {
            Lighting::Flat => Model::Flat,
            Lighting::Phong(phong) => Model::Phong(Phong::new(phong)),
            Lighting::Toon(toon) => Model::Toon(Toon::new(toon)),
            Lighting::Function(params) => Model::Function(LightingFunction::new(params)),
        };
        Self { model, silhouette: lit.silhouette.map(SilhouetteTest::new) }
    }

    /// Ĥ of Blinn–Phong and of a lighting function; 0 for other models.
    pub(crate) fn half_vector(&self, v: Vec3<R>) -> Vec3<R> {
        match &self.model {
            Model::Phong(phong) => phong.half_vector(v),
            Model::Function(function) => function.half_vector(v),
            Model::Flat | Model::Toon(_) => Vec3::zero(),
        }
    }

    /// The colour of a place seen from v, with Ĥ of [`Lit::half_vector`].
    ///
    /// Without a normal the place has the tone of N = v and is on no silhouette ([PREC-3]). Blinn–Phong then leaves it
    /// unshaded, because its highlight would cover every flat interior ([STF-11]).
    #[inline]
    pub(crate) fn color(&self, c_u: [R; 3], normal: Option<Vec3<R>>, [v, half]: [Vec3<R>; 2]) -> [R; 3] {
        if self.is_black(normal, v) {
            return [R::ZERO; 3];
        }
        match (&self.model, normal) {
            (Model::Phong(phong), Some(n)) => phong.shade(c_u, n, half),
            (Model::Toon(toon), n) => toon.shade(c_u, n.unwrap_or(v)),
            (Model::Function(function), Some(n)) => function.reflectance(n, half).color(c_u),
            (Model::Flat, _) | (Model::Phong(_) | Model::Function(_), None) => c_u,
        }
    }

    /// s_α of a lighting function at a normal. Returns none for other models.
    pub(crate) fn opacity_enhancement(&self, n: Vec3<R>, half: Vec3<R>) -> Option<R> {
        if let Model::Function(function) = &self.model { Some(function.reflectance(n, half).opacity) } else { None }
    }

    /// The colour and the opacity of a sample. A lighting function also changes the opacity if there is a normal.
    #[inline]
    pub(crate) fn shade(
        &self,
        c_u: [R; 3],
        alpha_u: R,
        attributes: &SampleAttributes<R>,
        dirs: &ViewDirs<R>,
    ) -> ([R; 3], R) {
        let (Model::Function(function), Some(n)) = (&self.model, attributes.normal) else {
            return (self.color(c_u, attributes.normal, [dirs.v, dirs.half]), alpha_u);
        };
        let reflectance = function.reflectance(n, dirs.half);
        let rgb = if self.is_black(Some(n), dirs.v) { [R::ZERO; 3] } else { reflectance.color(c_u) };
        (rgb, function.opacity(alpha_u, &reflectance, attributes.magnitude))
    }

    /// Whether a place is black because it lies on a silhouette.
    #[inline]
    fn is_black(&self, normal: Option<Vec3<R>>, v: Vec3<R>) -> bool {
        self.silhouette.is_some_and(|silhouette| silhouette.is_black(normal.map_or(R::ONE, |n| n.dot(v))))
    }
}
