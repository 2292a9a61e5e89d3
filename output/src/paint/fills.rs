//! Painting of areas and text over a picture.

use super::PageWindow;
use super::canvas::{BlendColor, Canvas};
use super::pixel_rect::PixelRect;
use crate::text::font;
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Area, Text};

/// Draws a layer's areas in their order. Each is composited by itself.
pub(super) fn paint_areas(
    areas: &[Area],
    window: &PageWindow,
    size: [usize; 2],
    pen: &BlendColor,
    canvas: &mut Canvas,
) {
    for area in areas {
        let own = area.color.map(|[r, g, b]| canvas.ink([r, g, b, pen.opacity]));
        fill(&area.outlines, area.opacity, window, size, own.as_ref().unwrap_or(pen), canvas);
    }
}

/// Draws a layer's lines of text in their order. The letters of a line cover a place only once.
pub(super) fn paint_texts(
    texts: &[Text],
    window: &PageWindow,
    size: [usize; 2],
    pen: &BlendColor,
    canvas: &mut Canvas,
) {
    for text in texts {
        fill(&font::outlines(text), text.opacity, window, size, pen, canvas);
    }
}

/// Fills outlines by the nonzero rule. It touches only the pixels around them.
fn fill(
    outlines: &[Vec<DVec2>],
    opacity: f64,
    window: &PageWindow,
    size: [usize; 2],
    ink: &BlendColor,
    canvas: &mut Canvas,
) {
    let Some(part) = PixelRect::around_outlines(outlines, window, size) else { return };
    let Some(cover) = part.fill(outlines, window) else { return };
    part.each(&cover, |_, pixel, covered| canvas.put(pixel, ink, covered * opacity));
}

#[cfg(test)]
mod tests {
    use super::super::{blank, paint};
    use super::*;
    use drypoint_scene::color::Rgba;
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::marks::{Dot, Layer, Marks, Page, Pen, Polyline, Vertex};
    use drypoint_scene::picture::Picture;
    use drypoint_scene::tables::BlendSpace;

    /// Pixels of a millimetre.
    const SCALE: f64 = 5.0;

