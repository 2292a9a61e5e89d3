//! `[shading]`: light on a regular transfer function, Blinn–Phong ([STF-11]), in tones ([HATCH-15]) or by a table
//! ([VS-5]).

use crate::document::check::Check;
use crate::document::declare::{choices, table};
use crate::document::describe::{Kind, Shape, Table};
use crate::document::fault::Problem;
use crate::document::item::{Item, Value};
use crate::document::kind::{Bounds, End, Number, Numbers, PathTo, Rule, TableOf};
use crate::document::out::Out;
use crate::lighting::{ContourRule, LightingFile, LightingPreset};
use crate::quantity::Quantity;
use crate::tables::toon::{SHADING_SILHOUETTE, SHADING_TOON, VIEW_OPACITY};
use crate::tables::{SilhouetteShading, ToonShading};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};

table! {
    /// The table `[shading]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Shading {
        /// How light is reflected.
        model: ShadingModel = ShadingModel::Phong, key("STF-11", ShadingModel::KIND);
        /// k_a.
        ambient: f64 = 0.3, key("STF-11", SHARE);
        /// k_d.
        diffuse: f64 = 0.6, key("STF-11", SHARE);
        /// k_s.
        specular: f64 = 0.3, key("STF-11", SHARE);
        /// s, the exponent of the highlight.
        shininess: f64 = 30.0, key("STF-11", SHARE);
        /// Towards the light.
        light: Option<LightDirection> = None, key("STF-11", Light).absent("the scene's `light`");
        /// The table of model = "lighting-function" that is generated.
        preset: Option<LightingPreset> = None,
            key("VS-5", LightingPreset::KIND)
                .absent("`\"blinn-phong\"` without `table`").needs(&[Quantity::GradientMagnitudeRange]);
        /// The table of model = "lighting-function" as a picture of 8 or 16 bits: columns from N·L = −1 to 1, rows from
        /// N·Ĥ = 1 down to −1; red, green, blue and alpha are ambient, diffuse, specular and opacity enhancement.
        table: Option<LightingFile> = None,
            key(
                "VS-5",
                LIGHTING_TABLE,
                |shading: &Shading| shading.table.as_ref().map(|file| file.path.clone()),
                |shading, path| shading.table = Some(LightingFile { path, table: None })
            ).absent("the preset's").needs(&[Quantity::GradientMagnitudeRange]);
        /// The rule for the contours of a preset of model = "lighting-function".
        contour: ContourRule = ContourRule::Exact, key("VS-5", ContourRule::KIND);
        /// s_min: model = "lighting-function" divides opacities by at least this number.
        divisor_floor: f64 = 0.015625, key("VS-5", DIVISOR);
        /// The tones of model = "toon".
        toon: Option<ToonShading> = None,
            key("HATCH-15", TableOf(&SHADING_TOON)).absent("offset 0 and two tones, `#404040` and white");
        /// Black where the surface turns away from the eye, under any model.
        silhouette: Option<SilhouetteShading> = None,
            key("HATCH-15", TableOf(&SHADING_SILHOUETTE)).absent("no silhouettes");
        /// s: opacities become 1 − (1 − α)^(1 + s(1/|N·V| − 1)), more opaque where the surface turns away from the eye.
        view_opacity: f64 = 0.0, key("HATCH-15", VIEW_OPACITY);
    }
}

choices! {
    /// How light is reflected.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ShadingModel {
        /// Blinn–Phong.
        Phong = "phong",
        /// In tones with hard steps between them.
        Toon = "toon",
        /// By a table over N·L and N·Ĥ, which also enhances opacities: a lighting transfer function.
        Function = "lighting-function",
    }
}

/// Towards the light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightDirection {
    /// Eye space (0, 0, 1) at every sample.
    #[default]
    Head,
    /// Eye space, any length.
    Eye(DVec3),
    /// World space, any length.
    World(DVec3),
}

impl Shading {
    /// The tones of [`ShadingModel::Toon`]; none under another model.
    pub fn tones(&self) -> Option<ToonShading> {
        (self.model == ShadingModel::Toon).then(|| self.toon.clone().unwrap_or_default())
    }

    /// The preset of [`ShadingModel::Function`]; none under another model, and with a table of a file.
    pub fn lighting_preset(&self) -> Option<LightingPreset> {
        let generated = self.model == ShadingModel::Function && self.table.is_none();
        generated.then(|| self.preset.unwrap_or(LightingPreset::BlinnPhong))
    }

    /// The file of the table of [`ShadingModel::Function`]; none under another model, and with a preset.
    pub fn lighting_file(&self) -> Option<&LightingFile> {
        self.table.as_ref().filter(|_| self.model == ShadingModel::Function)
    }

    /// Whether opacities depend on |g|.
    pub fn reads_magnitude(&self) -> bool {
        self.lighting_file().is_some() || self.lighting_preset().is_some_and(LightingPreset::reads_magnitude)
    }
}

/// The picture of a lighting table.
const LIGHTING_TABLE: PathTo = PathTo { what: "a picture" };

/// A divisor of opacities that makes none smaller.
const DIVISOR: Number = Number { bounds: Bounds { lo: End::Out(0.0), hi: End::In(1.0) }, unit: "" };

/// A share of light.
const SHARE: Number = Number { bounds: Bounds::NOT_NEGATIVE, unit: "" };

/// The description of `[shading]`.
pub(crate) static TABLE: Table<Shading> = Table {
    check: |_, check| {
        if check.has("preset") && check.has("table") {
            let what = "shading has both preset and table".into();
            let remedy = "keep one of them: a preset's table is generated".into();
            check.fault_in("table", Problem::Contradiction { what, remedy });
        }
    },
    ..Shading::description(
        "[shading]",
        "Light on a regular transfer function, and on a lit iso-surface. Without the table the function is unshaded.",
    )
};

/// `"head"`, a direction in eye space, or `{ world = [x, y, z] }`.
pub(crate) struct Light;

/// A direction of any length.
const DIRECTION: Numbers<3> = Numbers { what: "a direction [x, y, z]", bounds: Bounds::ANY, rule: Rule::Direction };

table! {
    /// `{ world = [x, y, z] }`.
    struct WorldLight {
        /// Towards the light, in world space.
        world: DVec3 = DVec3::Z, key("STF-11", DIRECTION).required();
    }
}

/// The description of `{ world = [x, y, z] }`.
static WORLD: Table<WorldLight> = WorldLight::description("light", "A light that stands in the world.");

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
            Value::Table(_) => check.table(&WORLD, item).map(|light| LightDirection::World(light.world)),
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
