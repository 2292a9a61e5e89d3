//! Marks on steps ([STIP-16]), so that every file has the same geometry.

use super::{Marks, PageUnit};
use crate::color::{Rgb, linear_to_srgb, srgb_to_linear};
use glam::DVec2;

/// Steps of a millimetre for places: 0.001 mm.
const PLACE: f64 = 1000.0;

/// Steps of 1 for opacities: sixteenths.
pub(super) const OPACITY: f64 = 16.0;

/// The multiple of 1/`steps` nearest to `x`; ties go to the even one. Dividing an integer by an integer gives the
/// number that the decimals are read as.
pub(super) fn nearest(x: f64, steps: f64) -> f64 {
    (x * steps).round_ties_even() / steps
}

/// A colour on the codes of sRGB's bytes.
fn on_codes(color: Rgb) -> Rgb {
    color.map(|c| srgb_to_linear(nearest(linear_to_srgb(c).clamp(0.0, 1.0), 255.0)))
}

/// A place on the page on its step of 0.001 mm.
pub fn on_step(at: DVec2) -> DVec2 {
    DVec2::new(nearest(at.x, PLACE), nearest(at.y, PLACE))
}

/// Rounds the points of an outline, and removes those that repeat their neighbour or are not numbers.
fn round_outline(outline: &mut Vec<DVec2>) {
    outline.iter_mut().for_each(|at| *at = on_step(*at));
    outline.retain(|at| at.is_finite());
    outline.dedup();
    while outline.len() > 1 && outline.first() == outline.last() {
        outline.pop();
    }
}

impl Marks {
    /// Prepares marks for every writer: rounds them to steps and clips them to the frame.
    pub fn settle(&mut self) {
        // First the steps: a radius that grows must not reach over the edge. Then again for the ends of lines that are cut.
        self.round();
        self.keep_inside();
        self.round();
    }

