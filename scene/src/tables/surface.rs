//! `[surface]`: an opaque iso-surface in the picture ([HATCH-14], [HATCH-15]).

use crate::color::Rgba;
use crate::document::check::Check;
use crate::document::declare::{choices, table};
use crate::document::describe::{Kind, Shape, Table};
use crate::document::fault::Problem;
use crate::document::item::{Item, Value};
use crate::document::kind::{Colors, TableOf};
use crate::document::out::Out;
use crate::tables::toon::{SURFACE_SILHOUETTE, SURFACE_TOON, VIEW_OPACITY};
use crate::tables::{SilhouetteShading, ToonShading};
use serde_json::{Value as Json, json};

table! {
    /// The table `[surface]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Surface {
        /// The value; by itself that of the surface which an automatic transfer function makes opaque.
        iso: Iso = Iso::Auto, key("HATCH-14", IsoKind);
        /// Look of the surface.
        look: SurfaceLook = SurfaceLook::White, key("HATCH-14", SurfaceLook::KIND);
        /// Colour of a lit surface.
        ///
        /// Linear, opaque.
        color: Rgba = [1.0; 4], key("HATCH-14", Colors);
        /// The tones of look = "toon".
        toon: Option<ToonShading> = None,
            key("HATCH-15", TableOf(&SURFACE_TOON)).absent("offset 0 and two tones, `#404040` and white");
        /// Black where the surface turns away from the eye, on any look.
        silhouette: Option<SilhouetteShading> = None,
            key("HATCH-15", TableOf(&SURFACE_SILHOUETTE)).absent("no silhouettes");
        /// s of shading.view_opacity; the surface is opaque, and its opacity stays 1 for every s.
        view_opacity: f64 = 0.0, key("HATCH-15", VIEW_OPACITY);
    }
}

/// A value of the field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Iso {
    /// The value of the surface that an automatic transfer function makes opaque.
    Auto,
    /// A value as the file gives it ([VAL-1]).
    Value(f64),
}

choices! {
    /// How an iso-surface is drawn.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum SurfaceLook {
        /// White, unlit: it hides, and lines are drawn on it.
        White = "white",
        /// Lit, with the constants of [shading] or their defaults.
        Phong = "phong",
        /// In tones with hard steps between them, under the light of [shading] or the scene's.
        Toon = "toon",
        /// Not at all: it hides strokes alone.
        None = "none",
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
    ..Surface::description(
        "[surface]",
        "An opaque iso-surface, where the field first has a value along each ray; what lies behind it is not seen. \
         Without [transfer] it is drawn alone.",
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