    /// A layer of black ink on 300 × 100 px.
    fn layer() -> Layer {
        Layer::new(Pen { number: 1, name: "pen".into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] })
    }

    fn painted(layer: Layer) -> Picture {
        let page = Page::in_pixels([300, 100], 0.0, 127.0);
        let mut picture = blank(&page, None).unwrap();
        let marks = Marks { page, layers: vec![layer] };
        paint(&marks, &PageWindow::page(&page), BlendSpace::Linear, &mut picture).unwrap();
        picture
    }

    /// A box given by its corners in pixels.
    fn rectangle(low: [f64; 2], high: [f64; 2], opacity: f64) -> Area {
        let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
        let outlines = vec![corners.map(|p| DVec2::from(p) / SCALE).to_vec()];
        Area { outlines, opacity, color: None }
    }

    fn text(characters: &str, at: [f64; 2], size: f64, opacity: f64) -> Text {
        Text { characters: characters.into(), at: DVec2::from(at) / SCALE, size: size / SCALE, opacity }
    }

    fn pixel(picture: &Picture, i: usize, j: usize) -> Rgba {
        [0, 1, 2, 3].map(|c| picture.layers[0].channels[c][j * picture.width + i])
    }

    /// The sum of opacities, in pixels.
    fn ink(picture: &Picture) -> f64 {
        picture.layers[0].channels[3].iter().sum()
    }

    /// The area of outlines in square pixels, less that of counters, and their length in pixels.
    fn area_and_length(outlines: &[Vec<DVec2>]) -> (f64, f64) {
        let (mut area, mut length) = (0.0, 0.0);
        for points in outlines {
            for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
                area += a.perp_dot(*b) / 2.0;
                length += a.distance(*b);
            }
        }
        (area.abs() * SCALE * SCALE, length * SCALE)
    }

    #[test]
    fn a_box_covers_its_area() {
        // Whole pixels are exact.
        let whole = painted(Layer { areas: vec![rectangle([4.0, 2.0], [12.0, 9.0], 1.0)], ..layer() });
        assert_eq!(ink(&whole), 56.0);
        assert_eq!([3, 4, 11, 12].map(|i| pixel(&whole, i, 5)[3]), [0.0, 1.0, 1.0, 0.0]);
        // A quarter of a pixel is a step of the rasterizer, and coverage has steps of 1/255.
        let part = painted(Layer { areas: vec![rectangle([4.25, 2.5], [12.5, 9.75], 1.0)], ..layer() });
        assert!((ink(&part) - 8.25 * 7.25).abs() <= 32.0 / 255.0, "{}", ink(&part));
        assert!((pixel(&part, 4, 5)[3] - 0.75).abs() <= 1.0 / 255.0 && pixel(&part, 5, 5)[3] == 1.0);
        // Opacities multiply, and what lies outside the page is not there.
        let mut faint = layer();
        faint.pen.color[3] = 0.5;
        faint.areas = vec![rectangle([-40.0, -1e6], [10.0, 1e6], 0.25)];
        assert!((ink(&painted(faint)) - 10.0 * 100.0 * 0.125).abs() < 1e-9);
    }

    /// Outlines of one area are filled by the nonzero rule: a hole turns the other way.
    #[test]
    fn an_outline_within_another_is_a_hole_if_it_turns_the_other_way() {
        let with_inner = |reversed: bool| {
            let mut area = rectangle([10.0, 10.0], [30.0, 30.0], 1.0);
            let mut inner = rectangle([15.0, 15.0], [20.0, 20.0], 1.0).outlines.remove(0);
            if reversed {
                inner.reverse();
            }
            area.outlines.push(inner);
            ink(&painted(Layer { areas: vec![area], ..layer() }))
        };
        assert_eq!([with_inner(false), with_inner(true)], [400.0, 375.0]);
    }

    /// The rasterizer counts four by four places a pixel, so it misses at most an eighth of a pixel along an outline.
    /// Over shifts within the distance of those places the misses cancel.
    #[test]
    fn letters_cover_the_area_of_their_outlines() {
        for (characters, size) in [("l", 60.0), ("o", 60.0), ("Drypoint é", 50.0), ("0.4 µm ☃", 20.0), ("abc", 10.0)]
        {
            let mut sum = 0.0;
            let (mut area, mut length) = (0.0, 0.0);
            for shift in 0..16 {
                let at = [10.0 + f64::from(shift) / 64.0, 70.0 + f64::from(shift * 5 % 16) / 64.0];
                let text = text(characters, at, size, 1.0);
                (area, length) = area_and_length(&font::outlines(&text));
                let found = ink(&painted(Layer { texts: vec![text], ..layer() }));
                assert!((found - area).abs() < length / 8.0, "{characters}: {found}, {area} along {length}");
                sum += found / 16.0;
            }
            assert!((sum / area - 1.0).abs() < 0.01, "{characters}: {sum} of {area} along {length}");
        }
    }

    #[test]
    fn letters_of_a_line_cover_once() {
        let whole = painted(Layer { texts: vec![text("Ḁe\u{301}", [10.0, 70.0], 60.0, 1.0)], ..layer() });
        let half = painted(Layer { texts: vec![text("Ḁe\u{301}", [10.0, 70.0], 60.0, 0.5)], ..layer() });
        let channel = |picture: &Picture| picture.layers[0].channels[3].clone();
        for (whole, half) in channel(&whole).into_iter().zip(channel(&half)) {
            assert!((half - 0.5 * whole).abs() < 1e-12);
        }
        assert!(ink(&whole) > 100.0);
    }

    #[test]
    fn text_outside_the_page_is_not_there() {
        for at in [[-500.0, 50.0], [400.0, 50.0], [10.0, -50.0], [10.0, 500.0], [1e9, 1e9], [1e300, -1e300]] {
            assert_eq!(ink(&painted(Layer { texts: vec![text("Drypoint", at, 20.0, 1.0)], ..layer() })), 0.0);
        }
        // A part of it is.
        let part = ink(&painted(Layer { texts: vec![text("HHHH", [-20.0, 50.0], 20.0, 1.0)], ..layer() }));
        let all = ink(&painted(Layer { texts: vec![text("HHHH", [20.0, 50.0], 20.0, 1.0)], ..layer() }));
        assert!(part > 0.5 * all && part < 0.8 * all, "{part} of {all}");
    }

    /// Areas lie below lines and dots, and text above them.
    #[test]
    fn areas_then_lines_and_dots_then_text() {
        let mut layer = layer();
        layer.pen.color = [0.0, 1.0, 0.0, 1.0];
        let (red, blue) = (Some([1.0, 0.0, 0.0]), Some([0.0, 0.0, 1.0]));
        let vertex = |x: f64| Vertex {
            at: DVec2::new(x, 50.0) / SCALE,
            world: DVec3::ZERO,
            radius: 5.0 / SCALE,
            opacity: 1.0,
            t: 0.0,
            color: red,
        };
        layer.lines = vec![Polyline { vertices: vec![vertex(0.0), vertex(300.0)], closed: false }];
        layer.dots = vec![Dot { at: DVec2::new(150.0, 80.0) / SCALE, world: DVec3::ZERO, radius: 2.0, opacity: 1.0 }];
        layer.areas = vec![Area { color: blue, ..rectangle([0.0, 0.0], [300.0, 100.0], 1.0) }];
        // The stem of a letter l is 0.081 em wide, from 0.086 em on.
        layer.texts = vec![text("l", [100.0, 70.0], 100.0, 1.0)];
        let found = painted(layer);
        let (red, green, blue) = ([1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]);
        assert_eq!(
            [[10, 10], [10, 50], [150, 80], [112, 50], [112, 30]].map(|[i, j]| pixel(&found, i, j)),
            [blue, red, green, green, green]
        );
    }
}
