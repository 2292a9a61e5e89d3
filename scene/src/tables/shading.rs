//! `[shading]`: light on a regular transfer function, Blinn–Phong ([STF-11]) or in tones ([HATCH-15]).

use crate::file::check::Check;
use crate::file::describe::{Key, Kind, Later, Shape, Slot, Table};
use crate::file::item::{Item, Value};
use crate::file::kind::{Bounds, Choice, ChoiceOption, Number, Numbers, Rule, TableOf};
use crate::file::out::Out;
use crate::plan::{Idle, Quantity};
use crate::tables::toon::{SHADING_SILHOUETTE, SHADING_TOON, VIEW_OPACITY};
use crate::tables::{Scene, SilhouetteShading, SurfaceLook, ToonShading, TransferKind};
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

/// Whether the scene has an iso-surface that is lit.
pub(super) fn lit_surface(scene: &Scene) -> bool {
    let lit = |look| matches!(look, SurfaceLook::Phong | SurfaceLook::Toon);
    scene.surface.as_ref().is_some_and(|surface| lit(surface.look))
}

/// Whether its transfer function has colours, which light falls on.
fn is_regular(scene: &Scene) -> bool {
    scene.transfer.as_ref().is_some_and(|transfer| transfer.kind == TransferKind::Regular)
}

/// Whether a scene has something that `[shading]` acts on.
pub(super) fn lit(scene: &Scene) -> bool {
    is_regular(scene) || lit_surface(scene)
}

/// Which keys say nothing although something is lit.
fn idle_keys(scene: &Scene, shading: &Shading, idle: &mut Idle) {
    let regular = is_regular(scene);
    let toon = shading.model == ShadingModel::Toon;
    let glossy = scene.surface.as_ref().is_some_and(|surface| surface.look == SurfaceLook::Phong);
    if glossy || (regular && !toon) {
        if shading.specular == 0.0 {
            idle.key("shading.shininess", "specular is 0");
        }
    } else {
        for key in ["shading.ambient", "shading.diffuse", "shading.specular", "shading.shininess"] {
            idle.key(key, "nothing is lit by Blinn–Phong: tones are the table toon's");
        }
    }
    if !regular {
        for key in ["shading.model", "shading.toon", "shading.silhouette", "shading.view_opacity"] {
            idle.key(key, "it acts on a regular function; a surface has keys of its own");
        }
    } else if !toon {
        idle.key("shading.toon", "model is \"phong\"");
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
    asks: |scene, asks| {
        let Some(shading) = scene.shading.as_ref().filter(|_| is_regular(scene) && asks.casts_rays()) else { return };
        match shading.tones() {
            None => asks.need(Quantity::Gradient, "shading", "shading"),
            Some(toon) if toon.reads_normals() => asks.need(Quantity::Gradient, "toon shading", "shading.model"),
            Some(_) => {}
        }
        if shading.silhouette.is_some() {
            asks.need(Quantity::Gradient, "silhouettes", "shading.silhouette");
        }
        if shading.view_opacity > 0.0 {
            asks.need(Quantity::Gradient, "view-dependent opacity", "shading.view_opacity");
        }
    },
    idle: |scene, _, idle| {
        let Some(shading) = &scene.shading else { return };
        let kind = scene.transfer.as_ref().map(|transfer| transfer.kind);
        if !lit_surface(scene) && kind == Some(TransferKind::Style) {
            idle.key("shading", "styles carry their own light: shading acts on a regular function");
        } else if !lit(scene) && scene.surface.is_some() {
            idle.key("shading", "nothing is lit: it acts on a regular function, and on a surface with a lit look");
        } else {
            idle_keys(scene, shading, idle);
        }
    },
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
