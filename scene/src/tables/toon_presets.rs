//! The presets that draw an automatic iso-surface in tones ([HATCH-15]).

use crate::color::opaque;
use crate::tables::{LightDirection, Shading, SilhouetteShading, Surface, SurfaceLook, Tone, ToonShading};
use glam::DVec3;

/// A preset that draws an automatic iso-surface in tones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ToonPreset {
    /// A first picture.
    Plain,
    /// Fig. 2.
    Fig2,
}

impl ToonPreset {
    /// The tables `[surface]` and `[shading]`, whose light comes from the upper left: under a head light no tone tells left
    /// from right. Judged on real volumes, on a white page.
    pub(crate) fn tables(self) -> (Surface, Shading) {
        let grey = |at: f64, byte: f64| Tone { at, color: opaque([byte; 3]) };
        let (paint, toon, silhouette) = match self {
            // The light, a half-tone for walls that it grazes, and a shadow; lines so thin that floors seen at a slant stay.
            Self::Plain => {
                let tones = vec![grey(0.0, 116.0), grey(0.05, 198.0), grey(0.45, 255.0)];
                ([231.0, 191.0, 133.0], ToonShading { offset: 0.0, tones }, SilhouetteShading { offset: 0.47 })
            }
            // "Half-level": the light ends at 90°.
            Self::Fig2 => {
                let toon = ToonShading { offset: 0.5, ..ToonShading::default() };
                ([232.0, 224.0, 208.0], toon, SilhouetteShading::default())
            }
        };
        let surface = Surface {
            look: SurfaceLook::Toon,
            color: opaque(paint),
            toon: Some(toon),
            silhouette: Some(silhouette),
            ..Surface::default()
        };
        let light = Some(LightDirection::Eye(DVec3::new(-1.0, 1.5, 0.8)));
        (surface, Shading { light, ..Shading::default() })
    }
}
