//! `[surface]`: an opaque iso-surface in the picture ([HATCH-14], [HATCH-15]).

use crate::color::Rgba;
use crate::document::check::Check;
use crate::document::describe::{Key, Kind, Shape, Slot, Table};
use crate::document::fault::Problem;
use crate::document::item::{Item, Value};
use crate::document::kind::{Choice, ChoiceOption, Colors, TableOf};
use crate::document::out::Out;
use crate::tables::toon::{SURFACE_SILHOUETTE, SURFACE_TOON, VIEW_OPACITY};
use crate::tables::{SilhouetteShading, ToonShading};
use serde_json::{Value as Json, json};

/// The table `[surface]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Where it lies.
    pub iso: Iso,
    /// How it is drawn.
    pub look: SurfaceLook,
    /// Of a lit surface: linear, opaque.
    pub color: Rgba,
    /// The tones of [`SurfaceLook::Toon`]; none: two, of L·N > ½.
    pub toon: Option<ToonShading>,
    /// Silhouettes on any look; none: none.
    pub silhouette: Option<SilhouetteShading>,
    /// s of the view-dependent opacity, which leaves an opacity of 1 as it is.
    pub view_opacity: f64,
}

/// A value of the field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Iso {
    /// That of the surface which an automatic transfer function makes opaque.
    Auto,
    /// A value as the file gives it ([VAL-1]).
    Value(f64),
}

/// How an iso-surface is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceLook {
    /// White everywhere, under any light.
    White,
    /// Blinn–Phong.
    Phong,
    /// In tones ([HATCH-15]).
    Toon,
    /// Not at all.
    None,
}

impl Default for Surface {
    fn default() -> Self {
        Self {
            iso: Iso::Auto,
            look: SurfaceLook::White,
            color: [1.0; 4],
            toon: None,
            silhouette: None,
            view_opacity: 0.0,
        }
    }
}

impl Surface {
    /// The tones of [`SurfaceLook::Toon`]; none under another look.
    pub fn tones(&self) -> Option<ToonShading> {
        (self.look == SurfaceLook::Toon).then(|| self.toon.clone().unwrap_or_default())
    }
}

/// A number, or `"auto"`.
pub(crate) struct IsoKind;

impl Shape for IsoKind {
    fn expected(&self) -> String {
        "a value of the volume, or \"auto\"".into()
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [{ "type": "number" }, { "const": "auto" }] })
    }
}

impl Kind for IsoKind {
    type Of = Iso;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Iso> {
        match &item.value {
            Value::Text(text) if text == "auto" => Some(Iso::Auto),
            _ => match item.number() {
                Some(value) => Some(Iso::Value(value)),
                None => check.wrong(item, self.expected()),
            },
        }
    }

    fn write(&self, value: &Iso) -> Out {
        match value {
            Iso::Auto => Out::Text("auto".into()),
            Iso::Value(value) => Out::Number(*value),
        }
    }
}

