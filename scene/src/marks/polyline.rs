//! Lines.

use super::round::{OPACITY, nearest};
use crate::color::{Rgb, linear_to_srgb, srgb_to_linear};
use glam::{DVec2, DVec3};

/// A line drawn with a round pen through its vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// In order, at least two; of one, nothing is drawn.
    pub vertices: Vec<Vertex>,
    /// Whether it goes on from the last to the first.
    pub closed: bool,
}

/// A vertex of a line: a dot's numbers, and how far along it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// On the page, in mm, y down.
    pub at: DVec2,
    /// The point in the world that it stands for.
    pub world: DVec3,
    /// Half the line's width there, in mm on the page.
    pub radius: f64,
    /// In (0, 1]; it multiplies that of the pen's colour.
    pub opacity: f64,
    /// Along the whole line from 0 to 1; a part that was cut out keeps its numbers.
    pub t: f64,
    /// In place of the pen's; none: the pen's.
    pub color: Option<Rgb>,
}

impl Vertex {
    /// What a straight line to another vertex has so far along, s from 0 to 1; at its ends the vertices themselves.
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

/// The codes of a channel that pieces have: steps of 1/31 of sRGB, so that a piece is off by 4 of 255 at the most.
const TINTS: f64 = 31.0;

/// What a colour is between two, so far along.
pub fn color_between(a: Option<Rgb>, b: Option<Rgb>, s: f64) -> Option<Rgb> {
    a.zip(b).map(|(a, b)| std::array::from_fn(|i| a[i] + (b[i] - a[i]) * s)).or(a).or(b)
}

/// The mean of two colours in what is seen of them, on a piece's steps.
fn tint(a: Option<Rgb>, b: Option<Rgb>) -> Option<Rgb> {
    let [a, b] = [a.or(b)?, b.or(a)?].map(|color| color.map(linear_to_srgb));
    Some(std::array::from_fn(|i| srgb_to_linear(nearest((a[i] + b[i]) / 2.0, TINTS).clamp(0.0, 1.0))))
}

/// A part of a line with one width, one opacity and one colour: what every writer draws, with round ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// In order, at least two, in mm on the page.
    pub points: Vec<DVec2>,
    /// Half the width, in mm.
    pub radius: f64,
    /// In (0, 1].
    pub opacity: f64,
    /// In place of the pen's; none: the pen's.
    pub color: Option<Rgb>,
    /// Whether it goes on from the last point to the first.
    pub closed: bool,
}

impl Polyline {
    /// Its length on the page, in mm.
    pub fn length(&self) -> f64 {
        let along = self.vertices.windows(2).map(|pair| pair[0].at.distance(pair[1].at)).sum::<f64>();
        match self.vertices.as_slice() {
            [first, .., last] if self.closed => along + last.at.distance(first.at),
            _ => along,
        }
    }

    /// The line cut where its width, its opacity or its colour changes: a segment has the mean of its ends', on the steps of
    /// [`Marks::round`](super::Marks::round), where a radius may lie halfway between two, its colour on
    /// steps of 1/31 of sRGB; equal neighbours join. A
    /// segment without opacity or width is left out.
    pub fn pieces(&self) -> Vec<Piece> {
        let n = self.vertices.len();
        let segments = match n {
            0 | 1 => 0,
            2 => 1,
            _ if self.closed => n,
            _ => n - 1,
        };
        let mut pieces: Vec<Piece> = Vec::new();
        // Whether the last piece ends where the next segment begins.
        let mut joins = false;
        for i in 0..segments {
            let (a, b) = (&self.vertices[i], &self.vertices[(i + 1) % n]);
            let (radius, opacity) = ((a.radius + b.radius) / 2.0, nearest((a.opacity + b.opacity) / 2.0, OPACITY));
            let drawn = radius > 0.0 && opacity > 0.0;
            let color = tint(a.color, b.color);
            match pieces.last_mut() {
                Some(last) if drawn && joins && (last.radius, last.opacity, last.color) == (radius, opacity, color) => {
                    last.points.push(b.at)
                }
                _ if drawn => pieces.push(Piece { points: vec![a.at, b.at], radius, opacity, color, closed: false }),
                _ => {}
            }
            joins = drawn;
        }
        if let [only] = pieces.as_mut_slice()
            && segments == n
            && only.points.len() == n + 1
        {
            // The first point came again at the end.
            only.points.pop();
            only.closed = true;
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
    fn a_change_of_width_or_opacity_cuts() {
        // Means: radius 0.1, 0.15, 0.2; the fourth segment has no opacity, the fifth stands apart from the third.
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
        assert_eq!(pieces.iter().map(xs).collect::<Vec<_>>(), [[0.0, 1.0], [1.0, 2.0], [2.0, 3.0], [4.0, 5.0]]);
        assert!((pieces[1].radius - 0.15).abs() < 1e-15);
        assert_eq!(pieces.iter().map(|p| p.opacity).collect::<Vec<_>>(), [1.0, 1.0, 0.5, 0.5]);
    }

    /// Means of 0.4, 1.8 and 2.1 steps of sRGB; a colour beside none is its own.
    #[test]
    fn a_change_of_colour_cuts() {
        let mut line = line(false, &[0.0, 1.0, 2.0, 3.0, 4.0].map(|x| (x, 0.0, 0.1, 1.0)));
        let grey = |step: f64| Some([srgb_to_linear(step / 31.0); 3]);
        for (vertex, step) in line.vertices.iter_mut().zip([0.0, 0.8, 2.8, 1.4]) {
            vertex.color = grey(step);
        }
        let steps = |p: &Piece| p.color.map(|c| (linear_to_srgb(c[1]) * 31.0).round());
        assert_eq!(
            line.pieces().iter().map(xs).collect::<Vec<_>>(),
            [vec![0.0, 1.0], vec![1.0, 2.0, 3.0], vec![3.0, 4.0]]
        );
        assert_eq!(line.pieces().iter().map(steps).collect::<Vec<_>>(), [Some(0.0), Some(2.0), Some(1.0)]);
        for vertex in &mut line.vertices {
            vertex.color = None;
        }
        assert_eq!(line.pieces().iter().map(steps).collect::<Vec<_>>(), [None]);
        assert_eq!(color_between(Some([0.0, 1.0, 0.5]), Some([1.0, 0.0, 0.5]), 0.25), Some([0.25, 0.75, 0.5]));
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
