//! The scene: the top of a scene file ([SCN-1], [SCN-3]).

use super::preset::PRESETS;
use super::styles::check_styles;
use super::{
    Axis, Background, Camera, Contours, Hatching, LightDirection, Orbit, Outlines, PageSettings, PenSettings,
    PictureSettings, Sampling, Shading, Stipples, StyleMipmaps, StyleSource, Styles, Surface, SurfaceLook, Transfer,
    TransferKind, VolumeSource, VolumeTable,
};
use super::{
    camera, contours, hatching, orbit, outlines, over, page, pen, picture, sampling, shading, stipples, style_mipmaps,
    styles, surface, transfer, volume,
};
use crate::file::Given;
use crate::file::check::Check;
use crate::file::describe::{Key, Kind, Later, Section, Shape, Slot, Table};
use crate::file::item::{Item, Value};
use crate::file::kind::{ListOf, TableOf};
use crate::file::out::Out;
use crate::plan::{At, Pass, Quantity};
use serde_json::{Value as Json, json};
use std::path::{Path, PathBuf};

/// Everything that a picture is made of, with every default filled in. A table that is absent here is an effect that
/// does not exist ([SCN-1]).
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Towards the light, for all that is lit and says nothing else.
    pub light: LightDirection,
    /// What is seen.
    pub volume: VolumeTable,
    /// From where.
    pub camera: Camera,
    /// Several frames; none: one.
    pub orbit: Option<Orbit>,
    /// On what.
    pub picture: PictureSettings,
    /// The paper of points and lines; none: without a margin, and not for a plotter.
    pub page: Option<PageSettings>,
    /// What draws them, in the order of their layers' numbers.
    pub pens: Vec<PenSettings>,
    /// How the field is sampled.
    pub sampling: Sampling,
    /// Colours or styles and opacities over the values; none: the volume itself is not drawn.
    pub transfer: Option<Transfer>,
    /// The styles that the transfer function names.
    pub styles: Styles,
    /// Blinn–Phong shading of a regular transfer function; none: unshaded.
    pub shading: Option<Shading>,
    /// Style contours; none: no contour.
    pub contours: Option<Contours>,
    /// Mip-maps of the styles; none: each lookup reads the style itself.
    pub style_mipmaps: Option<StyleMipmaps>,
    /// Volume stippling; none: no dots.
    pub stipples: Option<Stipples>,
    /// Strokes along the lines of curvature of an iso-surface; none: none.
    pub hatching: Option<Hatching>,
    /// Lines where an iso-surface turns away; none: none.
    pub outlines: Option<Outlines>,
    /// An opaque iso-surface; none: none.
    pub surface: Option<Surface>,
    /// Which keys the scene said itself, and where. It takes no part in comparisons.
    pub given: Given,
}

impl Scene {
    /// The shortest scene: a volume, every default, and the preset `style`.
    pub fn for_volume(source: VolumeSource) -> Self {
        Self { transfer: Some(Transfer::automatic(TransferKind::Style)), ..Self::without_effects(source) }
    }

    /// The files that the scene names, and the folder of its theme, as paths to open.
    pub fn files(&self) -> Vec<&Path> {
        let volume = match &self.volume.source {
            VolumeSource::File { path, .. } => Some(path),
            VolumeSource::Phantom(_) => None,
        };
        let labels = [&self.volume.labels, &self.volume.label_names].into_iter().flatten();
        let axes = self.transfer.as_ref().map_or(&[][..], |transfer| transfer.over.axes());
        let further = axes.iter().filter_map(|axis| match axis {
            Axis::Volume(path) => Some(path),
            _ => None,
        });
        let theme = match &self.styles.theme {
            StyleSource::Folder(folder) => Some(folder),
            StyleSource::Embedded(_) => None,
        };
        let styles = self.styles.files.iter().map(|(_, file)| &file.path);
        let background = match &self.picture.background {
            Background::Picture(path) => Some(path),
            Background::Color(_) | Background::None => None,
        };
        let tones = self.pens.iter().filter_map(|pen| pen.tone.as_ref());
        let all = volume.into_iter().chain(labels).chain(further).chain(theme).chain(styles);
        all.chain(background).chain(tones).map(PathBuf::as_path).collect()
    }

