//! Lines.

use super::outline::outlines;
use super::round::{OPACITY, nearest};
use crate::color::{Rgb, linear_to_srgb, srgb_to_linear};
use glam::{DVec2, DVec3};

/// A line drawn with a round pen through its vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// The vertices in order, at least two. A line of one vertex is not drawn.
    pub vertices: Vec<Vertex>,
    /// Whether the line goes on from the last vertex to the first.
    pub closed: bool,
}

/// A vertex of a line: a dot's numbers, and the share of the line up to the vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// The place on the page, in mm, y down.
    pub at: DVec2,
    /// The point in the world that the vertex stands for.
    pub world: DVec3,
    /// Half the line's width at the vertex, in mm on the page.
    pub radius: f64,
    /// The opacity in (0, 1]. It multiplies the opacity of the pen's colour.
    pub opacity: f64,
    /// The share of the whole line up to the vertex, from 0 to 1. Clipping keeps shares.
    pub t: f64,
    /// A colour in place of the pen's; none: the pen's.
    pub color: Option<Rgb>,
}

impl Vertex {
    /// The vertex on the straight line to `b` at the share s, from 0 to 1. At its ends it equals the vertices
    /// themselves.
    pub fn between(&self, b: &Self, s: f64) -> Self {
        if s == 0.0 {
            return *self;
        }
        if s == 1.0 {
            return *b;
        }
        let mix = |x: f64, y: f64| x + (y - x) * s;
        Self {
            at: self.at.lerp(b.at, s),
            world: self.world.lerp(b.world, s),
            radius: mix(self.radius, b.radius),
            opacity: mix(self.opacity, b.opacity),
            t: mix(self.t, b.t),
            color: color_between(self.color, b.color, s),
        }
    }
}

/// Largest difference between the colour codes of a piece and of the line, in sRGB.
const CODES: f64 = 8.0 / 255.0;

/// Largest difference between the opacity of a piece, before it is rounded to a step, and that of the line.
const FAINTER: f64 = 1.0 / 16.0;

/// The colour at the share s between two colours.
pub fn color_between(a: Option<Rgb>, b: Option<Rgb>, s: f64) -> Option<Rgb> {
    a.zip(b).map(|(a, b)| std::array::from_fn(|i| a[i] + (b[i] - a[i]) * s)).or(a).or(b)
}

/// A part of a line with one opacity and one colour. Every writer draws pieces.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The points in order, at least two, in mm on the page.
    pub points: Vec<DVec2>,
    /// Half the width at each point, in mm; linear between them.
    pub radii: Vec<f64>,
    /// The opacity in (0, 1].
    pub opacity: f64,
    /// A colour in place of the pen's; none: the pen's.
    pub color: Option<Rgb>,
    /// Whether the piece goes on from the last point to the first.
    pub closed: bool,
    /// Whether the line begins with its first point, and ends with its last.
    pub ends: [bool; 2],
}

impl Piece {
    /// Whether the piece begins and ends with half a disc, for ink of the given opacity. Opaque pieces overlap at their
    /// ends, so that no gap shows between them. Translucent pieces of one line are cut straight across, so that no
    /// place is covered twice.
    pub fn round(&self, ink: f64) -> [bool; 2] {
        if self.opacity * ink == 1.0 { [true; 2] } else { self.ends }
    }

    /// Half the width of the piece if the width is constant and the ends are round: a pen draws such a piece in one
    /// stroke.
    pub fn stroke(&self, ink: f64) -> Option<f64> {
        let first = *self.radii.first()?;
        (self.round(ink) == [true; 2] && self.radii.iter().all(|&radius| radius == first)).then_some(first)
    }

    /// Half the largest width of the piece.
    pub fn largest_radius(&self) -> f64 {
        self.radii.iter().copied().fold(0.0, f64::max)
    }

