//! The papers' figures, remade with our own scenes, and what a paper says without a figure: every `figure_*.toml` and
//! `two_quantities_*.toml` of `data/scenes`, and some others, is a picture in `docs/pictures`.

use crate::files;
use drypoint::Failures;
use drypoint::drawing::Drawing;
use drypoint::job::{Job, RenderTarget};
use drypoint::marking::Marking;
use drypoint::output::encode::{quantize, straight_srgb};
use drypoint::scene::color::srgb_to_linear;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, load};
use drypoint::scene::picture::{Layer, LayerKind, Picture};
use drypoint::scene::tables::{Background, Scene};
use std::path::{Path, PathBuf};

/// What makes a file of a picture.
pub(crate) type Encode = fn(&Picture) -> Result<Vec<u8>, png::EncodingError>;

/// The most bytes of a picture in `docs`.
const LARGEST: usize = 600_000;

/// Scenes that are shown beside the figures.
const OTHERS: [&str; 8] = [
    "skull-plotter",
    "silhouettes-engine",
    "outlines-engine",
    "hatching-aneurism",
    "hatching-engine",
    "hatching-lobster",
    "hatching-skull",
    "plotter-page",
];

/// The darkest κ_v of a map of curvature, per world unit.
const BLACK: f64 = 1.0;

/// Renders every figure. A scene with the layer `curvature.KV` is shown as a map of it.
///
/// # Errors
/// What the renderer or the system says, and a file that is too large for a page.
pub(crate) fn write() -> Result<(), String> {
    for scene in scenes()? {
        let (Some(paper), Some(name)) = (scene.parent().and_then(Path::file_name), scene.file_stem()) else { continue };
        let file = format!("pictures/{}/{}.png", paper.display(), name.display());
        let bytes = picture(&scene).and_then(|(picture, encode)| encode(&picture).map_err(|e| e.to_string()));
        let bytes = bytes.map_err(|e| format!("{file}: {e}"))?;
        if bytes.len() > LARGEST {
            return Err(format!(
                "{file} has {} bytes, more than {LARGEST}: make the scene's picture smaller",
                bytes.len()
            ));
        }
        files::write(&file, &bytes)?;
    }
    Ok(())
}

/// The scenes of figures and [`OTHERS`], but not the twins with regular functions, which are there to be timed, and those of Fig. 1 of styles,
/// which are laid out beside the painting.
fn scenes() -> Result<Vec<PathBuf>, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/scenes");
    let entries = |folder: &Path| -> Result<Vec<PathBuf>, String> {
        let read = std::fs::read_dir(folder).and_then(Iterator::collect::<Result<Vec<_>, _>>);
        Ok(read.map_err(|e| format!("{}: {e}", folder.display()))?.iter().map(|entry| entry.path()).collect())
    };
    let mut scenes = Vec::new();
    // Figures of halos are sheets (`halo_figures`).
    let of_a_page = |path: &&PathBuf| path.is_dir() && !path.ends_with("volumetric_halos");
    for paper in entries(&root)?.iter().filter(of_a_page) {
        let styles = paper.ends_with("style_transfer_functions");
        scenes.extend(entries(paper)?.into_iter().filter(|path| {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            path.extension().is_some_and(|e| e == "toml")
                && (stem.starts_with("figure_") || stem.starts_with("two_quantities_") || OTHERS.contains(&&*stem))
                && !(stem.ends_with("_regular") || (styles && stem.starts_with("figure_1_")))
        }));
    }
    scenes.sort();
    Ok(scenes)
}

/// The picture of a scene, and how it becomes a file.
pub(crate) fn picture(scene: &Path) -> Result<(Picture, Encode), String> {
    let mut scene = load(scene, &Overrides::default()).map_err(|e| e.to_string())?;
    let is_map = scene.picture.layers.contains(&LayerKind::CurvatureAlongView);
    if is_map {
        scene.picture.background = Background::None;
    }
    if scene.has_marks() {
        let colored = scene.draws_volume() && scene.stipples.is_none()
            || scene.hatching.as_ref().is_some_and(|hatching| hatching.lighting.is_some());
        let black = scene.pens.iter().all(|pen| pen.color[..3].iter().all(|c| *c == pen.color[0]));
        let encode = if colored {
            opaque_png
        } else if black {
            ink_png
        } else {
            inks_png
        };
        return marks(scene, colored).map_err(|e| e.to_string()).map(|picture| (picture, encode as Encode));
    }
    let job = Job::load(scene).map_err(|e| e.to_string())?;
    let (picture, _) = job.renderer().map_err(|e| e.to_string())?.frame(&|_| ());
    let picture = if is_map { map(&picture).ok_or("the picture has no curvature")? } else { picture };
    Ok((picture, opaque_png))
}

