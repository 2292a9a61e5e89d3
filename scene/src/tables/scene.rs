//! The scene: all tables of a scene file ([SCN-1], [SCN-3]).

use super::{
    Annotations, Background, Camera, Clip, Combine, Contours, Halo, Hatching, IntersectionTable, LightDirection,
    MeshTable, ObjectTable, Orbit, Outlines, PageSettings, PenSettings, PictureSettings, Sampling, Shading, Stipples,
    StyleMipmaps, Styles, Surface, SurfaceLook, Transfer, TransferKind, VolumeSource, VolumeTable,
};
use crate::document::Given;
use std::path::{Path, PathBuf};

/// Everything that a picture is made of, with every default filled in. A table that is absent here is an effect that
/// does not exist ([SCN-1]). The default is a template: it names no volume and has no effect.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// The direction towards the light, for everything lit that has no light of its own.
    pub light: LightDirection,
    /// The data that is seen.
    pub volume: VolumeTable,
    /// Planes that cut parts of the volume away.
    pub clips: Vec<Clip>,
    /// The view.
    pub camera: Camera,
    /// Several frames; none: one.
    pub orbit: Option<Orbit>,
    /// Size, resolution and background of the picture.
    pub picture: PictureSettings,
    /// The paper of points and lines; none: there is no margin, and no plotter draws the page.
    pub page: Option<PageSettings>,
    /// The pens of points and lines, in the order of their layers' numbers.
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
    /// Volumetric halos, in their order.
    pub halos: Vec<Halo>,
    /// How objects are combined; none: by the paper's operators.
    pub combine: Option<Combine>,
    /// Selections with a look of their own, in their order.
    pub objects: Vec<ObjectTable>,
    /// The look of places where a selection meets something.
    pub intersections: Vec<IntersectionTable>,
    /// Volume stippling; none: no dots.
    pub stipples: Option<Stipples>,
    /// Strokes along the lines of curvature of an iso-surface; none: no strokes.
    pub hatching: Option<Hatching>,
    /// Lines where an iso-surface turns away; none: none.
    pub outlines: Option<Outlines>,
    /// An opaque iso-surface; none: none.
    pub surface: Option<Surface>,
    /// Opaque meshes, in their order.
    pub meshes: Vec<MeshTable>,
    /// Boxes, arrows, fans, labels, scale bar, directions and legend over the picture.
    pub annotations: Annotations,
    /// The keys that the scene gives itself, and their places. Comparisons of scenes ignore this field.
    pub given: Given,
}

impl Scene {
    /// The shortest scene: a volume, every default, and the preset `style`.
    pub fn for_volume(source: VolumeSource) -> Self {
        let transfer = Some(Transfer::automatic(TransferKind::Style));
        Self { volume: VolumeTable::new(source), transfer, ..Self::default() }
    }

    /// The files that the scene names, and the folder of its theme, as paths to open.
    pub fn files(&self) -> Vec<&Path> {
        let volume = match &self.volume.source {
            VolumeSource::File { path, .. } => Some(path),
            VolumeSource::Phantom(_) => None,
        };
        let labels = [&self.volume.labels, &self.volume.label_names].into_iter().flatten();
        let further = self.transfer.iter().flat_map(Transfer::volumes);
        let of_objects = self.objects.iter().flat_map(ObjectTable::files);
        let of_intersections = self.intersections.iter().filter_map(IntersectionTable::picture);
        let background = match &self.picture.background {
            Background::Picture(path) => Some(path),
            Background::Color(_) | Background::None => None,
        };
        let meshes = self.meshes.iter().map(|mesh| &mesh.file);
        let tones = self.pens.iter().filter_map(|pen| pen.tone.as_ref());
        let all = volume.into_iter().chain(labels).chain(further).chain(self.styles.paths());
        let all = all.chain(of_objects).chain(of_intersections).chain(background).chain(meshes).chain(tones);
        all.map(PathBuf::as_path).collect()
    }

    /// Whether points or lines are drawn.
    pub fn has_marks(&self) -> bool {
        self.stipples.is_some() || self.has_strokes()
    }

    /// Whether points, lines or annotations are drawn, which have lengths on the page.
    pub fn draws_on_page(&self) -> bool {
        self.has_marks() || !self.all_annotations().is_empty()
    }

    /// Whether strokes are drawn.
    pub fn has_strokes(&self) -> bool {
        self.outlines.is_some() || self.hatching.is_some()
    }

    /// Whether the scene has nothing to draw, so that the preset `style` supplies its transfer function ([SCN-3]).
    pub(crate) fn would_draw_nothing(&self) -> bool {
        self.transfer.is_none() && self.surface.is_none() && !self.has_marks()
    }

    /// Whether rays draw the volume itself, or what stands beside it ([SCN-3]).
    pub fn draws_volume(&self) -> bool {
        self.transfer.is_some()
            || !self.meshes.is_empty()
            || self.surface.as_ref().is_some_and(|surface| surface.look != SurfaceLook::None)
    }
}
