//! The styles of the embedded themes, painted by formulas of light and by procedural strokes ([STF-12]).
//!
//! Each style is a function of the unit normal towards the eye. A theme has one for each name of [`ROLES`], in a spirit
//! of its own: `textbook` in gouache, `naturalist` in pencil, pen and watercolour, `studio` before a camera. All
//! are lit from the upper left, as plates in books are, and all but `constant` end in a thin dark ring of a colour of
//! their own, which style contours ([STF-8]) are drawn with. The files in `data/themes` are these functions on
//! [`SIDE`]² texels, and a test holds them to it.

mod light;
mod naturalist;
mod noise;
mod paint;
mod roles;
mod room;
mod stroke;
mod studio;
mod textbook;
mod wash;

pub(crate) use roles::ROLES;

use drypoint::scene::color::Rgba;
use drypoint::scene::style::is_inside;
use drypoint_reference::number::Vec3;
use paint::Paint;

/// The side of an embedded style's picture, in texels.
pub(crate) const SIDE: usize = 192;

/// A style as a formula: colour and opacity, of the unit normal (N_z ≥ 0).
type Painter = fn(Vec3<f64>) -> (Paint, f64);

/// A theme as formulas.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GalleryTheme {
    /// The name that a scene gives it.
    pub(crate) name: &'static str,
    /// What it looks like, in a sentence.
    pub(crate) spirit: &'static str,
    painters: &'static [Painted],
}

/// What a theme makes of a name: the name, how it is painted in a line, and the painter.
type Painted = (&'static str, &'static str, Painter);

/// A style as a formula.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GalleryStyle {
    /// The name that a scene gives it.
    pub(crate) name: &'static str,
    /// How it is painted, in a line.
    pub(crate) how: &'static str,
    painter: Painter,
}

/// The embedded themes; the first is a scene's own if it names none.
pub(crate) const THEMES: [GalleryTheme; 3] = [
    GalleryTheme { name: "textbook", spirit: textbook::SPIRIT, painters: textbook::PAINTERS },
    GalleryTheme { name: "naturalist", spirit: naturalist::SPIRIT, painters: naturalist::PAINTERS },
    GalleryTheme { name: "studio", spirit: studio::SPIRIT, painters: studio::PAINTERS },
];

impl GalleryTheme {
    /// The styles, in alphabetical order.
    pub(crate) fn styles(&self) -> impl Iterator<Item = GalleryStyle> {
        self.painters.iter().map(|&(name, how, painter)| GalleryStyle { name, how, painter })
    }
}

impl GalleryStyle {
    /// Straight sRGB and opacity of the normal whose first components are x and y; N_z follows, 0 beyond the disk.
    pub(crate) fn shade(&self, x: f64, y: f64) -> Rgba {
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        let (paint, alpha) = (self.painter)(Vec3::new(x, y, z));
        let [r, g, b] = paint.srgb();
        [r, g, b, alpha]
    }

    /// The picture as S × S straight RGBA bytes, row by row from the top: what a style's file holds ([STF-1]). Texels
    /// whose centres lie outside the inscribed disk are transparent black.
    pub(crate) fn rgba8(&self, side: usize) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(4 * side * side);
        let centre = |k: usize| (2 * k + 1) as f64 / side as f64 - 1.0;
        for j in 0..side {
            for i in 0..side {
                if is_inside(side, i, j) {
                    let rgba = self.shade(centre(i), -centre(j));
                    bytes.extend(rgba.map(|c| (255.0 * c).round() as u8));
                } else {
                    bytes.extend([0; 4]);
                }
            }
        }
        bytes
    }
}

#[cfg(test)]
mod tests;
