//! The description of a whole scene file ([SCN-1], [SCN-3]).

use super::annotation::{arrow, bounding_box, fan, label, legend, orientation, scale_bar};
use super::preset::PRESETS;
use super::{
    Halo, ObjectTable, Scene, camera, clip, combine, contours, halo, hatching, intersection, mesh, object, orbit,
    outlines, page, pen, picture, sampling, shading, stipples, style_mipmaps, styles, surface, transfer, volume,
};
use crate::document::check::Check;
use crate::document::declare::{keys, unless_empty};
use crate::document::describe::{Kind, Later, Shape, Table};
use crate::document::item::{Item, Value};
use crate::document::kind::{FEW, ListOf, TableOf};
use crate::document::out::Out;
use crate::quantity::Quantity;
use serde_json::{Value as Json, json};

/// The version of the format.
const VERSION: i64 = 1;

/// `drypoint = 1`.
pub(super) struct Version;

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
    later: &[later("conventions", "GPU-6")],
    check: |_, check| {
        if !check.has("volume") {
            check.fault_in("volume", volume::no_volume());
        }
    },
    ..Table::new(
        "a scene",
        "A scene file is TOML. A table is an effect: what has no table does not exist for the picture and is not \
         computed. Lengths are numbers in world units or texts with a unit, angles are in degrees, colours sRGB, and \
         paths relative to the scene file.",
        Scene::default,
        keys! { Scene {
            /// Version of the format.
            drypoint: key("", Version, |_| Some(()), |_, ()| {}).required();
            /// Whole tables for a scene that lacks them.
            preset: key("SCN-3", PRESETS,
                |_| None,
                // It is read before the tables, of which each that the file has takes the place of the preset's.
                |scene, preset| preset.supply(scene))
                .absent("\"style\" where the scene draws nothing else");
            /// Towards the light, for all that is lit; a table's own `light` wins.
            light: key("STF-11", shading::Light);
            /// The data that is seen.
            volume: key("IO-1", TableOf(&volume::TABLE)).absent("the scene is a template, for any volume");
            /// Planes that cut parts of the volume away.
            clips: key("RAY-8", ListOf { what: "a list of clips", most: FEW, each: TableOf(&clip::TABLE) },
                |s| unless_empty(&s.clips)).named("clip").absent("none");
            /// The view of the volume.
            camera: key("RAY-5", TableOf(&camera::TABLE));
            /// Several frames about the volume.
            orbit: key("STIP-4", TableOf(&orbit::TABLE)).absent("one frame");
            /// Size, resolution and background of the picture.
            picture: key("RAY-6", TableOf(&picture::TABLE));
            /// The paper that points and lines are drawn on.
            page: key("IO-7", TableOf(&page::TABLE)).absent("no margin, no plotter");
            /// The pens that points and lines are drawn with; layers are numbered in their order.
            pens: key("IO-7", ListOf { what: "a list of pens", most: FEW, each: TableOf(&pen::TABLE) },
                |s| unless_empty(&s.pens)).named("pen").absent("none");
            /// How the field is reconstructed and where it is sampled.
            sampling: key("RAY-1", TableOf(&sampling::TABLE));
            /// Colours or styles, and opacities, over the values.
            transfer: key("STF-3", TableOf(&transfer::TABLE)).absent("the preset's").needs(&[Quantity::Value]);
            /// The lit-sphere pictures that a transfer function names.
            styles: key("STF-12", TableOf(&styles::TABLE));
            /// Light on a regular transfer function, and on a lit iso-surface.
            shading: key("STF-11", TableOf(&shading::TABLE)).absent("unshaded").needs(&[Quantity::Gradient]);
            /// Style contours of controlled thickness.
            contours: key("STF-6", TableOf(&contours::TABLE)).absent("no contours");
            /// Styles read at the level of detail that the picture can show.
            style_mipmaps: key("STF-10", TableOf(&style_mipmaps::TABLE)).absent("no mip-maps");
            /// Volumetric halos; of emissive ones the first lies in front, of occlusive ones the first is mixed last.
            halo: key("HALO-1", ListOf { what: "a list of halos", most: FEW, each: TableOf(&halo::TABLE) },
                |s| unless_empty(&s.halos),
                |s, v| s.halos = v.into_iter().enumerate().map(|(i, halo): (usize, Halo)| halo.named(i)).collect())
                .absent("none").needs(&Quantity::ALL);
            /// Operators by which objects are combined.
            combine: key("VS-3", TableOf(&combine::TABLE)).absent("\"zadeh\", with objects");
            /// Objects: selections with a look of their own, which can be moved and cut free.
            object: key("VS-2", ListOf { what: "a list of objects", most: FEW, each: TableOf(&object::TABLE) },
                |s| unless_empty(&s.objects),
                |s, v| s.objects = v.into_iter().enumerate().map(|(i, o): (usize, ObjectTable)| o.named(i)).collect())
                .absent("none").needs(&Quantity::ALL);
            /// The look of places where a selection meets its ghost or the background.
            intersections: key("VS-4", ListOf { what: "a list of intersections", most: FEW, each: TableOf(&intersection::TABLE) },
                |s| unless_empty(&s.intersections)).named("intersection").absent("none");
            /// Stippling: dots on the volume's boundaries.
            stipples: key("STIP-1", TableOf(&stipples::TABLE)).absent("no stipples");
            /// Strokes along the lines of curvature of an iso-surface.
            hatching: key("HATCH-8", TableOf(&hatching::TABLE)).absent("no hatching");
            /// Lines where an iso-surface turns away.
            outlines: key("HATCH-18", TableOf(&outlines::TABLE)).absent("no outlines");
            /// An opaque iso-surface.
            surface: key("HATCH-14", TableOf(&surface::TABLE)).absent("no surface").needs(&[Quantity::Surface]);
            /// Opaque meshes, which cut the volume and are cut by it.
            meshes: key("VS-12", ListOf { what: "a list of meshes", most: FEW, each: TableOf(&mesh::TABLE) },
                |s| unless_empty(&s.meshes)).named("mesh").absent("none").needs(&[Quantity::Mesh]);
            /// The edges of bounding boxes.
            boxes: key("VS-8", ListOf { what: "a list of boxes", most: FEW, each: TableOf(&bounding_box::TABLE) },
                |s| unless_empty(&s.annotations.boxes), |s, v| s.annotations.boxes = v).named("box").absent("none");
            /// Arrows, such as from the place of an object to where it is moved.
            arrows: key("VS-8", ListOf { what: "a list of arrows", most: FEW, each: TableOf(&arrow::TABLE) },
                |s| unless_empty(&s.annotations.arrows), |s, v| s.annotations.arrows = v).named("arrow").absent("none");
            /// Outlines of a part and of its copy, with the lines that join them.
            fans: key("VS-8", ListOf { what: "a list of fans", most: FEW, each: TableOf(&fan::TABLE) },
                |s| unless_empty(&s.annotations.fans), |s, v| s.annotations.fans = v).named("fan").absent("none");
            /// Text beside the picture, with leader lines to what it names.
            label: key("VS-10", ListOf { what: "a list of labels", most: FEW, each: TableOf(&label::LABEL) },
                |s| unless_empty(&s.annotations.labels), |s, v| s.annotations.labels = v).absent("none");
            /// The arrangement of all labels.
            labels: key("VS-10", TableOf(&label::LABELS),
                |s| s.annotations.arrangement.clone(), |s, v| s.annotations.arrangement = Some(v)).absent("the default, with labels");
            /// A line of known length.
            scale_bar: key("VS-8", TableOf(&scale_bar::TABLE),
                |s| s.annotations.scale_bar.clone(), |s, v| s.annotations.scale_bar = Some(v)).absent("none");
            /// The directions of the data.
            orientation: key("VS-8", TableOf(&orientation::TABLE),
                |s| s.annotations.orientation.clone(), |s, v| s.annotations.orientation = Some(v)).absent("none");
            /// The styles or colours of the transfer function, with names.
            legend: key("VS-8", TableOf(&legend::TABLE),
                |s| s.annotations.legend.clone(), |s, v| s.annotations.legend = Some(v)).absent("none");
        } },
    )
};
