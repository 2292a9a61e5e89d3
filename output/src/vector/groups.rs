//! A layer's marks as few paths. Marks of equal width and opacity share a group; lines with their own colours keep
//! their order.

use super::curves::{PathSegment, curves};
use super::disjoint_dots::disjoint_sets;
use crate::grid::micrometres;
use crate::text::contour::{Contour, ContourSegment};
use crate::text::font;
use drypoint_scene::color::Rgb;
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Area, Layer, Piece, Polyline, Text};
use std::collections::BTreeMap;

/// A point on the page, in micrometres.
pub(super) type PagePoint = [i64; 2];

/// Paths of one width, opacity and colour, in micrometres.
pub(super) struct PathGroup {
    /// Width of the strokes; none: outlines to be filled.
    pub(super) width: Option<i64>,
    /// Opacity in (0, 1], times that of the pen's colour.
    pub(super) opacity: f64,
    /// Colour; none: the pen's.
    pub(super) color: Option<Rgb>,
    /// Dots; each inner list is one path.
    pub(super) dots: Vec<Vec<PagePoint>>,
    /// Lines, each a path of its own.
    pub(super) lines: Vec<VectorPath>,
}

/// A line of at least two points, or its outlines.
pub(super) struct VectorPath {
    pub(super) paths: Vec<Subpath>,
    pub(super) closed: bool,
}

/// A connected part of a path.
pub(super) enum Subpath {
    /// Straight lines from point to point.
    Straight(Vec<PagePoint>),
    /// A start point and segments. The last segment of a closed path ends at the start.
    Curved(PagePoint, Vec<PathSegment>),
}

impl Subpath {
    fn of(points: &[DVec2], closed: bool, beziers: bool) -> Self {
        match beziers.then(|| curves(points, closed)).flatten() {
            Some((start, steps)) => Self::Curved(start, steps),
            None => Self::Straight(points.iter().map(|p| p.to_array().map(micrometres)).collect()),
        }
    }

    /// Returns the path of a glyph's contour, with its curves.
    fn of_contour(contour: &Contour) -> Self {
        let place = |p: DVec2| p.to_array().map(micrometres);
        let segment = |segment: &ContourSegment| match *segment {
            ContourSegment::Line(to) => PathSegment::Line(place(to)),
            ContourSegment::Curve(places) => PathSegment::Curve(places.map(place)),
        };
        // Closing the path draws its last line.
        let segments = match contour.segments.split_last() {
            Some((ContourSegment::Line(_), rest)) => rest,
            _ => &contour.segments,
        };
        Self::Curved(place(contour.start), segments.iter().map(segment).collect())
    }

    /// Returns the start point and the segments; none without a point.
    pub(super) fn steps(&self) -> Option<(PagePoint, impl Iterator<Item = PathSegment>)> {
        let (start, points, steps): (_, &[PagePoint], &[PathSegment]) = match self {
            Self::Straight(points) => (*points.first()?, &points[1..], &[]),
            Self::Curved(start, steps) => (*start, &[], steps),
        };
        Some((start, points.iter().copied().map(PathSegment::Line).chain(steps.iter().copied())))
    }
}

impl VectorPath {
    fn of(piece: &Piece, is_stroke: bool, ink: f64, beziers: bool) -> Self {
        if is_stroke {
            return Self { paths: vec![Subpath::of(&piece.points, piece.closed, beziers)], closed: piece.closed };
        }
        let outlines = piece.outlines(ink);
        Self { paths: outlines.iter().map(|outline| Subpath::of(outline, true, beziers)).collect(), closed: true }
    }
}

/// Width, and the bits of the opacity.
type GroupKey = (Option<i64>, u64);

/// Most dots of one path. A reader that adds relative moves in single precision stays within 0.001 mm, and an editor
/// stays quick.
const CHUNK: usize = 256;

