//! The opaque iso-surface of a picture ([HATCH-14]).

use super::{Illumination, SampleQuery, ShotError, iso_value, query};
use crate::picture::LayerKind;
use crate::plan::{Plan, Quantity};
use crate::tables::{Scene, SurfaceLook};
use crate::view::View;
use serde::{Deserialize, Serialize};

/// An iso-surface of opacity 1, at which rays end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OpaqueSurface {
    /// The value.
    pub iso: f64,
    /// Its colour, linear.
    pub rgb: [f64; 3],
    /// How the colour is lit.
    pub lit: Illumination,
    /// The query of a place on the surface.
    pub query: SampleQuery,
    /// The query of a place beyond that where nothing lies before it, for layers `first.*`.
    pub first: SampleQuery,
    /// Whether it is drawn alone, without the volume.
    pub alone: bool,
}

impl OpaqueSurface {
    /// The surface that a scene draws, if it draws one.
    pub(super) fn new(scene: &Scene, plan: &Plan, view: &View) -> Result<Option<Self>, ShotError> {
        let Some(surface) = scene.surface.as_ref().filter(|surface| surface.look != SurfaceLook::None) else {
            return Ok(None);
        };
        let iso = iso_value(surface.iso, "surface.iso")?;
        let normal = if plan.needs(Quantity::SurfaceNormal) { SampleQuery::NORMAL } else { SampleQuery::VALUE };
        let of_layers = |layers: [&[LayerKind]; 3]| {
            query::of_layers(scene, layers.map(|any| any.iter().any(|layer| scene.picture.layers.contains(layer))))
        };
        use LayerKind::{Curvature, CurvatureAlongView, Gradient, Normal};
        use LayerKind::{FirstCurvature, FirstCurvatureAlongView, FirstNormal};
        let [r, g, b, _] = surface.color;
        Ok(Some(Self {
            iso,
            rgb: if surface.look == SurfaceLook::White { [1.0; 3] } else { [r, g, b] },
            lit: Illumination::of_surface(surface, scene, view),
            query: normal.and(of_layers([&[Normal, Gradient], &[Curvature], &[CurvatureAlongView]])),
            first: of_layers([&[FirstNormal], &[FirstCurvature], &[FirstCurvatureAlongView]]),
            alone: scene.transfer.is_none(),
        }))
    }
}
