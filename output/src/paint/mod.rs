//! Painting of marks over a picture ([STIP-16], [VAL-3]). Dots cover pixels by their exact area; lines, areas and text
//! cover them as [`raster`](crate::raster) does, in steps of 1/255.

mod canvas;
mod fills;
mod fragments;
mod lines;
mod overlay;
mod pixel_rect;

use crate::OutputError;
use crate::disc::{Scratch, cover};
use crate::finite::check_finite;
use crate::layers::{check, fault, room};
use canvas::Canvas;
use drypoint_scene::color::{Rgba, premultiply};
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Marks, Page};
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::tables::BlendSpace;

pub use fragments::fragments;
pub use overlay::overlay;

/// The part of a page that a picture shows, and its scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PageWindow {
    /// Upper left corner of the picture on the page, in mm.
    pub corner: DVec2,
    /// Pixels of a millimetre, across and down.
    pub scale: DVec2,
}

impl PageWindow {
    /// Returns the window of the whole page, as [`blank`] makes it.
    pub fn page(page: &Page) -> Self {
        Self { corner: DVec2::ZERO, scale: DVec2::splat(page.pixels_per_mm()) }
    }

    /// Returns the window of the frame alone, which a rendered picture of `size` pixels fills.
    pub fn frame(page: &Page, size: [usize; 2]) -> Self {
        Self { corner: DVec2::splat(page.margin), scale: DVec2::from(size.map(|n| n as f64)) / page.picture() }
    }

    /// Returns a point on the page in pixels of the picture.
    pub fn place(&self, at: DVec2) -> [f64; 2] {
        ((at - self.corner) * self.scale).to_array()
    }

    /// Returns a length in pixels, scaled so that areas are kept. Rounding a size in mm makes the scales across and
    /// down differ slightly.
    pub fn length(&self, mm: f64) -> f64 {
        mm * (self.scale.x * self.scale.y).sqrt()
    }
}

/// Largest number of pixels of a page, that of the largest picture.
pub const MOST_PIXELS: usize = 1 << 30;

/// Bytes of memory a pixel of a page until it is written: four channels, and their codes twice.
const PIXEL: usize = 4 * (8 + 2 + 2);

/// Checks that a page can be painted in pixels. Returns its width and height.
///
/// # Errors
/// [`OutputError::Layer`] for a page without a pixel, or of more than 2³⁰; [`OutputError::NoRoom`].
pub fn pixels(page: &Page) -> Result<[usize; 2], OutputError> {
    let [width, height] = page.pixels();
    if !width.checked_mul(height).is_some_and(|n| (1..=MOST_PIXELS).contains(&n)) {
        return Err(fault(LayerKind::Beauty, format!("a page of {width}x{height} pixels")));
    }
    room(None, [width, height], PIXEL)?;
    Ok([width, height])
}

/// Returns a page without marks. `background` is linear and straight; none is transparent.
///
/// # Errors
/// Same errors as [`pixels`].
pub fn blank(page: &Page, background: Option<Rgba>) -> Result<Picture, OutputError> {
    let [width, height] = pixels(page)?;
    let channels = premultiply(background.unwrap_or_default()).map(|c| vec![c; width * height]).into();
    Ok(Picture { width, height, layers: vec![Layer { kind: LayerKind::Beauty, channels }] })
}

/// Draws marks over the layer `beauty`, layer by layer: areas first, then lines, dots and text.
///
/// A dot covers the exact share of a pixel; two dots on a pixel add as c + d − cd, as if independent. All opaque lines
/// of one width are drawn as one outline. A translucent or coloured line is composited by itself, as each area
/// and each line of text is. With `blend` = `srgb`, encoded colours are composited, as in viewers of SVG and PDF.
///
/// # Errors
/// [`OutputError::Layer`] if the picture has no beauty, or one that does not fit its size; [`OutputError::NotFinite`].
pub fn paint(marks: &Marks, window: &PageWindow, blend: BlendSpace, picture: &mut Picture) -> Result<(), OutputError> {
    check_finite(marks)?;
    let size = [picture.width, picture.height];
    let mut canvas = Canvas::new(&mut beauty(picture)?.channels, blend);
    let mut scratch = Scratch::default();
    for layer in &marks.layers {
        let ink = canvas.ink(layer.pen.color);
        fills::paint_areas(&layer.areas, window, size, &ink, &mut canvas);
        lines::paint(&layer.lines, window, size, &ink, &mut canvas);
        for dot in &layer.dots {
            let [x, y] = window.place(dot.at);
            cover([x, y, window.length(dot.radius)], size, &mut scratch, |i, j, share| {
                canvas.put(j * size[0] + i, &ink, share * dot.opacity);
            });
        }
        fills::paint_texts(&layer.texts, window, size, &ink, &mut canvas);
    }
    canvas.finish();
    Ok(())
}