    /// Rounds every mark to its step: places and sizes of text to 0.001 mm, radii to 0.005 mm, opacities to 1/16, colours
    /// of vertices and areas to 1/255 of sRGB. If the scene counts in pixels, the step of radii is 0.001 mm too, because dots may then be a few
    /// hundredths of a millimetre.
    ///
    /// Dots that then have no radius or opacity, or whose place is not a number, are removed. Vertices whose place is
    /// not a number are removed, too, and then lines of fewer than two vertices. Areas lose repeated points and those whose
    /// place is not a number, then outlines of fewer than three points. Areas and text that cannot be seen are removed.
    /// Rounding twice changes nothing.
    pub fn round(&mut self) {
        let radius_steps = match self.page.unit {
            PageUnit::Millimetres => 200.0,
            PageUnit::Pixels => PLACE,
        };
        for layer in &mut self.layers {
            layer.dots.retain_mut(|dot| {
                dot.at = on_step(dot.at);
                dot.radius = nearest(dot.radius, radius_steps);
                dot.opacity = nearest(dot.opacity.min(1.0), OPACITY);
                dot.at.is_finite() && dot.radius > 0.0 && dot.radius.is_finite() && dot.opacity > 0.0
            });
            layer.lines.retain_mut(|line| {
                line.vertices.retain_mut(|vertex| {
                    vertex.at = on_step(vertex.at);
                    vertex.radius = nearest(vertex.radius, radius_steps);
                    vertex.opacity = nearest(vertex.opacity.clamp(0.0, 1.0), OPACITY);
                    vertex.color = vertex.color.map(on_codes);
                    vertex.at.is_finite() && vertex.radius.is_finite()
                });
                line.vertices.len() > 1
            });
            layer.areas.retain_mut(|area| {
                area.outlines.iter_mut().for_each(round_outline);
                area.outlines.retain(|outline| outline.len() > 2);
                area.opacity = nearest(area.opacity.min(1.0), OPACITY);
                area.color = area.color.map(on_codes);
                !area.outlines.is_empty() && area.opacity > 0.0
            });
            layer.texts.retain_mut(|text| {
                text.at = on_step(text.at);
                text.size = nearest(text.size, PLACE);
                text.opacity = nearest(text.opacity.min(1.0), OPACITY);
                let is_seen = text.size > 0.0 && text.opacity > 0.0 && !text.characters.trim().is_empty();
                is_seen && text.at.is_finite() && text.size.is_finite()
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Area, Dot, Layer, Page, Pen, Polyline, Text, Vertex};
    use super::*;
    use glam::DVec3;

    fn dot(x: f64, y: f64, radius: f64, opacity: f64) -> Dot {
        Dot { at: DVec2::new(x, y), world: DVec3::new(0.1234567, 0.0, 0.0), radius, opacity }
    }

    fn marks(page: Page, dots: Vec<Dot>) -> Marks {
        let pen = Pen { number: 1, name: "black".into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] };
        Marks { page, layers: vec![Layer { dots, ..Layer::new(pen) }] }
    }

    #[test]
    fn hand_worked_steps() {
        let list = vec![dot(12.34567, 0.00049, 0.1234, 0.52), dot(1.0, 2.0, 0.0024, 1.0), dot(1.0, 2.0, 1.0, 0.03)];
        let mut paper = marks(Page::in_millimetres(DVec2::splat(100.0), 0.0, 300.0), list.clone());
        paper.round();
        // 0.1234 lies between 0.120 and 0.125; 0.52 between 8/16 and 9/16; 0.0024 is below half a step, 0.03 below 1/32.
        assert_eq!(paper.layers[0].dots, [dot(12.346, 0.0, 0.125, 0.5)]);
        let mut screen = marks(Page::in_pixels([100, 100], 0.0, 300.0), list);
        screen.round();
        assert_eq!(screen.layers[0].dots, [dot(12.346, 0.0, 0.123, 0.5), dot(1.0, 2.0, 0.002, 1.0)]);
    }

    #[test]
    fn a_step_is_the_number_that_its_decimals_say() {
        // Otherwise a list that is written in decimals would come back with other bits.
        for n in 0..20_000u32 {
            let text = format!("{}.{:03}", n / 1000, n % 1000);
            let said: f64 = text.parse().unwrap();
            assert_eq!(nearest(said + 2e-4, PLACE).to_bits(), said.to_bits(), "{text}");
            assert_eq!(nearest(said, PLACE).to_bits(), said.to_bits(), "{text}");
        }
    }

    #[test]
    fn rounding_twice_changes_nothing() {
        let dots = (1..2000).map(|i| f64::from(i) * 0.0777).map(|x| dot(x, 1.0 / x, x / 90.0, x / 160.0)).collect();
        let mut once = marks(Page::in_millimetres(DVec2::splat(100.0), 0.0, 300.0), dots);
        once.round();
        let mut twice = once.clone();
        twice.round();
        assert_eq!(once, twice);
    }

    #[test]
    fn a_dot_that_rounding_pushes_over_the_edge_is_left_out() {
        // Radius 0.1026 becomes 0.105; the centre is 0.103 from the edge, and 0.105 for the one that stays.
        let mut list = marks(
            Page::in_millimetres(DVec2::splat(90.0), 5.0, 300.0),
            vec![dot(5.103, 50.0, 0.1026, 1.0), dot(5.1049, 50.0, 0.1026, 1.0)],
        );
        list.settle();
        assert_eq!(list.layers[0].dots, [dot(5.105, 50.0, 0.105, 1.0)]);
    }

    #[test]
    fn what_is_no_number_is_left_out() {
        let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        let mut dots: Vec<Dot> = bad.iter().map(|&x| dot(x, 1.0, 1.0, 1.0)).collect();
        dots.extend([dot(1.0, 1.0, f64::NAN, 1.0), dot(1.0, 1.0, f64::INFINITY, 1.0), dot(1.0, 1.0, -1.0, 1.0)]);
        let mut list = marks(Page::in_millimetres(DVec2::splat(100.0), 0.0, 300.0), dots);
        let vertex =
            |x| Vertex { at: DVec2::new(x, 0.0), world: DVec3::ZERO, radius: 0.1, opacity: 2.0, t: 0.0, color: None };
        let line = |xs: [f64; 3]| Polyline { vertices: xs.map(vertex).to_vec(), closed: false };
        list.layers[0].lines = vec![line([0.0, f64::NAN, 1.0]), line([0.0, f64::NAN, f64::INFINITY])];
        list.round();
        assert_eq!((list.layers[0].dots.len(), list.layers[0].lines.len()), (0, 1));
        let vertices = &list.layers[0].lines[0].vertices;
        assert_eq!((vertices.len(), vertices[0].opacity), (2, 1.0));
    }

    #[test]
    fn areas_and_text_are_on_steps() {
        let points = [(1.0004, 2.0006), (1.00041, 2.0006), (3.0, f64::NAN), (5.0, 2.0), (5.0, 6.0), (1.0, 2.001)];
        let points: Vec<DVec2> = points.into_iter().map(DVec2::from).collect();
        let flat = vec![DVec2::ZERO, DVec2::new(1e-4, 0.0), DVec2::ONE];
        let area = |outlines: &[&Vec<DVec2>], opacity: f64| Area {
            outlines: outlines.iter().map(|&outline| outline.clone()).collect(),
            opacity,
            color: Some([0.5, 2.0, 0.0]),
        };
        let text = |characters: &str, size: f64, opacity: f64| Text {
            characters: characters.into(),
            at: DVec2::new(1.00049, 2.0),
            size,
            opacity,
        };
        let mut list = marks(Page::in_millimetres(DVec2::splat(100.0), 0.0, 300.0), vec![]);
        list.layers[0].areas = vec![area(&[&flat, &points], 0.52), area(&[&flat], 1.0), area(&[&points], 0.03)];
        list.layers[0].texts = vec![
            text("a", 3.0004, 2.0),
            text(" ", 3.0, 1.0),
            text("a", 0.0004, 1.0),
            text("a", 3.0, 0.0),
            text("a", f64::INFINITY, 1.0),
        ];
        list.round();
        let corners = [(1.0, 2.001), (5.0, 2.0), (5.0, 6.0)].map(DVec2::from).to_vec();
        assert_eq!(
            list.layers[0].areas,
            [Area { outlines: vec![corners], opacity: 0.5, color: Some([srgb_to_linear(188.0 / 255.0), 1.0, 0.0]) }]
        );
        assert_eq!(list.layers[0].texts, [Text { at: DVec2::new(1.0, 2.0), ..text("a", 3.0, 1.0) }]);
        let once = list.clone();
        list.round();
        assert_eq!(list, once);
    }
}
