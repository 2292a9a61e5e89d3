//! Presets: whole tables for a scene that lacks them ([SCN-3]).

use super::halo_presets::HaloPreset;
use super::hatching::HatchPreset;
use super::stipples::StipplePreset;
use super::toon_presets::ToonPreset;
use super::{Outlines, Scene, Transfer, TransferKind};
use crate::document::kind::{Choice, ChoiceOption};

/// The presets that `preset` names.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Preset {
    /// An automatic style transfer function.
    Style,
    /// A table `[stipples]`, and the outlines beside it.
    Stipples(StipplePreset),
    /// A table `[hatching]`, and the tables that its picture needs.
    Hatch(HatchPreset),
    /// A table `[outlines]`.
    Outline,
    /// Tables `[surface]` and `[shading]`.
    Toon(ToonPreset),
    /// Tables `[[halo]]` and `[transfer]`, and the tables that they need.
    Halo(HaloPreset),
}

/// Presets by name.
pub(super) const PRESETS: Choice<Preset> = Choice {
    options: &[
        ChoiceOption::new("style", Preset::Style, "An automatic style transfer function."),
        ChoiceOption::new(
            "stipple",
            Preset::Stipples(StipplePreset::Plain),
            "Stipples of a lit surface with outlines, without what is hidden.",
        ),
        ChoiceOption::new(
            "stipple-fig1",
            Preset::Stipples(StipplePreset::Fig1),
            "Boundary, silhouette and curves of Lu et al., Fig. 1: the engine.",
        ),
        ChoiceOption::new("stipple-fig4", Preset::Stipples(StipplePreset::Fig4), "Resolution, Fig. 4: the leg."),
        ChoiceOption::new("stipple-fig5", Preset::Stipples(StipplePreset::Fig5), "Distance, Fig. 5: the engine."),
        ChoiceOption::new("stipple-fig6", Preset::Stipples(StipplePreset::Fig6), "Interior, Fig. 6: the bonsai."),
        ChoiceOption::new("stipple-fig7", Preset::Stipples(StipplePreset::Fig7), "Lighting, Fig. 7: the aneurysm."),
        ChoiceOption::new("stipple-fig8", Preset::Stipples(StipplePreset::Fig8), "Curves, Fig. 8: the foot."),
        ChoiceOption::new(
            "stipple-fig9",
            Preset::Stipples(StipplePreset::Fig9),
            "Silhouette, boundary, distance and curves, Fig. 9: the head.",
        ),
        ChoiceOption::new(
            "hatch",
            Preset::Hatch(HatchPreset::Plain),
            "Hatching for a pen of one width, crossed in the dark, with outlines.",
        ),
        ChoiceOption::new(
            "hatch-fig4",
            Preset::Hatch(HatchPreset::Fig4),
            "Lit strokes over a lit iso-surface, as in Fig. 4 of Nagy et al.",
        ),
        ChoiceOption::new(
            "hatch-fig5",
            Preset::Hatch(HatchPreset::Fig5),
            "Lit strokes alone, blue in front and yellow behind, Fig. 5.",
        ),
        ChoiceOption::new(
            "hatch-fig6-left",
            Preset::Hatch(HatchPreset::Fig6Left),
            "Strokes where the surface bends, crossed in the dark, as in Nagy et al., Fig. 6, left.",
        ),
        ChoiceOption::new(
            "hatch-fig6-right",
            Preset::Hatch(HatchPreset::Fig6Right),
            "A short stroke in every cell, Fig. 6, right.",
        ),
        ChoiceOption::new("outline", Preset::Outline, "Outlines alone, of what is opaque."),
        ChoiceOption::new(
            "toon",
            Preset::Toon(ToonPreset::Plain),
            "An iso-surface in three tones of its colour, with silhouettes.",
        ),
        ChoiceOption::new(
            "hatch-fig2",
            Preset::Toon(ToonPreset::Fig2),
            "The same in two tones, with the half-level lighting of Nagy et al., Fig. 2.",
        ),
        ChoiceOption::new(
            "halo",
            Preset::Halo(HaloPreset::Dark),
            "A lit function of colours with dark halos before what lies behind.",
        ),
        ChoiceOption::new(
            "halo-glow",
            Preset::Halo(HaloPreset::Glow),
            "A lit function of colours in a bright halo; the background is dark in a scene without `[picture]`.",
        ),
        ChoiceOption::new(
            "halo-lines",
            Preset::Halo(HaloPreset::Lines),
            "Black lines and white gaps by halos alone, as in Fig. 10 (d) of Bruckner and Gröller.",
        ),
    ],
};

impl Preset {
    /// Puts its tables into a scene.
    pub(super) fn supply(self, scene: &mut Scene) {
        match self {
            Self::Style => scene.transfer = Some(Transfer::automatic(TransferKind::Style)),
            Self::Stipples(preset) => {
                scene.stipples = Some(preset.table());
                scene.outlines = preset.outlines();
            }
            Self::Hatch(preset) => {
                scene.hatching = Some(preset.table());
                scene.outlines = preset.outlines();
                if let Some((surface, shading)) = preset.surface() {
                    (scene.surface, scene.shading) = (Some(surface), Some(shading));
                }
            }
            Self::Outline => scene.outlines = Some(Outlines::for_print()),
            Self::Toon(preset) => {
                let (surface, shading) = preset.tables();
                (scene.surface, scene.shading) = (Some(surface), Some(shading));
            }
            Self::Halo(preset) => preset.supply(scene),
        }
    }
}