/// The description of `[surface]`.
pub(crate) static TABLE: Table<Surface> = Table {
    check: |surface, check| {
        if surface.color[3] != 1.0 && check.sound(&["color"]) {
            let what = "surface.color has an opacity, and the surface is opaque".into();
            let remedy = "write it as \"#rrggbb\"; what is translucent is a matter of [transfer]".into();
            check.fault_in("color", Problem::Contradiction { what, remedy });
        }
    },
    ..Table::new(
        "[surface]",
        "An opaque iso-surface, where the field first has a value along each ray; what lies behind it is not seen. \
         Without [transfer] it is drawn alone.",
        Surface::default,
        &[
            Key::new(
                "iso",
                "HATCH-14",
                "The value; by itself that of the surface which an automatic transfer function makes opaque.",
                &Slot { kind: IsoKind, get: |s: &Surface| Some(s.iso), set: |s, v| s.iso = v },
            ),
            Key::new(
                "look",
                "HATCH-14",
                "How it is drawn.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new(
                                "white",
                                SurfaceLook::White,
                                "White, unlit: it hides, and lines are drawn on it.",
                            ),
                            ChoiceOption::new(
                                "phong",
                                SurfaceLook::Phong,
                                "Lit, with the constants of [shading] or their defaults.",
                            ),
                            ChoiceOption::new(
                                "toon",
                                SurfaceLook::Toon,
                                "In tones with hard steps between them, under the light of [shading] or the scene's.",
                            ),
                            ChoiceOption::new("none", SurfaceLook::None, "Not at all: it hides strokes alone."),
                        ],
                        later: &[],
                    },
                    get: |s: &Surface| Some(s.look),
                    set: |s, v| s.look = v,
                },
            ),
            Key::new(
                "color",
                "HATCH-14",
                "Of a lit surface.",
                &Slot { kind: Colors, get: |s: &Surface| Some(s.color), set: |s, v| s.color = v },
            ),
            Key::new(
                "toon",
                "HATCH-15",
                "The tones of look = \"toon\".",
                &Slot { kind: TableOf(&SURFACE_TOON), get: |s: &Surface| s.toon.clone(), set: |s, v| s.toon = Some(v) },
            )
            .absent("offset 0 and two tones, `#404040` and white"),
            Key::new(
                "silhouette",
                "HATCH-15",
                "Black where the surface turns away from the eye, on any look.",
                &Slot {
                    kind: TableOf(&SURFACE_SILHOUETTE),
                    get: |s: &Surface| s.silhouette,
                    set: |s, v| s.silhouette = Some(v),
                },
            )
            .absent("no silhouettes"),
            Key::new(
                "view_opacity",
                "HATCH-15",
                "s of shading.view_opacity; the surface is opaque, and its opacity stays 1 for every s.",
                &Slot { kind: VIEW_OPACITY, get: |s: &Surface| Some(s.view_opacity), set: |s, v| s.view_opacity = v },
            ),
        ],
    )
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::{Overrides, parse};
    use crate::plan::{Pass, Plan};
    use crate::quantity::Quantity;
    use crate::tables::Scene;
    use std::path::Path;

    fn scene(rest: &str) -> Result<Scene, String> {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{rest}");
        parse(&text, Path::new("scene.toml"), &Overrides::default()).map_err(|faults| faults.to_string())
    }

    #[test]
    fn a_surface_alone_draws_no_volume_and_asks_for_what_it_needs() {
        let white = scene("[surface]\niso = 12.5\n").unwrap();
        assert_eq!((white.transfer, white.surface.unwrap().iso), (None, Iso::Value(12.5)));
        let needs = |rest: &str| Plan::new(&scene(rest).unwrap()).needs.iter().map(|n| n.quantity).collect::<Vec<_>>();
        assert_eq!(needs("[surface]\n"), [Quantity::Surface]);
        assert_eq!(needs("[surface]\nlook = \"phong\"\n"), [Quantity::Surface, Quantity::SurfaceNormal]);
        assert_eq!(needs("[surface]\nlook = \"none\"\n"), []);
        let automatic = |rest: &str| Plan::new(&scene(rest).unwrap()).has_pass(Pass::AutomaticIso);
        assert_eq!((automatic("[surface]\n"), automatic("[surface]\niso = 3\n")), (true, false));
    }

    #[test]
    fn keys_without_effect_are_told() {
        let idle = |rest: &str| -> Vec<String> {
            Plan::new(&scene(rest).unwrap()).idle_keys.into_iter().map(|idle| idle.key).collect()
        };
        assert_eq!(idle("[surface]\ncolor = \"red\"\n[shading]\n"), ["surface.color", "shading"]);
        let lit = "light = [0, 0, 1]\n[volume.phantom]\nname = \"torus\"\n";
        let all =
            format!("drypoint = 1\n{lit}[surface]\nlook = \"phong\"\n[sampling]\nnormal = \"facing\"\n[shading]\n");
        let read = parse(&all, Path::new("s"), &Overrides::default()).unwrap();
        assert_eq!(Plan::new(&read).idle_keys, []);
        assert_eq!(idle("[surface]\nlook = \"none\"\n"), ["surface"]);
    }

    #[test]
    fn a_surface_is_opaque() {
        let text = scene("[surface]\nlook = \"phong\"\ncolor = \"#ff000080\"\n").unwrap_err();
        assert!(text.starts_with("surface.color has an opacity, and the surface is opaque\n"), "{text}");
        let text = scene("[surface]\niso = \"high\"\n").unwrap_err();
        assert!(text.contains("write a value of the volume, or \"auto\""), "{text}");
    }
}