/// Returns the groups of a layer: outlines, then strokes by width and opacity, then coloured lines in order.
///
/// Dots of one path must not overlap unless they are opaque, because a path inks a place only once. Dots are sorted
/// into alternating rows, so that the moves between them are short. With `keep`, dots stay in their order. With
/// `beziers`, lines are smooth.
pub(super) fn groups(layer: &Layer, keep: bool, beziers: bool) -> Vec<PathGroup> {
    // The bits of positive numbers order as the numbers do.
    let mut found: BTreeMap<GroupKey, (Vec<PagePoint>, Vec<VectorPath>)> = BTreeMap::new();
    let ink = layer.pen.color[3];
    let bits = |opacity: f64| (opacity * ink).to_bits();
    for dot in &layer.dots {
        let at = dot.at.to_array().map(micrometres);
        found.entry((Some(micrometres(2.0 * dot.radius)), bits(dot.opacity))).or_default().0.push(at);
    }
    let (colored, plain): (Vec<Piece>, Vec<Piece>) =
        layer.lines.iter().flat_map(Polyline::pieces).partition(|piece| piece.color.is_some());
    let key = |piece: &Piece| (piece.stroke(ink).map(|radius| micrometres(2.0 * radius)), bits(piece.opacity));
    for piece in plain {
        let key = key(&piece);
        found.entry(key).or_default().1.push(VectorPath::of(&piece, key.0.is_some(), ink, beziers));
    }
    let like = |piece: &Piece| (key(piece), piece.color);
    let colored = colored.chunk_by(|a, b| like(a) == like(b)).map(|same| {
        let ((width, bits), color) = like(&same[0]);
        let lines = same.iter().map(|piece| VectorPath::of(piece, width.is_some(), ink, beziers)).collect();
        PathGroup { width, opacity: f64::from_bits(bits), color, dots: Vec::new(), lines }
    });
    found
        .into_iter()
        .map(|((width, bits), (mut dots, lines))| {
            let opacity = f64::from_bits(bits);
            if !keep {
                rows(&mut dots);
            }
            let sets = if opacity < 1.0 { disjoint_sets(&dots, width.unwrap_or_default()) } else { vec![dots] };
            let dots = sets.iter().flat_map(|set| set.chunks(CHUNK)).map(<[_]>::to_vec).collect();
            PathGroup { width, opacity, color: None, dots, lines }
        })
        .chain(colored)
        .collect()
}

/// Returns the groups of a layer's areas, in order. Areas of one opacity and colour that follow each other share a
/// group. With `beziers`, outlines are smooth between their corners.
pub(super) fn area_groups(layer: &Layer, beziers: bool) -> Vec<PathGroup> {
    let ink = layer.pen.color[3];
    let path = |area: &Area| {
        let paths = area.outlines.iter().filter(|outline| outline.len() > 2);
        VectorPath { paths: paths.map(|outline| Subpath::of(outline, true, beziers)).collect(), closed: true }
    };
    let same = |a: &Area, b: &Area| (a.opacity, a.color) == (b.opacity, b.color);
    let group = |areas: &[Area]| PathGroup {
        width: None,
        opacity: areas[0].opacity * ink,
        color: areas[0].color,
        dots: Vec::new(),
        lines: areas.iter().map(path).collect(),
    };
    layer.areas.chunk_by(same).map(group).collect()
}

/// Returns the groups of a layer's text as the outlines of its letters, in order. Each line of text is a path.
pub(super) fn letter_groups(layer: &Layer) -> Vec<PathGroup> {
    let ink = layer.pen.color[3];
    let path = |text: &Text| VectorPath {
        paths: font::contours(text).iter().map(Subpath::of_contour).collect(),
        closed: true,
    };
    let group = |texts: &[Text]| PathGroup {
        width: None,
        opacity: texts[0].opacity * ink,
        color: None,
        dots: Vec::new(),
        lines: texts.iter().map(path).collect(),
    };
    layer.texts.chunk_by(|a, b| a.opacity == b.opacity).map(group).collect()
}

