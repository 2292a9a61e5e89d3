//! Plans for pen plotters ([IO-7], [STIP-16]). Dots have the nib's size, larger ones are filled, close ones are
//! dropped, and the order keeps pen travel short.

mod dot_spacing;
mod fill;
mod letters;
mod order;
mod travel;

use drypoint_scene::marks::{Layer, Marks, Polyline};

pub use travel::{Speed, Travel};

/// Marks that a plotter draws as they are, and what drawing takes.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotterPlan {
    /// Strokes of the nib's width in its colour, opaque, in drawing order. Each layer's dots come first, then its
    /// lines, each from its first vertex to its last.
    pub marks: Marks,
    /// Pen travel of each layer, in order.
    pub travel: Vec<Travel>,
    /// Number of dots dropped because they are closer than 0.7 nib to a drawn one.
    pub dropped: usize,
    /// Number of dots larger than their nib, which are among the lines.
    pub larger: usize,
    /// Number of lines that lose a taper, a colour or translucency to the nib ([HATCH-21]).
    pub plain: usize,
    /// Number of areas that are drawn as outlines, without their fill.
    pub unfilled: usize,
}

/// Least distance between dots of one pen, in nibs.
const CLOSEST: f64 = 0.7;

/// Returns an upper bound of the vertices of the strokes that fill dots larger than the nib in [`plan`].
pub fn filling_vertices(marks: &Marks) -> f64 {
    let of_layer = |layer: &Layer| layer.dots.iter().map(|dot| fill::vertices(dot, layer.pen.width)).sum::<f64>();
    marks.layers.iter().map(of_layer).sum()
}

/// Turns marks into what their pens can draw.
///
/// A dot up to the nib's size becomes one touch, a larger one a circle or a spiral out to its rim. A pen has one width,
/// one colour and no opacity. A translucent dot is therefore drawn opaque, and a line once along its middle.
///
/// Text becomes single strokes of the height and width that it has in the font. Areas become their outlines.
///
/// If two dots are closer than 0.7 nib, only the first is drawn. The order is never longer than the list's own. Each
/// layer begins at the page's upper left corner.
pub fn plan(marks: &Marks, speed: &Speed) -> PlotterPlan {
    let (mut layers, mut travel, mut dropped, mut larger, mut plain, mut unfilled) =
        (Vec::new(), Vec::new(), 0, 0, 0, 0);
    for layer in &marks.layers {
        let nib = layer.pen.width;
        let kept = dot_spacing::spaced(&layer.dots, CLOSEST * nib);
        dropped += layer.dots.len() - kept.len();
        let mut drawn = Layer::new(layer.pen.clone());
        for mut dot in kept {
            match fill::stroke(&dot, nib) {
                Some(line) => {
                    larger += 1;
                    drawn.lines.push(line);
                }
                None => {
                    (dot.radius, dot.opacity) = (nib / 2.0, 1.0);
                    drawn.dots.push(dot);
                }
            }
        }
        let lines = || layer.lines.iter().filter(|line| line.vertices.len() > 1);
        plain += lines().filter(|line| !has_one_ink(line)).count();
        drawn.lines.extend(lines().map(|line| thin_line(line, nib)));
        unfilled += layer.areas.len();
        drawn.lines.extend(layer.areas.iter().flat_map(|area| letters::outlines(area, nib)));
        for text in &layer.texts {
            let (touches, strokes) = letters::letters(text, nib);
            drawn.dots.extend(touches);
            drawn.lines.extend(strokes);
        }
        order::dots(&mut drawn.dots);
        let from = drawn.dots.last().map(|dot| dot.at).unwrap_or_default();
        order::lines(&mut drawn.lines, from);
        travel.push(Travel::of(&drawn, speed));
        layers.push(drawn);
    }
    PlotterPlan { marks: Marks { page: marks.page, layers }, travel, dropped, larger, plain, unfilled }
}

/// Whether a line has one width, is opaque and has no colour of its own.
fn has_one_ink(line: &Polyline) -> bool {
    let first = line.vertices.first().map(|vertex| vertex.radius);
    line.vertices.iter().all(|v| Some(v.radius) == first && v.opacity == 1.0 && v.color.is_none())
}