    /// Whether points or lines are drawn.
    pub fn has_marks(&self) -> bool {
        self.stipples.is_some() || self.has_strokes()
    }

    /// Whether strokes are drawn.
    pub fn has_strokes(&self) -> bool {
        self.outlines.is_some() || self.hatching.is_some()
    }

    /// Whether the volume itself is drawn, by rays ([SCN-3]).
    pub fn draws_volume(&self) -> bool {
        self.transfer.is_some() || self.surface.as_ref().is_some_and(|surface| surface.look != SurfaceLook::None)
    }

    /// A volume, every default, and no effect.
    fn without_effects(source: VolumeSource) -> Self {
        Self {
            light: LightDirection::Head,
            volume: VolumeTable::new(source),
            camera: Camera::default(),
            orbit: None,
            picture: PictureSettings::default(),
            page: None,
            pens: Vec::new(),
            sampling: Sampling::default(),
            transfer: None,
            styles: Styles::default(),
            shading: None,
            contours: None,
            style_mipmaps: None,
            stipples: None,
            hatching: None,
            outlines: None,
            surface: None,
            given: Given::default(),
        }
    }
}

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
    check: |scene, check| {
        check_styles(scene, check);
        pen::check_names(&scene.pens, check);
        over::check_labels(scene, check);
        stipples::check_colors(scene, check);
    },
    idle: |scene, plan, idle| {
        // What a preset supplies is there and was not said.
        let supplied = [
            (scene.transfer.is_some(), "transfer"),
            (scene.stipples.is_some(), "stipples"),
            (scene.hatching.is_some(), "hatching"),
            (scene.outlines.is_some(), "outlines"),
            (scene.shading.is_some(), "shading"),
            (scene.surface.is_some(), "surface"),
        ];
        if !supplied.iter().any(|(is_there, table)| *is_there && !idle.says(table)) {
            idle.key("preset", "the scene has its tables itself");
        }
        let lit = shading::lit(scene);
        match &scene.shading {
            Some(shading) if lit && shading.light.is_some() => idle.key("light", "shading.light wins"),
            Some(_) if lit => {}
            _ if shading::lit_surface(scene) => {}
            _ if scene.stipples.as_ref().and_then(|s| s.lighting).is_some_and(|lighting| lighting.light.is_none()) => {}
            _ if scene.hatching.as_ref().is_some_and(|h| h.is_lit(scene) && h.stroke.light.is_none()) => {}
            _ => idle.key("light", "nothing is lit: a light acts on [shading] of a regular function"),
        }
        if !plan.has_pass(Pass::Rays) {
            for key in ["transfer", "styles", "shading", "contours", "style_mipmaps"] {
                let colors = plan.has_pass(Pass::DotColors) && matches!(key, "transfer" | "styles");
                if !colors {
                    idle.key(key, "the volume itself is not drawn");
                }
            }
        }
    },
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

/// The top of the file, each of its tables, and each item of its lists of tables.
pub(crate) fn sections(scene: &Scene) -> Vec<(At, Section)> {
    let mut sections = vec![(At::default(), ROOT.section())];
    for key in ROOT.keys {
        let shape = key.field.shape();
        sections.extend(shape.section().map(|section| (At { key: key.name.into(), item: None }, section)));
        let items = match key.field.write(scene) {
            Some(Out::List(items)) => items.len(),
            _ => 0,
        };
        sections.extend((0..items).filter_map(|i| {
            let at = At { key: format!("{}[{i}]", key.name), item: Some(i) };
            shape.item_section().map(|section| (at, section))
        }));
    }
    sections
}