/// Sorts dots by rows of a height that keeps the moves short, every second row backwards.
fn rows(dots: &mut [PagePoint]) {
    let Some(&first) = dots.first() else { return };
    let low = dots.iter().fold(first, |a, b| [a[0].min(b[0]), a[1].min(b[1])]);
    let high = dots.iter().fold(first, |a, b| [a[0].max(b[0]), a[1].max(b[1])]);
    let area = (high[0] - low[0]) as f64 * (high[1] - low[1]) as f64;
    // In a row of height h, with n dots a unit area, the next dot is on average 1/(hn) to the side and h/3 up or down.
    let height = ((3.0 * area / dots.len() as f64).sqrt() as i64).max(1);
    dots.sort_unstable_by_key(|&[x, y]| {
        let row = (y - low[1]) / height;
        (row, if row % 2 == 0 { x } else { -x }, y)
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::marks::{Dot, Pen, Vertex};

    fn layer(dots: &[(f64, f64, f64, f64)]) -> Layer {
        let pen = Pen { number: 1, name: "black".into(), width: 0.3, color: [0.0, 0.0, 0.0, 0.5] };
        let dot = |&(x, y, radius, opacity): &(f64, f64, f64, f64)| Dot {
            at: DVec2::new(x, y),
            world: DVec3::ZERO,
            radius,
            opacity,
        };
        Layer { dots: dots.iter().map(dot).collect(), ..Layer::new(pen) }
    }

    #[test]
    fn one_group_a_width_and_opacity() {
        let found = groups(
            &layer(&[(1.0, 1.0, 0.2, 1.0), (2.0, 1.0, 0.1, 1.0), (3.0, 1.0, 0.2, 0.5), (4.0, 1.0, 0.2, 1.0)]),
            false,
            false,
        );
        let shape: Vec<_> = found.iter().map(|g| (g.width, g.opacity, g.dots.clone())).collect();
        assert_eq!(
            shape,
            [
                (Some(200), 0.5, vec![vec![[2000, 1000]]]),
                (Some(400), 0.25, vec![vec![[3000, 1000]]]),
                (Some(400), 0.5, vec![vec![[1000, 1000], [4000, 1000]]]),
            ]
        );
    }

    /// Black lines by width, then the coloured one, from its first vertex to its last.
    #[test]
    fn lines_with_colours_keep_their_order() {
        let vertex = |x: f64, red: Option<f64>| Vertex {
            at: DVec2::new(x, 0.0),
            world: DVec3::ZERO,
            radius: 0.1,
            opacity: 1.0,
            t: 0.0,
            color: red.map(|red| [red, 0.0, 0.0]),
        };
        let line = |vertices: Vec<Vertex>| Polyline { vertices, closed: false };
        let mut layer = layer(&[]);
        layer.lines = vec![
            line(vec![vertex(0.0, Some(0.5)), vertex(1.0, Some(0.5)), vertex(2.0, Some(0.0)), vertex(3.0, Some(0.0))]),
            line(vec![vertex(5.0, None), vertex(6.0, None)]),
        ];
        let found = groups(&layer, false, false);
        let starts: Vec<i64> = found.iter().map(|group| group.lines[0].paths[0].steps().unwrap().0[0]).collect();
        let reds: Vec<Option<f64>> = found.iter().map(|group| group.color.map(|color| color[0])).collect();
        assert_eq!(starts, [5000, 0, 1000, 2000]);
        // 0.5 is the code 188 in sRGB, 187.5, which is 0.5029; half of it is 93.76, and 94 is 0.1119.
        let near = |red: Option<f64>, wanted: f64| red.is_some_and(|red| (red - wanted).abs() < 1e-4);
        assert!(reds[0].is_none() && near(reds[1], 0.5029) && near(reds[2], 0.1119) && near(reds[3], 0.0), "{reds:?}");
    }

    #[test]
    fn rows_to_and_fro() {
        // A grid of 4 × 4: rows of √(3·9/16) = 1.3 steps hold one or two lines of it.
        let mut dots: Vec<PagePoint> = (0..16).map(|i| [i * 7 % 4 * 1000, i * 5 % 16 / 4 * 1000]).collect();
        rows(&mut dots);
        let way: i64 = dots.windows(2).map(|w| (w[1][0] - w[0][0]).abs() + (w[1][1] - w[0][1]).abs()).sum();
        // The shortest way is 15 steps; a row of two lines costs at most one more a dot.
        assert!(way <= 31_000, "{way}");
    }

    #[test]
    fn dots_keep_their_order_where_it_is_a_plan() {
        let plan = [(9.0, 1.0, 0.2, 1.0), (1.0, 5.0, 0.2, 1.0), (5.0, 1.0, 0.2, 1.0)];
        let mut opaque = layer(&plan);
        opaque.pen.color[3] = 1.0;
        assert_eq!(groups(&opaque, true, false)[0].dots, [[[9000, 1000], [1000, 5000], [5000, 1000]]]);
    }

    /// Areas of one colour that follow each other share a group, and an outline without an area is left out.
    #[test]
    fn areas_keep_their_order() {
        let triangle = |x: f64| vec![DVec2::new(x, 0.0), DVec2::new(x + 1.0, 0.0), DVec2::new(x, 1.0)];
        let area = |x: f64, opacity: f64, red: Option<f64>| Area {
            outlines: vec![triangle(x), vec![DVec2::ZERO, DVec2::ONE]],
            opacity,
            color: red.map(|red| [red, 0.0, 0.0]),
        };
        let mut layer = layer(&[]);
        layer.areas = vec![area(1.0, 0.5, None), area(2.0, 0.5, None), area(3.0, 0.5, Some(1.0)), area(4.0, 0.5, None)];
        let found = area_groups(&layer, false);
        let shape: Vec<_> = found.iter().map(|g| (g.width, g.opacity, g.color, g.lines.len())).collect();
        let red = Some([1.0, 0.0, 0.0]);
        assert_eq!(shape, [(None, 0.25, None, 2), (None, 0.25, red, 1), (None, 0.25, None, 1)]);
        assert_eq!(found[1].lines[0].paths.len(), 1);
        let (start, steps) = found[1].lines[0].paths[0].steps().unwrap();
        assert_eq!(start, [3000, 0]);
        assert_eq!(steps.collect::<Vec<_>>(), [PathSegment::Line([4000, 0]), PathSegment::Line([3000, 1000])]);
    }

    /// The letter l is a rectangle from 176 to 342 and from 0 to 1556 units. The path's end draws its last side.
    #[test]
    fn letters_are_paths() {
        let mut layer = layer(&[]);
        let text = |characters: &str, opacity: f64| Text {
            characters: characters.into(),
            at: DVec2::new(0.0, 2.0),
            size: 2.048,
            opacity,
        };
        layer.texts = vec![text("l", 1.0), text("ol", 1.0), text("o", 0.5)];
        let found = letter_groups(&layer);
        let shape: Vec<_> = found.iter().map(|g| (g.width, g.opacity, g.lines.len())).collect();
        assert_eq!(shape, [(None, 0.5, 2), (None, 0.25, 1)]);
        let (start, steps) = found[0].lines[0].paths[0].steps().unwrap();
        let mut corners: Vec<PagePoint> = steps.map(|step| step.end()).chain([start]).collect();
        corners.sort_unstable();
        assert_eq!(corners, [[176, 444], [176, 2000], [342, 444], [342, 2000]]);
        assert_eq!(found[0].lines[1].paths.len(), 3);
        let curves = |path: &Subpath| path.steps().unwrap().1.all(|step| matches!(step, PathSegment::Curve(_)));
        assert!(found[1].lines[0].paths.iter().all(curves));
    }
}
