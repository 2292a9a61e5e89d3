//! `[shading.toon]`, `[shading.silhouette]`, and the same of `[surface]` ([HATCH-15]).

use crate::color::{Rgba, opaque};
use crate::document::check::Check;
use crate::document::declare::table;
use crate::document::describe::{Kind, Shape, Table};
use crate::document::fault::Problem;
use crate::document::item::Item;
use crate::document::kind::{Bounds, Colors, FEW, ListOf, Number};
use crate::document::out::Out;
use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};

table! {
    /// A table `toon`: tones with hard steps between them.
    ///
    /// The tone of x = L·N + offset is the last one whose `at` is below x, and the first one where none is. So `at` of
    /// the first tone has no effect, and the two tones of the default part at L·N + offset = ½.
    #[derive(Clone, Debug, PartialEq)]
    pub struct ToonShading {
        /// Added to L·N. With the two default tones, 0 ends the light at 60° from it, 0.5 at 90°.
        offset: f64 = 0.0, key("HATCH-15", OFFSET);
        /// Factors of colours, each tone where L·N + offset is above its `at`; the first also below.
        tones: Vec<Tone> = vec![Tone { at: 0.0, color: opaque([64.0; 3]) }, Tone { at: 0.5, color: [1.0; 4] }],
            key("HATCH-15", ListOf { what: "a list of tones", most: FEW, each: ToneKind });
    }
}

/// One tone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tone {
    /// Start of the tone, in x = L·N + offset; this x itself still has the tone before.
    pub at: f64,
    /// Factor of the colour: linear, opaque.
    pub color: Rgba,
}

table! {
    /// A table `silhouette`: black where (N·V)² + offset ≤ ½.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct SilhouetteShading {
        /// Black where (N·V)² + offset ≤ 0.5: of a sphere's disc the share 0.5 − offset.
        offset: f64 = 0.45, key("HATCH-15", OFFSET);
    }
}

impl ToonShading {
    /// Whether the tone can depend on the normal, which a single tone does not.
    pub fn reads_normals(&self) -> bool {
        self.tones.len() > 1
    }
}

/// s of α' = 1 − (1 − α)^(1 + s(1/|N·V| − 1)): a key of two tables.
pub(super) const VIEW_OPACITY: Number = Number { bounds: Bounds::NOT_NEGATIVE, unit: "" };

/// An offset.
const OFFSET: Number = Number { bounds: Bounds::ANY, unit: "" };

/// `[at, colour]`.
struct ToneKind;

impl Shape for ToneKind {
    fn expected(&self) -> String {
        "[at, color], a number and a colour".into()
    }

    fn schema(&self) -> Json {
        let either = json!({ "anyOf": [{ "type": "number" }, Colors.schema()] });
        json!({ "type": "array", "items": either, "minItems": 2, "maxItems": 2 })
    }
}

