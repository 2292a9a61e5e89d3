//! The description of a whole scene file ([SCN-1], [SCN-3]).

use super::preset::PRESETS;
use super::{
    Scene, VolumeSource, camera, contours, hatching, orbit, outlines, page, pen, picture, sampling, shading, stipples,
    style_mipmaps, styles, surface, transfer, volume,
};
use crate::document::check::Check;
use crate::document::declare::key;
use crate::document::describe::{Key, Kind, Later, Shape, Slot, Table};
use crate::document::item::{Item, Value};
use crate::document::kind::{ListOf, TableOf};
use crate::document::out::Out;
use crate::quantity::Quantity;
use serde_json::{Value as Json, json};
use std::path::PathBuf;

/// The version of the format.
const VERSION: i64 = 1;

/// `drypoint = 1`.
struct Version;

impl Shape for Version {
    fn expected(&self) -> String {
        format!("{VERSION}, the version of the format that this program reads")
    }

    fn schema(&self) -> Json {
        json!({ "const": VERSION })
    }
}

impl Kind for Version {
    type Of = ();

    fn read(&self, item: &Item, check: &mut Check) -> Option<()> {
        if item.value == Value::Whole(VERSION) { Some(()) } else { check.wrong(item, self.expected()) }
    }

    fn write(&self, (): &()) -> Out {
        Out::Whole(VERSION as u64)
    }
}

/// A part of the format that is not built yet.
const fn later(name: &'static str, tag: &'static str) -> Later {
    Later { name, tag }
}

/// The whole file.
pub(crate) static ROOT: Table<Scene> = Table {
    later: &[
        later("halo", "HALO-1"),
        later("combine", "VS-3"),
        later("object", "VS-2"),
        later("intersection", "VS-4"),
        later("mesh", "VS-12"),
        later("box", "VS-8"),
        later("arrow", "VS-8"),
        later("fan", "VS-10"),
        later("label", "VS-10"),
        later("conventions", "GPU-6"),
    ],
    ..Table::new(
        "a scene",
        "A scene file is TOML. A table is an effect: what has no table does not exist for the picture and is not \
         computed. Lengths are numbers in world units or texts with a unit, angles are in degrees, colours sRGB, and \
         paths relative to the scene file.",
        || Scene::without_effects(VolumeSource::File { path: PathBuf::new(), raw: None }),
        &[
            Key::new(
                "drypoint",
                "",
                "Version of the format.",
                &Slot { kind: Version, get: |_| Some(()), set: |_, ()| {} },
            )
            .required(),
            Key::new(
                "preset",
                "SCN-3",
                "Whole tables for a scene that lacks them.",
                &Slot {
                    kind: PRESETS,
                    get: |_| None,
                    // It is read before the tables, of which each that the file has takes the place of the preset's.
                    set: |scene: &mut Scene, preset| preset.supply(scene),
                },
            )
            .absent("\"style\" where the scene draws nothing else"),
            key!(
                Scene.light,
                "Towards the light, for all that is lit; a table's own `light` wins.",
                "STF-11",
                shading::Light
            ),
            key!(Scene.volume, "The data that is seen.", "IO-1", TableOf(&volume::TABLE)).required(),
            key!(Scene.camera, "From where the volume is seen.", "RAY-5", TableOf(&camera::TABLE)),
            key!(Scene.orbit, "Several frames about the volume.", "STIP-4", TableOf(&orbit::TABLE)).absent("one frame"),
            key!(Scene.picture, "What the picture is drawn on.", "RAY-6", TableOf(&picture::TABLE)),
            key!(Scene.page, "The paper that points and lines are drawn on.", "IO-7", TableOf(&page::TABLE))
                .absent("no margin, no plotter"),
            Key::new(
                "pen",
                "IO-7",
                "The pens that points and lines are drawn with; layers are numbered in their order.",
                &Slot {
                    kind: ListOf { what: "a list of pens", each: TableOf(&pen::TABLE) },
                    get: |s: &Scene| (!s.pens.is_empty()).then(|| s.pens.clone()),
                    set: |s, v| s.pens = v,
                },
            )
            .absent("none"),
            key!(
                Scene.sampling,
                "How the field is reconstructed and where it is sampled.",
                "RAY-1",
                TableOf(&sampling::TABLE)
            ),
            key!(
                Scene.transfer,
                "Colours or styles, and opacities, over the values.",
                "STF-3",
                TableOf(&transfer::TABLE)
            )
            .absent("the preset's")
            .needs(&[Quantity::Value]),
            key!(
                Scene.styles,
                "The lit-sphere pictures that a transfer function names.",
                "STF-12",
                TableOf(&styles::TABLE)
            ),
            key!(
                Scene.shading,
                "Light on a regular transfer function, and on a lit iso-surface.",
                "STF-11",
                TableOf(&shading::TABLE)
            )
            .absent("unshaded")
            .needs(&[Quantity::Gradient]),
            key!(Scene.contours, "Style contours of controlled thickness.", "STF-6", TableOf(&contours::TABLE))
                .absent("no contours"),
            key!(
                Scene.style_mipmaps,
                "Styles read at the level of detail that the picture can show.",
                "STF-10",
                TableOf(&style_mipmaps::TABLE)
            )
            .absent("no mip-maps"),
            key!(Scene.stipples, "Stippling: dots on the volume's boundaries.", "STIP-1", TableOf(&stipples::TABLE))
                .absent("no stipples"),
            key!(
                Scene.hatching,
                "Strokes along the lines of curvature of an iso-surface.",
                "HATCH-8",
                TableOf(&hatching::TABLE)
            )
            .absent("no hatching"),
            key!(Scene.outlines, "Lines where an iso-surface turns away.", "HATCH-18", TableOf(&outlines::TABLE))
                .absent("no outlines"),
            key!(Scene.surface, "An opaque iso-surface.", "HATCH-14", TableOf(&surface::TABLE))
                .absent("no surface")
                .needs(&[Quantity::Surface]),
        ],
    )
};
