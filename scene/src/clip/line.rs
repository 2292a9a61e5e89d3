//! The parts of lines that clip planes keep.

use super::ClipPlanes;
use glam::DVec3;

/// The part of a straight line that planes keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClippedRange {
    /// The range of the line's parameter.
    pub range: [f64; 2],
    /// The index of the plane at which the part begins; none if no plane cuts the line's beginning.
    pub entry: Option<usize>,
    /// The index of the plane at which the part ends; none if no plane cuts the line's end.
    pub exit: Option<usize>,
}

/// The parts of a polyline that planes keep.
#[derive(Clone, Debug, PartialEq)]
pub enum ClippedParts<V> {
    /// The line is not cut.
    Whole(Vec<V>),
    /// Open lines, in their order along the line. A ring begins with the part that holds its first vertex.
    Parts(Vec<Vec<V>>),
}

impl ClipPlanes {
    /// Returns the kept part of origin + t·along in index space, t in a closed range; none if all of it is cut away.
    pub fn kept(&self, [origin, along]: [DVec3; 2], range: [f64; 2]) -> Option<ClippedRange> {
        let mut kept = ClippedRange { range, entry: None, exit: None };
        for (i, plane) in self.0.iter().enumerate() {
            // beyond(t) = a + b·t.
            let (a, b) = (plane.beyond(origin), plane.index_normal.dot(along));
            if b == 0.0 {
                if a > 0.0 {
                    return None;
                }
                continue;
            }
            let t = -a / b;
            if b < 0.0 && t > kept.range[0] {
                (kept.range[0], kept.entry) = (t, Some(i));
            } else if b > 0.0 && t < kept.range[1] {
                (kept.range[1], kept.exit) = (t, Some(i));
            }
        }
        (kept.range[0] <= kept.range[1]).then_some(kept)
    }

    /// Cuts a polyline in world space. A ring repeats its first vertex at the end. `between` makes the vertex at a
    /// share of the way from one vertex to the next.
    pub fn cut_line<V: Clone>(
        &self,
        vertices: Vec<V>,
        is_ring: bool,
        world: impl Fn(&V) -> DVec3,
        between: impl Fn(&V, &V, f64) -> V,
    ) -> ClippedParts<V> {
        if vertices.iter().all(|vertex| !self.cut_in_world(world(vertex))) {
            return ClippedParts::Whole(vertices);
        }
        let mut parts: Vec<Vec<V>> = Vec::new();
        // Whether the last part ends in the vertex where the next segment begins.
        let mut joins = false;
        let mut begins_kept = false;
        for (i, pair) in vertices.windows(2).enumerate() {
            let [a, b] = [&pair[0], &pair[1]];
            let Some([from, to]) = self.segment([world(a), world(b)]) else {
                joins = false;
                continue;
            };
            begins_kept |= i == 0 && from == 0.0;
            let end = if to == 1.0 { b.clone() } else { between(a, b, to) };
            match parts.last_mut() {
                Some(part) if joins && from == 0.0 => part.push(end),
                _ => parts.push(vec![if from == 0.0 { a.clone() } else { between(a, b, from) }, end]),
            }
            joins = to == 1.0;
        }
        if is_ring && begins_kept && joins && parts.len() > 1 {
            // The last part goes on in the first across the seam.
            let mut last = parts.pop().unwrap_or_default();
            last.pop();
            last.append(&mut parts[0]);
            parts[0] = last;
        }
        ClippedParts::Parts(parts)
    }

    /// The kept shares of a segment in world space; none if nothing is kept, or only the point at a cut.
    pub fn segment(&self, ends: [DVec3; 2]) -> Option<[f64; 2]> {
        let mut kept = [0.0f64, 1.0f64];
        for plane in &self.0 {
            let [a, b] = ends.map(|end| plane.beyond_in_world(end));
            match (a > 0.0, b > 0.0) {
                (true, true) => return None,
                (true, false) => kept[0] = kept[0].max(a / (a - b)),
                (false, true) => kept[1] = kept[1].min(a / (a - b)),
                (false, false) => {}
            }
        }
        (kept[0] < kept[1]).then_some(kept)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clip::ClipPlane;
    use crate::space::Grid;

    /// The slab 1 ≤ x ≤ 3, whose planes are 0 and 1.
    fn slab() -> ClipPlanes {
        let grid = Grid::with_spacing([9, 9, 9], [1.0; 3]).unwrap();
        let plane = |x: f64, normal| ClipPlane::in_world(DVec3::new(x, 0.0, 0.0), normal, &grid);
        ClipPlanes(vec![plane(1.0, DVec3::NEG_X), plane(3.0, DVec3::X)])
    }

    fn parts(xs: &[f64], is_ring: bool) -> ClippedParts<f64> {
        let between = |a: &f64, b: &f64, t: f64| a + (b - a) * t;
        slab().cut_line(xs.to_vec(), is_ring, |x| DVec3::new(*x, 5.0, 5.0), between)
    }

    #[test]
    fn a_line_is_kept_between_its_planes() {
        let line = |x: f64, along: f64| [DVec3::new(x, 0.0, 0.0), DVec3::new(along, 1.0, 0.0)];
        let all = [f64::NEG_INFINITY, f64::INFINITY];
        let slab = slab();
        assert_eq!(
            slab.kept(line(0.0, 2.0), all),
            Some(ClippedRange { range: [0.5, 1.5], entry: Some(0), exit: Some(1) })
        );
        assert_eq!(
            slab.kept(line(0.0, -2.0), all),
            Some(ClippedRange { range: [-1.5, -0.5], entry: Some(1), exit: Some(0) })
        );
        assert_eq!(
            slab.kept(line(0.0, 2.0), [1.0, 9.0]),
            Some(ClippedRange { range: [1.0, 1.5], entry: None, exit: Some(1) })
        );
        assert_eq!(slab.kept(line(0.0, 2.0), [1.6, 9.0]), None);
        assert_eq!(slab.kept(line(3.0, 0.0), all), Some(ClippedRange { range: all, entry: None, exit: None }));
        assert_eq!(slab.kept(line(3.1, 0.0), all), None);
        assert_eq!(NONE.kept(line(0.0, 1.0), all), Some(ClippedRange { range: all, entry: None, exit: None }));
    }

    const NONE: ClipPlanes = ClipPlanes(Vec::new());

    #[test]
    fn polylines_are_cut_where_they_cross() {
        use ClippedParts::{Parts, Whole};
        assert_eq!(parts(&[1.0, 2.0, 3.0], false), Whole(vec![1.0, 2.0, 3.0]));
        assert_eq!(parts(&[0.0, 2.0, 4.0, 2.0, 8.0], false), Parts(vec![vec![1.0, 2.0, 3.0], vec![3.0, 2.0, 3.0]]));
        // A segment across both planes, and one that touches a plane with its end.
        assert_eq!(parts(&[0.0, 4.0], false), Parts(vec![vec![1.0, 3.0]]));
        assert_eq!(parts(&[0.0, 1.0, 0.0], false), Parts(vec![]));
        assert_eq!(parts(&[2.0, 3.0, 4.0], false), Parts(vec![vec![2.0, 3.0]]));
        // A ring through both planes, which begins inside.
        assert_eq!(parts(&[2.0, 4.0, 2.5, 0.0, 2.0], true), Parts(vec![vec![1.0, 2.0, 3.0], vec![3.0, 2.5, 1.0]]));
        assert_eq!(parts(&[2.0, 2.5, 2.0], true), Whole(vec![2.0, 2.5, 2.0]));
    }
}
