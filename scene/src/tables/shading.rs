//! `[shading]`: Blinn–Phong for a regular transfer function ([STF-11]).

use crate::file::check::Check;
use crate::file::describe::{Key, Kind, Later, Shape, Slot, Table};
use crate::file::item::{Item, Value};
use crate::file::kind::{Bounds, Choice, ChoiceOption, Number, Numbers, Rule, TableOf};
use crate::file::out::Out;
use crate::plan::Quantity;
use crate::tables::{Scene, SurfaceLook, TransferKind};
use glam::DVec3;
use serde_json::{Value as Json, json};

/// The table `[shading]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Shading {
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
        Self { ambient: 0.3, diffuse: 0.6, specular: 0.3, shininess: 30.0, light: None }
    }
}

/// Whether the scene has an iso-surface that is lit.
pub(super) fn lit_surface(scene: &Scene) -> bool {
    scene.surface.is_some_and(|surface| surface.look == SurfaceLook::Phong)
}

/// Whether a scene has something that `[shading]` acts on.
pub(super) fn lit(scene: &Scene) -> bool {
    scene.transfer.as_ref().is_some_and(|transfer| transfer.kind == TransferKind::Regular) || lit_surface(scene)
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
        Later { name: "view_opacity", tag: "HATCH-15" },
        Later { name: "toon", tag: "HATCH-15" },
        Later { name: "silhouette", tag: "HATCH-15" },
    ],
    asks: |scene, asks| {
        let lit = scene.transfer.as_ref().is_some_and(|transfer| transfer.kind == TransferKind::Regular);
        if lit && scene.shading.is_some() && asks.casts_rays() {
            asks.need(Quantity::Gradient, "shading", "shading");
        }
    },
    idle: |scene, _, idle| {
        let Some(shading) = &scene.shading else { return };
        let kind = scene.transfer.as_ref().map(|transfer| transfer.kind);
        if !lit_surface(scene) && kind == Some(TransferKind::Style) {
            idle.key("shading", "styles carry their own light: shading acts on a regular function");
        } else if !lit(scene) && scene.surface.is_some() {
            idle.key(
                "shading",
                "nothing is lit: it acts on a regular function, and on a surface with look = \"phong\"",
            );
        } else if shading.specular == 0.0 {
            idle.key("shading.shininess", "specular is 0");
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
                        options: &[ChoiceOption::new("phong", (), "Blinn–Phong.")],
                        later: &[("toon", "HATCH-15"), ("lighting-function", "VS-5")],
                    },
                    get: |_| Some(()),
                    set: |_, ()| {},
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