impl Kind for ToneKind {
    type Of = Tone;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Tone> {
        match item.list() {
            Some([at, color]) => {
                let Some(at) = at.number() else { return check.wrong(item, self.expected()) };
                Colors.read(color, check).map(|color| Tone { at, color })
            }
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, tone: &Tone) -> Out {
        Out::List(vec![Out::Number(tone.at), Colors.write(&tone.color)])
    }
}

const fn toon(title: &'static str) -> Table<ToonShading> {
    Table { check: check_tones, ..ToonShading::description(title, "Tones with hard steps, by the angle to the light.") }
}

const fn silhouette(title: &'static str) -> Table<SilhouetteShading> {
    SilhouetteShading::description(title, "Black where the surface turns away from the eye.")
}

/// The description of `[shading.toon]`.
pub(super) static SHADING_TOON: Table<ToonShading> = toon("[shading.toon]");
/// The description of `[shading.silhouette]`.
pub(super) static SHADING_SILHOUETTE: Table<SilhouetteShading> = silhouette("[shading.silhouette]");
/// The description of `[surface.toon]`.
pub(super) static SURFACE_TOON: Table<ToonShading> = toon("[surface.toon]");
/// The description of `[surface.silhouette]`.
pub(super) static SURFACE_SILHOUETTE: Table<SilhouetteShading> = silhouette("[surface.silhouette]");

/// Each tone begins beyond the one before, and is opaque.
fn check_tones(toon: &ToonShading, check: &mut Check) {
    if !check.sound(&["tones"]) {
        return;
    }
    for (i, tone) in toon.tones.iter().enumerate() {
        let mut contradiction = |what: String, remedy: &str| {
            let problem = Problem::Contradiction { what, remedy: remedy.into() };
            check.fault_in(&format!("tones[{i}]"), problem);
        };
        if tone.color[3] != 1.0 {
            let what = format!("tone {i} has an opacity, and a tone is what a colour is multiplied by");
            contradiction(what, "write it as \"#rrggbb\"; what is translucent is a matter of [transfer]");
        }
        if i > 0 && tone.at <= toon.tones[i - 1].at {
            let what = format!("tone {i} begins at {}, and the one before at {}", tone.at, toon.tones[i - 1].at);
            contradiction(what, "put the tones in ascending order of `at`");
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::file::{Overrides, parse};
    use crate::plan::{Plan, Quantity};
    use crate::tables::{Scene, ShadingModel};
    use std::path::Path;

    fn scene(rest: &str) -> Result<Scene, String> {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{rest}");
        parse(&text, Path::new("s"), &Overrides::default()).map_err(|faults| faults.to_string())
    }

    const REGULAR: &str = "[transfer]\nkind = \"regular\"\n[shading]\n";

    fn needs(rest: &str) -> Vec<(Quantity, String)> {
        let plan = Plan::new(&scene(rest).unwrap());
        plan.needs.iter().filter(|n| n.quantity != Quantity::Value).map(|n| (n.quantity, n.key.clone())).collect()
    }

    fn idle(rest: &str) -> Vec<String> {
        Plan::new(&scene(rest).unwrap()).idle_keys.into_iter().map(|idle| idle.key).collect()
    }

    #[test]
    fn the_defaults_are_the_two_tones_of_the_format() {
        let read = scene(&format!(
            "{REGULAR}model = \"toon\"\ntoon = {{ offset = 0.0, tones = [[0, \"#404040\"], [0.5, \"white\"]] }}\n\
             silhouette = {{ offset = 0.45 }}\nview_opacity = 0.0\n"
        ))
        .unwrap();
        let shading = read.shading.unwrap();
        assert_eq!(shading.model, ShadingModel::Toon);
        assert_eq!(shading.toon, Some(super::ToonShading::default()));
        assert_eq!(shading.silhouette, Some(super::SilhouetteShading::default()));
    }

    /// Each effect asks for the normal and nothing else, and one tone for nothing.
    #[test]
    fn normals_alone_are_asked_for() {
        let gradient = |key: &str| vec![(Quantity::Gradient, key.to_owned())];
        assert_eq!(needs(&format!("{REGULAR}model = \"toon\"\n")), gradient("shading.model"));
        let one = "model = \"toon\"\ntoon.tones = [[0, \"white\"]]\n";
        assert_eq!(needs(&format!("{REGULAR}{one}")), []);
        assert_eq!(needs(&format!("{REGULAR}{one}silhouette = {{}}\n")), gradient("shading.silhouette"));
        assert_eq!(needs(&format!("{REGULAR}{one}view_opacity = 1\n")), gradient("shading.view_opacity"));
        let of_surface = |key: &str| vec![(Quantity::Surface, "surface".into()), (Quantity::SurfaceNormal, key.into())];
        assert_eq!(needs("[surface]\niso = 1\nlook = \"toon\"\n"), of_surface("surface.look"));
        assert_eq!(needs("[surface]\niso = 1\nsilhouette = {}\n"), of_surface("surface.silhouette"));
        assert_eq!(needs("[surface]\niso = 1\n").len(), 1);
    }

    #[test]
    fn keys_without_effect_are_told() {
        assert_eq!(idle(&format!("{REGULAR}[shading.toon]\noffset = 1\n")), ["shading.toon"]);
        assert_eq!(
            idle(&format!("{REGULAR}model = \"toon\"\nambient = 0\nshininess = 3\n")),
            ["shading.ambient", "shading.shininess"]
        );
        let opaque = "[surface]\niso = 1\nlook = \"toon\"\ncolor = \"red\"\n";
        assert_eq!(idle(opaque), [""; 0]);
        assert_eq!(idle(&format!("{opaque}view_opacity = 1\n")), ["surface.view_opacity"]);
        assert_eq!(idle("[surface]\niso = 1\n[surface.toon]\noffset = 1\n"), ["surface.toon"]);
        assert_eq!(idle("[transfer]\n[shading]\nmodel = \"toon\"\n"), ["shading"]);
        // The light of a surface is that of [shading] or of the scene.
        assert_eq!(idle(&format!("light = [0, 0, 1]\n{opaque}").replace("light", "[shading]\nlight")), [""; 0]);
    }

    /// Tables that the file has take the place of the preset's.
    #[test]
    fn presets_supply_tables() {
        let given = |rest: &str| scene(rest).unwrap();
        for (name, tones, offset) in [("toon", 3, 0.0), ("hatch-fig2", 2, 0.5)] {
            let text = format!("drypoint = 1\npreset = \"{name}\"\nvolume.file = \"a\"\n");
            let read = |rest: &str| parse(&format!("{text}{rest}"), Path::new("s"), &Overrides::default()).unwrap();
            let whole = read("");
            let toon = whole.surface.as_ref().unwrap().tones().unwrap();
            assert_eq!((toon.tones.len(), toon.offset), (tones, offset));
            assert_eq!((whole.transfer.as_ref(), &Plan::new(&whole).idle_keys[..]), (None, &[][..]));
            let own = read("[surface]\niso = 3\n");
            assert_eq!(own.surface, given("[surface]\niso = 3\n").surface);
            assert_eq!(own.shading, whole.shading);
            assert_eq!(Plan::new(&read("[surface]\n[shading]\n")).idle_keys[0].key, "preset");
        }
    }

    #[test]
    fn tones_ascend_and_are_opaque() {
        let fault = |tones: &str| scene(&format!("{REGULAR}model = \"toon\"\ntoon.tones = {tones}\n")).unwrap_err();
        assert_eq!(
            fault("[[0, \"black\"], [0, \"white\"]]"),
            "tone 1 begins at 0, and the one before at 0\n  at s:8:29, key shading.toon.tones[1]\n  \
             put the tones in ascending order of `at`"
        );
        assert!(fault("[[0, \"#00000080\"]]").starts_with("tone 0 has an opacity"));
        for wrong in ["[]", "[[0]]", "[[\"red\", 0]]", "[[0, \"rot\"]]", "3", "[[nan, \"red\"]]"] {
            assert!(fault(wrong).contains("shading.toon.tones"), "{wrong}");
        }
        let negative = scene(&format!("{REGULAR}view_opacity = -1\n")).unwrap_err();
        assert!(negative.contains("write a number of at least 0"), "{negative}");
    }
}