    /// The piece's outlines, to be filled by the nonzero rule. A closed line has an outer and an inner one. All outlines
    /// turn the same way, in either direction of the line.
    pub fn outlines(&self, ink: f64) -> Vec<Vec<DVec2>> {
        outlines(&self.points, &self.radii, self.closed, self.round(ink))
    }
}

/// The range of the numbers that a piece stands for: the opacity and the codes of its colour.
#[derive(Clone, Copy)]
struct Range {
    opacity: [f64; 2],
    codes: Option<[[f64; 2]; 3]>,
}

impl Range {
    fn of(a: &Vertex, b: &Vertex) -> Self {
        let range = |a: f64, b: f64| [a.min(b), a.max(b)];
        let codes = a.color.or(b.color).zip(b.color.or(a.color)).map(|(a, b)| {
            let [a, b] = [a, b].map(|color| color.map(linear_to_srgb));
            std::array::from_fn(|i| range(a[i], b[i]))
        });
        Self { opacity: range(a.opacity, b.opacity), codes }
    }

    /// The range of both, if one number stands for all of it.
    fn with(&self, other: &Self) -> Option<Self> {
        let join = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        let fits = |range: [f64; 2], off: f64| range[1] - range[0] <= 2.0 * off;
        let codes = match (self.codes, other.codes) {
            (Some(a), Some(b)) => Some(std::array::from_fn(|i| join(a[i], b[i]))),
            (None, None) => None,
            _ => return None,
        };
        let opacity = join(self.opacity, other.opacity);
        let fit = fits(opacity, FAINTER) && codes.is_none_or(|codes: [_; 3]| codes.iter().all(|&c| fits(c, CODES)));
        fit.then_some(Self { opacity, codes })
    }

    fn opacity(&self) -> f64 {
        nearest((self.opacity[0] + self.opacity[1]) / 2.0, OPACITY)
    }

    fn color(&self) -> Option<Rgb> {
        self.codes.map(|codes| codes.map(|[lo, hi]| srgb_to_linear(nearest((lo + hi) / 2.0, 255.0).clamp(0.0, 1.0))))
    }
}

impl Polyline {
    /// Length of the piece on the page, in mm.
    pub fn length(&self) -> f64 {
        let along = self.vertices.windows(2).map(|pair| pair[0].at.distance(pair[1].at)).sum::<f64>();
        match self.vertices.as_slice() {
            [first, .., last] if self.closed => along + last.at.distance(first.at),
            _ => along,
        }
    }