/// The layer that is painted on.
fn beauty(picture: &mut Picture) -> Result<&mut Layer, OutputError> {
    let at = picture.layers.iter().position(|layer| layer.kind == LayerKind::Beauty);
    let at = at.ok_or_else(|| fault(LayerKind::Beauty, "the picture does not have it".into()))?;
    check(picture, &picture.layers[at])?;
    Ok(&mut picture.layers[at])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::encode::{quantize, straight_srgb};
    use drypoint_scene::color::{linear_to_srgb, srgb_to_linear};
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::marks::{Dot, Layer as Drawn, Pen, Polyline, Vertex};
    use std::f64::consts::PI;

    const BLACK: Rgba = [0.0, 0.0, 0.0, 1.0];
    const WHITE: Rgba = [1.0; 4];

    /// 20 × 10 px, 5 px a millimetre.
    fn page() -> Page {
        Page::in_pixels([20, 10], 0.0, 127.0)
    }

    fn marks(color: Rgba, dots: Vec<Dot>, lines: Vec<Polyline>) -> Marks {
        let pen = Pen { number: 1, name: "pen".into(), width: 0.3, color };
        Marks { page: page(), layers: vec![Drawn { dots, lines, ..Drawn::new(pen) }] }
    }

    fn dot(x: f64, y: f64, radius: f64, opacity: f64) -> Dot {
        Dot { at: DVec2::new(x, y), world: DVec3::ZERO, radius, opacity }
    }

    fn line(opacity: f64, y: f64) -> Polyline {
        let vertex =
            |x: f64| Vertex { at: DVec2::new(x, y), world: DVec3::ZERO, radius: 0.2, opacity, t: 0.0, color: None };
        Polyline { vertices: vec![vertex(0.8), vertex(3.2)], closed: false }
    }

    fn painted(marks: &Marks, background: Option<Rgba>, blend: BlendSpace) -> Picture {
        let mut picture = blank(&marks.page, background).unwrap();
        paint(marks, &PageWindow::page(&marks.page), blend, &mut picture).unwrap();
        picture
    }

    fn pixel(picture: &Picture, i: usize, j: usize) -> Rgba {
        let channels = &picture.layers[0].channels;
        [0, 1, 2, 3].map(|c| channels[c][j * picture.width + i])
    }

    /// A line of two colours covers what a line of one colour does, also where they meet and where it grows wider. Each
    /// half has its own colour, and a later one lies over an earlier one.
    #[test]
    fn lines_with_colours_of_their_own() {
        let (red, blue) = (Some([1.0, 0.0, 0.0]), Some([0.0, 0.0, 1.0]));
        let vertex = |x: f64, y: f64, color| Vertex {
            at: DVec2::new(x, y),
            world: DVec3::ZERO,
            radius: 0.06,
            opacity: 1.0,
            t: 0.0,
            color,
        };
        let line = |vertices: Vec<Vertex>| Polyline { vertices, closed: false };
        let xs = [0.8, 1.9, 2.05, 3.2];
        let with = |colors: [Option<[f64; 3]>; 4]| {
            let vertices = xs.into_iter().zip(colors).map(|(x, color)| vertex(x, 0.93, color)).collect();
            painted(&marks(BLACK, vec![], vec![line(vertices)]), None, BlendSpace::Linear)
        };
        let (one, two) = (with([red; 4]), with([red, red, blue, blue]));
        assert_eq!(one.layers[0].channels[3], two.layers[0].channels[3]);
        let ([r, _, b, a], [r2, _, b2, a2]) = (pixel(&two, 6, 4), pixel(&two, 14, 4));
        assert!(r == a && b == 0.0 && b2 == a2 && r2 == 0.0 && a > 0.5, "{r} {b} {a} {r2} {b2} {a2}");
        // The piece between has the mean of both codes, which is darker than the mean of their light.
        let [r, _, b, a] = pixel(&two, 9, 4);
        assert!(r > 0.0 && b > 0.0 && r + b < a, "{r} {b} {a}");
        // Half of it faint: the joint is no darker than the whole.
        let faint = |opacities: [f64; 4]| {
            let vertex = |(x, opacity): (f64, f64)| Vertex { opacity, ..vertex(x, 0.93, None) };
            let line = line(xs.into_iter().zip(opacities).map(vertex).collect());
            painted(&marks(BLACK, vec![], vec![line]), None, BlendSpace::Linear)
        };
        let (half, steps) = (faint([0.5; 4]), faint([0.25, 0.25, 0.5, 0.5]));
        let alpha = |picture: &Picture, i| pixel(picture, i, 4)[3];
        assert!(
            (5..16).all(|i| alpha(&steps, i) <= alpha(&half, i) + 1e-12 && alpha(&steps, i) > 0.4 * alpha(&half, i))
        );
        let over = vec![vertex(2.5, 0.2, blue), vertex(2.5, 1.8, blue)];
        let crossed =
            marks(BLACK, vec![], vec![line(vec![vertex(0.8, 0.93, red), vertex(3.2, 0.93, red)]), line(over)]);
        let crossed = painted(&crossed, Some(WHITE), BlendSpace::Linear);
        assert!(pixel(&crossed, 12, 4)[2] > pixel(&crossed, 12, 4)[0]);
    }

    #[test]
    fn coverage_is_linear_light() {
        // A dot of 0.1 mm is 0.5 px: π/4 of the pixel about (10.5, 5.5), which is at (2.1, 1.1) mm.
        let black = marks(BLACK, vec![dot(2.1, 1.1, 0.1, 1.0)], vec![]);
        let over_white = painted(&black, Some(WHITE), BlendSpace::Linear);
        let (found, share) = (pixel(&over_white, 10, 5), PI / 4.0);
        assert!((found[0] - (1.0 - share)).abs() < 1e-14 && (found[3] - 1.0).abs() < 1e-15, "{found:?}");
        assert_eq!(pixel(&over_white, 9, 5), WHITE);
        let alone = pixel(&painted(&black, None, BlendSpace::Linear), 10, 5);
        assert!(alone[0] == 0.0 && (alone[3] - share).abs() < 1e-14, "{alone:?}");
        // Mean coverage of the page: πr² of 200 pixels.
        let ink: f64 = over_white.layers[0].channels[1].iter().map(|c| 1.0 - c).sum();
        assert!((ink - share).abs() < 1e-12);
    }

    #[test]
    fn encoded_values_are_blended_where_the_scene_says_so() {
        // 0.4 of a pixel in black over white: code 0.6, which is 0.3185 in linear light, not 0.6.
        let part = marks(BLACK, vec![dot(2.1, 1.1, 0.1, 0.4 / (PI / 4.0))], vec![]);
        let found = pixel(&painted(&part, Some(WHITE), BlendSpace::Srgb), 10, 5);
        assert!((found[0] - srgb_to_linear(0.6)).abs() < 1e-12, "{found:?}");
        assert_eq!(straight_srgb(found).map(|c| quantize(c, 255)), [153, 153, 153, 255]);
        // Over nothing the colour is the pen's, whatever is blended.
        let [r, g] = [0.6, 0.1].map(linear_to_srgb);
        let red = marks([0.6, 0.1, 0.1, 1.0], vec![dot(2.1, 1.1, 0.1, 1.0)], vec![]);
        let found = straight_srgb(pixel(&painted(&red, None, BlendSpace::Srgb), 10, 5));
        assert!((found[0] - r).abs() < 1e-9 && (found[1] - g).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn what_is_not_covered_keeps_its_bits() {
        let odd = [0.123_456_789, 0.2, 0.3, 0.9];
        for blend in [BlendSpace::Linear, BlendSpace::Srgb] {
            let found = painted(&marks(BLACK, vec![dot(2.1, 1.1, 0.1, 1.0)], vec![line(1.0, 0.3)]), Some(odd), blend);
            assert_eq!(pixel(&found, 0, 9), premultiply(odd));
        }
    }

    #[test]
    fn dots_add_as_if_independent() {
        let pair = marks(BLACK, vec![dot(2.1, 1.1, 0.1, 0.5), dot(2.1, 1.1, 0.1, 1.0)], vec![]);
        let found = pixel(&painted(&pair, None, BlendSpace::Linear), 10, 5)[3];
        let (a, b) = (PI / 8.0, PI / 4.0);
        assert!((found - (a + b - a * b)).abs() < 1e-14);
        // Halves of the pen's opacity multiply the dot's.
        let faint = marks([0.0, 0.0, 0.0, 0.5], vec![dot(2.1, 1.1, 0.1, 1.0)], vec![]);
        assert!((pixel(&painted(&faint, None, BlendSpace::Linear), 10, 5)[3] - a).abs() < 1e-14);
    }

    #[test]
    fn lines_cover_their_pixels() {
        // From (4, 5.5) to (16, 5.5) px, 2 px wide: the rows 5 whole, 4 and 6 half.
        for (opacity, expected) in [(1.0, [0.5, 1.0, 0.5]), (0.5, [0.25, 0.5, 0.25])] {
            let found = painted(&marks(BLACK, vec![], vec![line(opacity, 1.1)]), None, BlendSpace::Linear);
            for (j, share) in [4, 5, 6].into_iter().zip(expected) {
                // Coverage has steps of 1/255.
                assert!((pixel(&found, 10, j)[3] - share).abs() <= 1.0 / 255.0, "{j}: {:?}", pixel(&found, 10, j));
            }
            assert_eq!(pixel(&found, 18, 5), [0.0; 4]);
        }
        // A translucent line that the picture's edge cuts, and one beyond it.
        let found = painted(&marks(BLACK, vec![], vec![line(0.5, 0.0), line(0.5, 9.0)]), None, BlendSpace::Linear);
        assert!((pixel(&found, 10, 0)[3] - 0.5).abs() <= 1.0 / 255.0);
    }

    #[test]
    fn the_frame_is_the_picture() {
        // With a margin of 2 mm the frame's corner is (2, 2) mm; a picture of 8 × 4 px over 4 × 2 mm has 2 px a mm.
        let page = Page::in_millimetres(DVec2::new(4.0, 2.0), 2.0, 127.0);
        let window = PageWindow::frame(&page, [8, 4]);
        assert_eq!(window.place(DVec2::new(3.0, 2.5)), [2.0, 1.0]);
        assert_eq!(window.length(0.25), 0.5);
        let mut picture = Picture { width: 8, height: 4, ..blank(&Page::in_pixels([8, 4], 0.0, 1.0), None).unwrap() };
        let list = Marks { page, ..marks(BLACK, vec![dot(3.25, 2.25, 0.25, 1.0)], vec![]) };
        paint(&list, &window, BlendSpace::Linear, &mut picture).unwrap();
        assert!((pixel(&picture, 2, 0)[3] - PI / 4.0).abs() < 1e-15);
    }

    #[test]
    fn no_page_too_large_and_no_picture_without_beauty() {
        assert!(blank(&Page::in_pixels([1 << 15, (1 << 15) + 1], 0.0, 300.0), None).is_err());
        assert!(blank(&Page::in_millimetres(DVec2::splat(1e300), 0.0, 300.0), None).is_err());
        assert!(blank(&Page::in_millimetres(DVec2::splat(0.01), 0.0, 1.0), None).is_err());
        let mut none = Picture { width: 2, height: 2, layers: vec![] };
        let list = marks(BLACK, vec![], vec![]);
        assert!(paint(&list, &PageWindow::page(&list.page), BlendSpace::Linear, &mut none).is_err());
    }
}