/// Returns the line as the nib draws it.
fn thin_line(line: &Polyline, nib: f64) -> Polyline {
    let mut line = line.clone();
    for vertex in &mut line.vertices {
        (vertex.radius, vertex.opacity, vertex.color) = (nib / 2.0, 1.0, None);
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::{DVec2, DVec3};
    use drypoint_scene::marks::{Area, Dot, Page, Pen, Text, Vertex};

    fn dot(x: f64, y: f64, radius: f64) -> Dot {
        Dot { at: DVec2::new(x, y), world: DVec3::ZERO, radius, opacity: 0.5 }
    }

    fn line(places: &[(f64, f64)]) -> Polyline {
        let vertex = |&(x, y): &(f64, f64)| Vertex {
            at: DVec2::new(x, y),
            world: DVec3::ZERO,
            radius: 0.4,
            opacity: 0.25,
            t: 0.0,
            color: None,
        };
        Polyline { vertices: places.iter().map(vertex).collect(), closed: false }
    }

    fn planned(dots: Vec<Dot>, lines: Vec<Polyline>) -> PlotterPlan {
        let pen = Pen { number: 1, name: "black".into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] };
        let page = Page::in_millimetres(DVec2::splat(100.0), 0.0, 300.0);
        plan(&Marks { page, layers: vec![Layer { dots, lines, ..Layer::new(pen) }] }, &Speed::default())
    }

    #[test]
    fn a_dot_is_a_touch_and_a_large_one_a_stroke() {
        let plan = planned(vec![dot(10.0, 10.0, 0.1), dot(20.0, 10.0, 0.15), dot(30.0, 10.0, 0.5)], vec![]);
        let layer = &plan.marks.layers[0];
        assert_eq!(
            layer.dots.iter().map(|d| (d.at.x, d.radius, d.opacity)).collect::<Vec<_>>(),
            [(10.0, 0.15, 1.0), (20.0, 0.15, 1.0)]
        );
        assert_eq!((layer.lines.len(), plan.larger, plan.dropped), (1, 1, 0));
        // The stroke's rim is the dot's: its middle line ends at 0.5 − 0.15 from the centre, on steps of 0.001 mm.
        let far = layer.lines[0].vertices.iter().map(|v| v.at.distance(DVec2::new(30.0, 10.0))).fold(0.0, f64::max);
        assert!((far - 0.35).abs() < 1e-3, "{far}");
    }

    #[test]
    fn no_two_dots_closer_than_the_nib_allows() {
        // 0.7 nib are 0.21 mm: the second is 0.2 from the first, the third 0.21 from it.
        let plan = planned(vec![dot(10.0, 10.0, 0.1), dot(10.2, 10.0, 0.1), dot(10.21, 10.0, 0.1)], vec![]);
        assert_eq!((plan.marks.layers[0].dots.len(), plan.dropped), (2, 1));
        // White noise on 20 × 20 mm, more than fit.
        let mut state = 7_u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) % 20_000) as f64 / 1000.0
        };
        let plan = planned((0..20_000).map(|_| dot(draw(), draw(), 0.1)).collect(), vec![]);
        let dots = &plan.marks.layers[0].dots;
        assert_eq!(dots.len() + plan.dropped, 20_000);
        assert!(dots.len() > 4000, "{}", dots.len());
        for (i, a) in dots.iter().enumerate() {
            assert!(dots[..i].iter().all(|b| a.at.distance(b.at) > 0.21 - 1e-9));
        }
    }

    #[test]
    fn strokes_have_the_nib_and_a_short_way_between() {
        let lines = vec![
            line(&[(50.0, 50.0), (60.0, 50.0)]),
            line(&[(1.0, 1.0), (2.0, 1.0)]),
            line(&[(49.0, 50.0), (3.0, 1.0)]),
        ];
        let plan = planned(vec![], lines);
        let layer = &plan.marks.layers[0];
        assert!(layer.lines.iter().flat_map(|l| &l.vertices).all(|v| (v.radius, v.opacity) == (0.15, 1.0)));
        // They were faint.
        assert_eq!(plan.plain, 3);
        // From the corner: the second, the third backwards, the first. Ways: √2, 1, 1.
        let starts: Vec<f64> = layer.lines.iter().map(|l| l.vertices[0].at.x).collect();
        assert_eq!(starts, [1.0, 3.0, 50.0]);
        assert!((plan.travel[0].pen_up - (2f64.sqrt() + 2.0)).abs() < 1e-12, "{:?}", plan.travel);
    }

    #[test]
    fn what_the_nib_drops_is_counted() {
        let mut lines = vec![line(&[(1.0, 1.0), (2.0, 1.0), (3.0, 1.0)]); 4];
        lines.iter_mut().flat_map(|line| &mut line.vertices).for_each(|vertex| vertex.opacity = 1.0);
        lines[1].vertices[2].radius = 0.1;
        lines[2].vertices[0].color = Some([1.0, 0.0, 0.0]);
        assert_eq!(planned(vec![], lines).plain, 2);
    }

    #[test]
    fn areas_and_text_become_strokes() {
        let pen = Pen { number: 1, name: "black".into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] };
        let page = Page::in_millimetres(DVec2::splat(100.0), 0.0, 300.0);
        let corners = [(10.0, 10.0), (30.0, 10.0), (30.0, 20.0)].map(DVec2::from).to_vec();
        let area = Area { outlines: vec![corners], opacity: 0.5, color: Some([1.0, 0.0, 0.0]) };
        let text = Text { characters: "HI".into(), at: DVec2::splat(50.0), size: 4.0, opacity: 1.0 };
        let layer = Layer { areas: vec![area], texts: vec![text], ..Layer::new(pen) };
        let plan = plan(&Marks { page, layers: vec![layer] }, &Speed::default());
        let drawn = &plan.marks.layers[0];
        assert!(drawn.areas.is_empty() && drawn.texts.is_empty() && plan.unfilled == 1);
        assert_eq!((drawn.lines.iter().filter(|line| line.closed).count(), drawn.lines.len()), (1, 1 + 3 + 1));
        assert!(drawn.lines.iter().flat_map(|line| &line.vertices).all(|v| v.radius == 0.15 && v.color.is_none()));
    }

    #[test]
    fn nothing_to_draw() {
        let plan = planned(vec![], vec![line(&[(1.0, 1.0)])]);
        assert_eq!((plan.marks.layers[0].lines.len(), plan.travel[0].pen_up, plan.travel[0].seconds), (0, 0.0, 0.0));
    }
}
