//! The page.

use crate::tables::{Length, PictureSettings, Scene};
use glam::DVec2;

/// Millimetres of an inch.
pub const INCH: f64 = 25.4;

/// The paper: the picture with a margin all around.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Page {
    /// Width and height with both margins, in mm.
    pub size: DVec2,
    /// The width of the margin, in mm. Nothing is drawn on the margin. The picture fills the rest of the page, the
    /// frame.
    pub margin: f64,
    /// Pixels per inch, above 0.
    pub dpi: f64,
    /// The unit of the scene's lengths, and hence of the lists of its marks.
    pub unit: PageUnit,
}

/// The unit in which a scene measures its picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PageUnit {
    /// `picture.width` and `picture.height` in mm.
    Millimetres,
    /// `picture.size`.
    Pixels,
}

impl Page {
    /// The page of a picture of `picture` mm.
    pub fn in_millimetres(picture: DVec2, margin: f64, dpi: f64) -> Self {
        Self { size: picture + 2.0 * margin, margin, dpi, unit: PageUnit::Millimetres }
    }

    /// The page of a picture given in pixels, with a margin in mm.
    pub fn in_pixels(picture: [usize; 2], margin: f64, dpi: f64) -> Self {
        let size = DVec2::from(picture.map(|n| n as f64)) * INCH / dpi;
        Self { unit: PageUnit::Pixels, ..Self::in_millimetres(size, margin, dpi) }
    }

    /// The page of a scene, with the margin of `[page]`. Its unit is mm if the scene has `picture.width` or
    /// `picture.height`.
    pub fn of(scene: &Scene) -> Self {
        let mut page = Self::of_picture(&scene.picture);
        if let Some(settings) = &scene.page {
            page.margin = page.length(settings.margin).unwrap_or_default();
            page.size += 2.0 * page.margin;
        }
        page
    }

    /// The page of a picture without margin.
    pub(crate) fn of_picture(picture: &PictureSettings) -> Self {
        let page = Self::in_pixels(picture.size, 0.0, picture.dpi);
        match picture.extent() {
            Some(extent) if extent.iter().any(|length| matches!(length, Length::Millimetres(_))) => {
                let [width, height] = extent.map(|length| page.length(length).unwrap_or_default());
                Self::in_millimetres(DVec2::new(width, height), 0.0, picture.dpi)
            }
            _ => page,
        }
    }

    /// Pixels of one millimetre.
    pub fn pixels_per_mm(&self) -> f64 {
        self.dpi / INCH
    }

    /// Width and height in whole pixels.
    pub fn pixels(&self) -> [usize; 2] {
        (self.size * self.pixels_per_mm()).to_array().map(|n| n.round_ties_even() as usize)
    }

    /// Width and height of the frame, which is the picture's, in mm.
    pub fn picture(&self) -> DVec2 {
        self.size - 2.0 * self.margin
    }

    /// Upper left and lower right corner of the frame, in mm.
    pub fn frame(&self) -> [DVec2; 2] {
        [DVec2::splat(self.margin), self.size - self.margin]
    }

    /// The place on the page of a point in a picture of `size` pixels. `at` is in pixels from the picture's upper left
    /// corner, the centre of the first pixel at (½, ½). The picture fills the frame. Rounding a length in mm to whole
    /// pixels therefore stretches it by less than half a pixel over the whole side.
    pub fn place(&self, at: DVec2, size: [usize; 2]) -> DVec2 {
        DVec2::splat(self.margin) + at * self.picture() / DVec2::from(size.map(|n| n as f64))
    }

    /// A length on the page in mm: mm, px, or per cent of the picture's height; none for a length in the world.
    pub fn length(&self, length: Length) -> Option<f64> {
        match length {
            Length::Millimetres(mm) => Some(mm),
            Length::Pixels(px) => Some(px / self.pixels_per_mm()),
            Length::Percent(percent) => Some(percent / 100.0 * self.picture().y),
            Length::World(_) | Length::Voxels(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::{Overrides, parse};

    #[test]
    fn an_inch_is_so_many_pixels() {
        let page = Page::in_millimetres(DVec2::new(180.0, 120.0), 10.0, 300.0);
        assert_eq!((page.size, page.picture()), (DVec2::new(200.0, 140.0), DVec2::new(180.0, 120.0)));
        // 200 mm are 2362.2 px, 140 mm 1653.5 px.
        assert_eq!(page.pixels(), [2362, 1654]);
        // 508 px at 127 dpi are 4 in = 101.6 mm, and 5 px are a millimetre.
        let page = Page::in_pixels([508, 254], 0.0, 127.0);
        assert_eq!((page.size, page.pixels_per_mm()), (DVec2::new(101.6, 50.8), 5.0));
        assert_eq!((page.pixels(), page.unit), ([508, 254], PageUnit::Pixels));
    }

    #[test]
    fn a_page_as_a_scene_says() {
        let scene = |text: &str| {
            let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{text}");
            parse(&text, std::path::Path::new("scene.toml"), &Overrides::default()).unwrap()
        };
        assert_eq!(Page::of(&scene("")), Page::in_pixels([512, 512], 0.0, 300.0));
        let mm = "[picture]\nwidth = \"180 mm\"\nheight = \"120 mm\"\ndpi = 254\n";
        assert_eq!(Page::of(&scene(mm)), Page::in_millimetres(DVec2::new(180.0, 120.0), 0.0, 254.0));
        let margin = format!("{mm}[page]\nmargin = \"50 px\"\n");
        assert_eq!(Page::of(&scene(&margin)), Page::in_millimetres(DVec2::new(180.0, 120.0), 5.0, 254.0));
        let pixels = "[page]\n[picture]\nwidth = \"254 px\"\nheight = \"127 px\"\ndpi = 254\n";
        assert_eq!(Page::of(&scene(pixels)), Page::in_pixels([254, 127], 10.0, 254.0));
        // One side in mm: 127 px are 12.7 mm.
        let mixed = "[picture]\nwidth = \"30 mm\"\nheight = \"127 px\"\ndpi = 254\n";
        assert_eq!(Page::of(&scene(mixed)), Page::in_millimetres(DVec2::new(30.0, 12.7), 0.0, 254.0));
        // A size that was changed since is what counts.
        let mut other = scene(mm);
        other.picture.size = [254, 254];
        assert_eq!(Page::of(&other), Page::in_pixels([254, 254], 0.0, 254.0));
    }

    #[test]
    fn the_picture_fills_the_frame() {
        let page = Page::in_millimetres(DVec2::new(180.0, 120.0), 10.0, 300.0);
        let size = [2126, 1417];
        assert_eq!(page.place(DVec2::ZERO, size), DVec2::splat(10.0));
        assert!((page.place(DVec2::new(2126.0, 1417.0), size) - DVec2::new(190.0, 130.0)).length() < 1e-12);
        assert!((page.place(DVec2::new(1063.0, 708.5), size) - DVec2::new(100.0, 70.0)).length() < 1e-12);
    }

    #[test]
    fn lengths_on_the_page_and_no_other() {
        let page = Page::in_millimetres(DVec2::new(180.0, 120.0), 10.0, 254.0);
        for (length, mm) in [
            (Length::Millimetres(0.35), Some(0.35)),
            (Length::Pixels(4.0), Some(0.4)),
            (Length::Percent(5.0), Some(6.0)),
            (Length::World(1.0), None),
            (Length::Voxels(1.0), None),
        ] {
            assert_eq!(page.length(length), mm, "{length:?}");
        }
    }
}