    /// Returns the line in as few pieces as its opacity and its colour allow ([HATCH-21]). A piece's sRGB colour is
    /// within 8/255 of the line's. The opacity is within 1/16 of the line's, plus the rounding to steps of sixteenths.
    /// A segment whose two ends differ by more has the mean of both. Segments without opacity or width are left out.
    pub fn pieces(&self) -> Vec<Piece> {
        let n = self.vertices.len();
        let segments = match n {
            0 | 1 => 0,
            2 => 1,
            _ if self.closed => n,
            _ => n - 1,
        };
        let mut pieces: Vec<(Piece, Range)> = Vec::new();
        // Whether the last piece ends where the next segment begins.
        let mut joins = false;
        for i in 0..segments {
            // A segment extends the last piece if both fit into one range of colour and opacity; otherwise it begins a
            // new piece.
            let (a, b) = (&self.vertices[i], &self.vertices[(i + 1) % n]);
            let own = Range::of(a, b);
            let drawn = a.radius.max(b.radius) > 0.0 && own.opacity() > 0.0;
            let both = pieces.last().filter(|_| joins).and_then(|(_, range)| range.with(&own));
            match (drawn, both, pieces.last_mut()) {
                (true, Some(both), Some((piece, range))) => {
                    piece.points.push(b.at);
                    piece.radii.push(b.radius);
                    *range = both;
                }
                (true, ..) => {
                    let (points, radii) = (vec![a.at, b.at], vec![a.radius, b.radius]);
                    // Whether it ends the line follows from the next one.
                    let ends = [!joins, true];
                    pieces.push((Piece { points, radii, opacity: 1.0, color: None, closed: false, ends }, own));
                }
                (false, ..) => {}
            }
            joins = drawn;
        }
        // The colour and opacity of a piece are the middles of its ranges.
        let mut pieces: Vec<Piece> = pieces
            .into_iter()
            .map(|(piece, range)| Piece { opacity: range.opacity(), color: range.color(), ..piece })
            .collect();
        if let [only] = pieces.as_mut_slice()
            && segments == n
            && only.points.len() == n + 1
        {
            // The first point came again at the end.
            only.points.pop();
            only.radii.pop();
            only.closed = true;
            return pieces;
        }
        // A piece ends the line where the next one does not join it.
        for i in 1..pieces.len() {
            pieces[i - 1].ends[1] = pieces[i].ends[0];
        }
        // In a ring the last piece may join the first.
        if let (true, true, [first, .., last]) = (segments == n, joins, pieces.as_mut_slice())
            && first.points[0] == self.vertices[0].at
        {
            (first.ends[0], last.ends[1]) = (false, false);
        }
        pieces
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(closed: bool, vertices: &[(f64, f64, f64, f64)]) -> Polyline {
        let vertex = |&(x, y, radius, opacity): &(f64, f64, f64, f64)| Vertex {
            at: DVec2::new(x, y),
            world: DVec3::ZERO,
            radius,
            opacity,
            t: 0.0,
            color: None,
        };
        Polyline { vertices: vertices.iter().map(vertex).collect(), closed }
    }

    fn xs(piece: &Piece) -> Vec<f64> {
        piece.points.iter().map(|p| p.x).collect()
    }

    #[test]
    fn equal_neighbours_are_one_piece() {
        let open = line(false, &[(0.0, 0.0, 0.1, 1.0), (1.0, 0.0, 0.1, 1.0), (2.0, 0.0, 0.1, 1.0)]).pieces();
        assert_eq!((open.len(), xs(&open[0]), open[0].closed), (1, vec![0.0, 1.0, 2.0], false));
        let ring = line(true, &[(0.0, 0.0, 0.1, 1.0), (1.0, 0.0, 0.1, 1.0), (2.0, 2.0, 0.1, 1.0)]).pieces();
        assert_eq!((ring.len(), xs(&ring[0]), ring[0].closed), (1, vec![0.0, 1.0, 2.0], true));
    }

    #[test]
    fn a_change_of_opacity_cuts_and_one_of_width_does_not() {
        // The third segment goes from 1 to 0; the fourth has no opacity, the fifth stands apart from the third.
        let line = line(
            false,
            &[
                (0.0, 0.0, 0.1, 1.0),
                (1.0, 0.0, 0.1, 1.0),
                (2.0, 0.0, 0.2, 1.0),
                (3.0, 0.0, 0.2, 0.0),
                (4.0, 0.0, 0.2, 0.0),
                (5.0, 0.0, 0.2, 1.0),
            ],
        );
        let pieces = line.pieces();
        assert_eq!(pieces.iter().map(xs).collect::<Vec<_>>(), [vec![0.0, 1.0, 2.0], vec![2.0, 3.0], vec![4.0, 5.0]]);
        assert_eq!(pieces[0].radii, [0.1, 0.1, 0.2]);
        assert_eq!(pieces.iter().map(|p| p.opacity).collect::<Vec<_>>(), [1.0, 0.5, 0.5]);
        assert_eq!(pieces.iter().map(|p| p.ends).collect::<Vec<_>>(), [[true, false], [false, true], [true; 2]]);
        // One width and round ends are a stroke; opaque ink is round where it goes on.
        assert_eq!(pieces.iter().map(|p| p.stroke(1.0)).collect::<Vec<_>>(), [None, None, Some(0.2)]);
        assert_eq!(
            (pieces[0].round(1.0), pieces[0].round(0.5), pieces[1].round(1.0)),
            ([true; 2], [true, false], [false, true])
        );
    }

    /// Codes of 0, 10, 16, 17, 9 of 255: up to 16 from the first on are one piece of 8, what follows spans 8 and is one of 13.
    #[test]
    fn a_change_of_colour_cuts() {
        let mut line = line(false, &[0.0, 1.0, 2.0, 3.0, 4.0].map(|x| (x, 0.0, 0.1, 1.0)));
        let grey = |code: f64| Some([srgb_to_linear(code / 255.0); 3]);
        for (vertex, code) in line.vertices.iter_mut().zip([0.0, 10.0, 15.9, 17.0, 9.0]) {
            vertex.color = grey(code);
        }
        let codes = |p: &Piece| p.color.map(|c| (linear_to_srgb(c[1]) * 255.0).round());
        let pieces = line.pieces();
        assert_eq!(pieces.iter().map(xs).collect::<Vec<_>>(), [[0.0, 1.0, 2.0], [2.0, 3.0, 4.0]]);
        assert_eq!(pieces.iter().map(codes).collect::<Vec<_>>(), [Some(8.0), Some(13.0)]);
        // A colour beside none is its own.
        line.vertices[0].color = None;
        assert_eq!(line.pieces().iter().map(codes).collect::<Vec<_>>(), [Some(13.0)]);
        for vertex in &mut line.vertices {
            vertex.color = None;
        }
        assert_eq!(line.pieces().iter().map(codes).collect::<Vec<_>>(), [None]);
        assert_eq!(color_between(Some([0.0, 1.0, 0.5]), Some([1.0, 0.0, 0.5]), 0.25), Some([0.25, 0.75, 0.5]));
    }

    /// Every place of a line has a piece whose colour is within 8 of 255, if no segment changes by more than 16. Joints
    /// of a ring are no ends.
    #[test]
    fn pieces_are_as_near_as_they_say() {
        let n = 200;
        let code = |i: usize, k: f64| 128.0 + 100.0 * crate::math::sin(std::f64::consts::TAU * k * i as f64 / n as f64);
        let mut ring = line(true, &vec![(0.0, 0.0, 0.1, 1.0); n]);
        for (i, vertex) in ring.vertices.iter_mut().enumerate() {
            vertex.at.x = i as f64;
            vertex.color = Some([1.0, 2.0, 3.0].map(|k| srgb_to_linear(code(i, k) / 255.0)));
        }
        let pieces = ring.pieces();
        assert!(pieces.len() > 20 && pieces.len() < n * 3 / 4, "{}", pieces.len());
        assert!(pieces.iter().all(|piece| piece.ends == [false; 2]));
        for piece in &pieces {
            let own = piece.color.unwrap().map(|c| linear_to_srgb(c) * 255.0);
            for at in &piece.points {
                let i = at.x as usize;
                assert!((0..3).all(|k| (own[k] - code(i, (k + 1) as f64)).abs() < 8.51), "{i}");
            }
        }
    }

    #[test]
    fn lengths_go_round_closed_lines() {
        let corners = [(0.0, 0.0, 1.0, 1.0), (3.0, 0.0, 1.0, 1.0), (3.0, 4.0, 1.0, 1.0)];
        assert_eq!((line(false, &corners).length(), line(true, &corners).length()), (7.0, 12.0));
        assert_eq!((line(true, &corners[..1]).length(), line(true, &[]).length()), (0.0, 0.0));
    }

    #[test]
    fn too_few_vertices_draw_nothing() {
        assert!(line(true, &[]).pieces().is_empty());
        assert!(line(true, &[(0.0, 0.0, 1.0, 1.0)]).pieces().is_empty());
        // There and back is the same line.
        assert_eq!(line(true, &[(0.0, 0.0, 1.0, 1.0), (1.0, 0.0, 1.0, 1.0)]).pieces().len(), 1);
    }
}
