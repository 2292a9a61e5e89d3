//! The description of a whole scene file ([SCN-1], [SCN-3]).

use super::preset::PRESETS;
use super::{
    Scene, VolumeSource, camera, contours, hatching, orbit, outlines, page, pen, picture, sampling, shading, stipples,
    style_mipmaps, styles, surface, transfer, volume,
};
use crate::document::check::Check;
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
            Key::new(
                "light",
                "STF-11",
                "Towards the light, for all that is lit; a table's own `light` wins.",
                &Slot { kind: shading::Light, get: |s: &Scene| Some(s.light), set: |s, v| s.light = v },
            ),
            Key::new(
                "volume",
                "IO-1",
                "The data that is seen.",
                &Slot {
                    kind: TableOf(&volume::TABLE),
                    get: |s: &Scene| Some(s.volume.clone()),
                    set: |s, v| s.volume = v,
                },
            )
            .required(),
            Key::new(
                "camera",
                "RAY-5",
                "From where the volume is seen.",
                &Slot {
                    kind: TableOf(&camera::TABLE),
                    get: |s: &Scene| Some(s.camera.clone()),
                    set: |s, v| s.camera = v,
                },
            ),
            Key::new(
                "orbit",
                "STIP-4",
                "Several frames about the volume.",
                &Slot { kind: TableOf(&orbit::TABLE), get: |s: &Scene| s.orbit, set: |s, v| s.orbit = Some(v) },
            )
            .absent("one frame"),
            Key::new(
                "picture",
                "RAY-6",
                "What the picture is drawn on.",
                &Slot {
                    kind: TableOf(&picture::TABLE),
                    get: |s: &Scene| Some(s.picture.clone()),
                    set: |s, v| s.picture = v,
                },
            ),
            Key::new(
                "page",
                "IO-7",
                "The paper that points and lines are drawn on.",
                &Slot { kind: TableOf(&page::TABLE), get: |s: &Scene| s.page.clone(), set: |s, v| s.page = Some(v) },
            )
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
            Key::new(
                "sampling",
                "RAY-1",
                "How the field is reconstructed and where it is sampled.",
                &Slot {
                    kind: TableOf(&sampling::TABLE),
                    get: |s: &Scene| Some(s.sampling.clone()),
                    set: |s, v| s.sampling = v,
                },
            ),
            Key::new(
                "transfer",
                "STF-3",
                "Colours or styles, and opacities, over the values.",
                &Slot {
                    kind: TableOf(&transfer::TABLE),
                    get: |s: &Scene| s.transfer.clone(),
                    set: |s, v| s.transfer = Some(v),
                },
            )
            .absent("the preset's")
            .needs(&[Quantity::Value]),
            Key::new(
                "styles",
                "STF-12",
                "The lit-sphere pictures that a transfer function names.",
                &Slot {
                    kind: TableOf(&styles::TABLE),
                    get: |s: &Scene| Some(s.styles.clone()),
                    set: |s, v| s.styles = v,
                },
            ),
            Key::new(
                "shading",
                "STF-11",
                "Light on a regular transfer function, and on a lit iso-surface.",
                &Slot {
                    kind: TableOf(&shading::TABLE),
                    get: |s: &Scene| s.shading.clone(),
                    set: |s, v| s.shading = Some(v),
                },
            )
            .absent("unshaded")
            .needs(&[Quantity::Gradient]),
            Key::new(
                "contours",
                "STF-6",
                "Style contours of controlled thickness.",
                &Slot {
                    kind: TableOf(&contours::TABLE),
                    get: |s: &Scene| s.contours.clone(),
                    set: |s, v| s.contours = Some(v),
                },
            )
            .absent("no contours"),
            Key::new(
                "style_mipmaps",
                "STF-10",
                "Styles read at the level of detail that the picture can show.",
                &Slot {
                    kind: TableOf(&style_mipmaps::TABLE),
                    get: |s: &Scene| s.style_mipmaps.clone(),
                    set: |s, v| s.style_mipmaps = Some(v),
                },
            )
            .absent("no mip-maps"),
            Key::new(
                "stipples",
                "STIP-1",
                "Stippling: dots on the volume's boundaries.",
                &Slot {
                    kind: TableOf(&stipples::TABLE),
                    get: |s: &Scene| s.stipples.clone(),
                    set: |s, v| s.stipples = Some(v),
                },
            )
            .absent("no stipples"),
            Key::new(
                "hatching",
                "HATCH-8",
                "Strokes along the lines of curvature of an iso-surface.",
                &Slot {
                    kind: TableOf(&hatching::TABLE),
                    get: |s: &Scene| s.hatching.clone(),
                    set: |s, v| s.hatching = Some(v),
                },
            )
            .absent("no hatching"),
            Key::new(
                "outlines",
                "HATCH-18",
                "Lines where an iso-surface turns away.",
                &Slot {
                    kind: TableOf(&outlines::TABLE),
                    get: |s: &Scene| s.outlines.clone(),
                    set: |s, v| s.outlines = Some(v),
                },
            )
            .absent("no outlines"),
            Key::new(
                "surface",
                "HATCH-14",
                "An opaque iso-surface.",
                &Slot {
                    kind: TableOf(&surface::TABLE),
                    get: |s: &Scene| s.surface.clone(),
                    set: |s, v| s.surface = Some(v),
                },
            )
            .absent("no surface")
            .needs(&[Quantity::Surface]),
        ],
    )
};
