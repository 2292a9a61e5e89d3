//! `[shading]`: light on a regular transfer function, Blinn–Phong ([STF-11]) or in tones ([HATCH-15]).

use crate::document::check::Check;
use crate::document::describe::{Key, Kind, Later, Shape, Slot, Table};
use crate::document::item::{Item, Value};
use crate::document::kind::{Bounds, Choice, ChoiceOption, Number, Numbers, Rule, TableOf};
use crate::document::out::Out;
use crate::tables::toon::{SHADING_SILHOUETTE, SHADING_TOON, VIEW_OPACITY};
use crate::tables::{SilhouetteShading, ToonShading};
use glam::DVec3;
use serde_json::{Value as Json, json};

/// The table `[shading]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Shading {
    /// How light is reflected.
    pub model: ShadingModel,
    /// k_a.
    pub ambient: f64,
    /// k_d.
    pub diffuse: f64,
    /// k_s.
    pub specular: f64,
    /// s, the exponent.
    pub shininess: f64,
    /// Towards the light; none: the scene's.
    pub light: Option<LightDirection>,
    /// The tones of [`ShadingModel::Toon`]; none: two, of L·N > ½.
    pub toon: Option<ToonShading>,
    /// Silhouettes; none: none.
    pub silhouette: Option<SilhouetteShading>,
    /// s of the view-dependent opacity; 0: opacities are as they are.
    pub view_opacity: f64,
}

/// How light is reflected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadingModel {
    /// Blinn–Phong.
    Phong,
    /// In tones.
    Toon,
}

/// Towards the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightDirection {
    /// Eye space (0, 0, 1) at every sample.
    Head,
    /// Eye space, any length.
    Eye(DVec3),
    /// World space, any length.
    World(DVec3),
}

impl Default for Shading {
    fn default() -> Self {
        Self {
            model: ShadingModel::Phong,
            ambient: 0.3,
            diffuse: 0.6,
            specular: 0.3,
            shininess: 30.0,
            light: None,
            toon: None,
            silhouette: None,
            view_opacity: 0.0,
        }
    }
}

impl Shading {
    /// The tones of [`ShadingModel::Toon`]; none under another model.
    pub fn tones(&self) -> Option<ToonShading> {
        (self.model == ShadingModel::Toon).then(|| self.toon.clone().unwrap_or_default())
    }
}

/// A share of light.
const SHARE: Number = Number { bounds: Bounds::NOT_NEGATIVE, unit: "" };

/// The description of `[shading]`.
pub(crate) static TABLE: Table<Shading> = Table {
    later: &[
        Later { name: "preset", tag: "VS-5" },
        Later { name: "table", tag: "VS-5" },
        Later { name: "contour", tag: "VS-5" },
        Later { name: "divisor_floor", tag: "VS-5" },
    ],
    ..Table::new(
        "[shading]",
        "Light on a regular transfer function, and on a lit iso-surface. Without the table the function is unshaded.",
        Shading::default,
        &[
            Key::new(
                "model",
                "STF-11",
                "How light is reflected.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("phong", ShadingModel::Phong, "Blinn–Phong."),
                            ChoiceOption::new("toon", ShadingModel::Toon, "In tones with hard steps between them."),
                        ],
                        later: &[("lighting-function", "VS-5")],
                    },
                    get: |s: &Shading| Some(s.model),
                    set: |s, v| s.model = v,
                },
            ),
            Key::new(
                "ambient",
                "STF-11",
                "k_a.",
                &Slot { kind: SHARE, get: |s: &Shading| Some(s.ambient), set: |s, v| s.ambient = v },
            ),
            Key::new(
                "diffuse",
                "STF-11",
                "k_d.",
                &Slot { kind: SHARE, get: |s: &Shading| Some(s.diffuse), set: |s, v| s.diffuse = v },
            ),
            Key::new(
                "specular",
                "STF-11",
                "k_s.",
                &Slot { kind: SHARE, get: |s: &Shading| Some(s.specular), set: |s, v| s.specular = v },
            ),
            Key::new(
                "shininess",
                "STF-11",
                "s, the exponent of the highlight.",
                &Slot { kind: SHARE, get: |s: &Shading| Some(s.shininess), set: |s, v| s.shininess = v },
            ),
            Key::new(
                "light",
                "STF-11",
                "Towards the light.",
                &Slot { kind: Light, get: |s: &Shading| s.light, set: |s, v| s.light = Some(v) },
            )
            .absent("the scene's `light`"),
            Key::new(
                "toon",
                "HATCH-15",
                "The tones of model = \"toon\".",
                &Slot { kind: TableOf(&SHADING_TOON), get: |s: &Shading| s.toon.clone(), set: |s, v| s.toon = Some(v) },
            )
            .absent("offset 0 and two tones, `#404040` and white"),
            Key::new(
                "silhouette",
                "HATCH-15",
                "Black where the surface turns away from the eye, under any model.",
                &Slot {
                    kind: TableOf(&SHADING_SILHOUETTE),
                    get: |s: &Shading| s.silhouette,
                    set: |s, v| s.silhouette = Some(v),
                },
            )
            .absent("no silhouettes"),
            Key::new(
                "view_opacity",
                "HATCH-15",
                "s: opacities become 1 − (1 − α)^(1 + s(1/|N·V| − 1)), more opaque where the surface turns away from \
                 the eye.",
                &Slot { kind: VIEW_OPACITY, get: |s: &Shading| Some(s.view_opacity), set: |s, v| s.view_opacity = v },
            ),
        ],
    )
};

/// `"head"`, a direction in eye space, or `{ world = [x, y, z] }`.
pub(crate) struct Light;

/// A direction of any length.
const DIRECTION: Numbers<3> = Numbers { what: "a direction [x, y, z]", bounds: Bounds::ANY, rule: Rule::Direction };

/// The description of `{ world = [x, y, z] }`.
static WORLD: Table<[f64; 3]> = Table::new(
    "light",
    "A light that stands in the world.",
    || [0.0, 0.0, 1.0],
    &[Key::new(
        "world",
        "STF-11",
        "Towards the light, in world space.",
        &Slot { kind: DIRECTION, get: |v: &[f64; 3]| Some(*v), set: |v, new| *v = new },
    )
    .required()],
);

impl Shape for Light {
    fn expected(&self) -> String {
        "\"head\", a direction [x, y, z] in eye space that is not all 0, or { world = [x, y, z] }".into()
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [{ "const": "head" }, DIRECTION.schema(), TableOf(&WORLD).schema()] })
    }
}

impl Kind for Light {
    type Of = LightDirection;

    fn read(&self, item: &Item, check: &mut Check) -> Option<LightDirection> {
        match &item.value {
            Value::Text(text) if text == "head" => Some(LightDirection::Head),
            Value::Table(_) => check.table(&WORLD, item).map(|v| LightDirection::World(DVec3::from_array(v))),
            _ => match DIRECTION.of(item) {
                Some(v) => Some(LightDirection::Eye(DVec3::from_array(v))),
                None => check.wrong(item, self.expected()),
            },
        }
    }

    fn write(&self, value: &LightDirection) -> Out {
        match value {
            LightDirection::Head => Out::Text("head".into()),
            LightDirection::Eye(v) => Out::numbers(&v.to_array()),
            LightDirection::World(v) => Out::Table(vec![("world".into(), Out::numbers(&v.to_array()))]),
        }
    }
}