/// Dots and lines, on their page, or where they have colours over the volume.
fn marks(scene: Scene, colored: bool) -> Result<Picture, Failures> {
    let job = Job::load_for(scene, if colored { RenderTarget::Picture } else { RenderTarget::Marks })?;
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| ())?;
    let (frame, _) = Drawing::new(&job, &marking, &mut counts)?.frame(0, &|_| ())?;
    Ok(frame.painted(&job)?)
}

/// |κ_v| as grey on white: the darker, the more curved; as faint as the picture is.
fn map(picture: &Picture) -> Option<Picture> {
    let alpha = &picture.layer(LayerKind::Beauty)?.channels[3];
    let kappa = &picture.layer(LayerKind::CurvatureAlongView)?.channels[0];
    let light = |(k, a): (&f64, &f64)| 1.0 - a * (1.0 - srgb_to_linear((1.0 - k.abs() / BLACK).max(0.0)));
    let grey: Vec<f64> = kappa.iter().zip(alpha).map(light).collect();
    let opaque = vec![1.0; grey.len()];
    let channels = vec![grey.clone(), grey.clone(), grey, opaque];
    Some(Picture { layers: vec![Layer { kind: LayerKind::Beauty, channels }], ..*picture })
}

/// Black ink on white as 16 greys, which is all that the edge of a dot needs, the smallest file.
fn ink_png(picture: &Picture) -> Result<Vec<u8>, png::EncodingError> {
    let mut data = Vec::with_capacity((picture.width / 2 + 1) * picture.height);
    if let Some([r, g, b, ..]) = picture.layer(LayerKind::Beauty).map(|layer| layer.channels.as_slice()) {
        let grey = |i: usize| quantize(straight_srgb([r[i], g[i], b[i], 1.0])[1], 15) as u8;
        for row in 0..picture.height {
            let pixels: Vec<u8> = (0..picture.width).map(|x| grey(row * picture.width + x)).collect();
            data.extend(pixels.chunks(2).map(|pair| (pair[0] << 4) | pair.get(1).copied().unwrap_or(0)));
        }
    }
    encode(picture, (png::ColorType::Grayscale, None), png::BitDepth::Four, &data)
}

/// Ink of several colours on white, each channel in six steps: a table of 216 colours, a third of the file.
fn inks_png(picture: &Picture) -> Result<Vec<u8>, png::EncodingError> {
    let mut data = Vec::with_capacity(picture.width * picture.height);
    if let Some([r, g, b, ..]) = picture.layer(LayerKind::Beauty).map(|layer| layer.channels.as_slice()) {
        data.extend(r.iter().zip(g).zip(b).map(|((&r, &g), &b)| {
            let [r, g, b, _] = straight_srgb([r, g, b, 1.0]);
            [r, g, b].iter().fold(0, |code, c| 6 * code + quantize(*c, 5) as u8)
        }));
    }
    let palette = (0..216u8).flat_map(|code| [code / 36, code / 6 % 6, code % 6]).map(|step| 51 * step).collect();
    encode(picture, (png::ColorType::Indexed, Some(palette)), png::BitDepth::Eight, &data)
}

/// An opaque picture as 8 bits of sRGB without alpha, the smallest file.
pub(crate) fn opaque_png(picture: &Picture) -> Result<Vec<u8>, png::EncodingError> {
    let mut data = Vec::with_capacity(3 * picture.width * picture.height);
    if let Some([r, g, b, ..]) = picture.layer(LayerKind::Beauty).map(|layer| layer.channels.as_slice()) {
        for ((&r, &g), &b) in r.iter().zip(g).zip(b) {
            let [r, g, b, _] = straight_srgb([r, g, b, 1.0]);
            data.extend([r, g, b].map(|c| quantize(c, 255) as u8));
        }
    }
    encode(picture, (png::ColorType::Rgb, None), png::BitDepth::Eight, &data)
}

fn encode(
    picture: &Picture,
    (color, palette): (png::ColorType, Option<Vec<u8>>),
    depth: png::BitDepth,
    data: &[u8],
) -> Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, picture.width as u32, picture.height as u32);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if let Some(palette) = palette {
        encoder.set_palette(palette);
    }
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::High);
    encoder.write_header()?.write_image_data(data)?;
    Ok(file)
}
