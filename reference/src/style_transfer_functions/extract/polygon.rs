//! A closed outline: a polygon that does not cross itself.

use super::ExtractError;
use super::check::number;

/// The largest number of points: far more than anyone draws, and few enough to compare all pairs of lines.
const MOST: usize = 20_000;

/// Corners in pixels of the picture, y down, in the order in which Σ (xᵢ yᵢ₊₁ − xᵢ₊₁ yᵢ) is positive.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Polygon {
    points: Vec<[f64; 2]>,
    /// The outward unit normal at each corner, half-way between those of its two lines, y down.
    normals: Vec<[f64; 2]>,
}

/// An intersection of the outline with a line parallel to an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Intersection {
    /// The coordinate along the line.
    pub(super) at: f64,
    /// The outward unit normal there, y down, interpolated between the normals at the ends of the outline's line.
    pub(super) outward: [f64; 2],
}

impl Polygon {
    /// The polygon through points in either order. The last point is joined to the first.
    ///
    /// # Errors
    /// A number is not finite. There are too many points, or fewer than three different points in a row. Two lines
    /// meet.
    pub(super) fn new(given: &[[f64; 2]]) -> Result<Self, ExtractError> {
        if given.len() > MOST {
            return Err(ExtractError::TooManyPoints { found: given.len(), limit: MOST });
        }
        // Points that differ from their predecessor.
        let mut points: Vec<[f64; 2]> = Vec::with_capacity(given.len());
        // Index of each point among those given, for messages.
        let mut kept = Vec::with_capacity(given.len());
        for (k, &[x, y]) in given.iter().enumerate() {
            let point = [number(format!("x of point {}", k + 1), x)?, number(format!("y of point {}", k + 1), y)?];
            if points.last() != Some(&point) {
                points.push(point);
                kept.push(k);
            }
        }
        while points.len() > 1 && points.last() == points.first() {
            points.pop();
        }
        if points.len() < 3 {
            return Err(ExtractError::TooFewPoints { found: points.len() });
        }
        // Positive orientation, with lines that do not meet.
        let mut polygon = Self { points, normals: Vec::new() };
        if let Some(edges) = polygon.crossing() {
            return Err(ExtractError::Crossing { edges: edges.map(|k| kept[k]) });
        }
        if polygon.doubled_area() < 0.0 {
            polygon.points.reverse();
        }
        // Normals of the lines, then half-way between two of them at each corner.
        let n = polygon.points.len();
        let outward = |k: usize| {
            let [p, q] = polygon.edge(k);
            unit([q[1] - p[1], p[0] - q[0]])
        };
        polygon.normals = (0..n)
            .map(|k| {
                let [m, n] = [outward((k + n - 1) % n), outward(k)];
                unit([m[0] + n[0], m[1] + n[1]])
            })
            .collect();
        Ok(polygon)
    }

    /// The lowest and the highest corner of the box around the polygon.
    pub(super) fn bounds(&self) -> [[f64; 2]; 2] {
        let pick = |choose: fn(f64, f64) -> f64| {
            self.points.iter().fold(self.points[0], |best, p| [choose(best[0], p[0]), choose(best[1], p[1])])
        };
        [pick(f64::min), pick(f64::max)]
    }

    /// The intersections of the outline with the line along `axis` at the coordinate `across`, in ascending order.
    /// Their number is even.
    pub(super) fn meetings(&self, axis: usize, across: f64) -> Vec<Intersection> {
        let other = 1 - axis;
        let mut found: Vec<Intersection> = (0..self.points.len())
            .map(|k| (k, self.edge(k)))
            // An end on the line belongs to the side below. So a corner counts once if the outline passes through.
            .filter(|(_, [p, q])| (p[other] <= across) != (q[other] <= across))
            .map(|(k, [p, q])| {
                let share = (across - p[other]) / (q[other] - p[other]);
                let [m, n] = [self.normals[k], self.normals[(k + 1) % self.normals.len()]];
                let outward = unit([0, 1].map(|c| m[c] + share * (n[c] - m[c])));
                Intersection { at: p[axis] + share * (q[axis] - p[axis]), outward }
            })
            .collect();
        found.sort_by(|a, b| a.at.total_cmp(&b.at));
        found
    }

    /// The distance of a place from the outline, in pixels.
    pub(super) fn distance(&self, [x, y]: [f64; 2]) -> f64 {
        let square = |k: usize| {
            let [p, q] = self.edge(k);
            let [dx, dy] = [q[0] - p[0], q[1] - p[1]];
            let share = (((x - p[0]) * dx + (y - p[1]) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
            let [ex, ey] = [x - p[0] - share * dx, y - p[1] - share * dy];
            ex * ex + ey * ey
        };
        (0..self.points.len()).map(square).fold(f64::INFINITY, f64::min).sqrt()
    }

    /// The line from point k to the next.
    fn edge(&self, k: usize) -> [[f64; 2]; 2] {
        [self.points[k], self.points[(k + 1) % self.points.len()]]
    }

    fn doubled_area(&self) -> f64 {
        (0..self.points.len()).map(|k| self.edge(k)).map(|[p, q]| p[0] * q[1] - q[0] * p[1]).sum()
    }

    /// Two lines that meet in more than the common point of neighbours.
    fn crossing(&self) -> Option<[usize; 2]> {
        let n = self.points.len();
        let least = |k: usize| self.edge(k)[0][0].min(self.edge(k)[1][0]);
        let most = |k: usize| self.edge(k)[0][0].max(self.edge(k)[1][0]);
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&i, &j| least(i).total_cmp(&least(j)).then(i.cmp(&j)));
        for (rank, &i) in order.iter().enumerate() {
            for &j in order[rank + 1..].iter().take_while(|&&j| least(j) <= most(i)) {
                let [first, second] = [i.min(j), i.max(j)];
                let meet = if second == first + 1 {
                    turns_back(self.points[first], self.points[second], self.edge(second)[1])
                } else if first == 0 && second == n - 1 {
                    turns_back(self.points[second], self.points[first], self.edge(first)[1])
                } else {
                    lines_meet(self.edge(first), self.edge(second))
                };
                if meet {
                    return Some([first, second]);
                }
            }
        }
        None
    }
}

fn unit([x, y]: [f64; 2]) -> [f64; 2] {
    let length = (x * x + y * y).sqrt();
    [x / length, y / length]
}

/// The side of the line from p to q on which the point r lies, as the sign of a cross product.
fn side([p, q]: [[f64; 2]; 2], r: [f64; 2]) -> f64 {
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
}

/// Whether the segment from q to r runs back over the segment from p to q.
fn turns_back(p: [f64; 2], q: [f64; 2], r: [f64; 2]) -> bool {
    side([p, q], r) == 0.0 && (q[0] - p[0]) * (r[0] - q[0]) + (q[1] - p[1]) * (r[1] - q[1]) < 0.0
}

/// Whether two closed segments have a point in common.
fn lines_meet(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> bool {
    let sides = [side(a, b[0]), side(a, b[1]), side(b, a[0]), side(b, a[1])];
    if opposite(sides[0], sides[1]) && opposite(sides[2], sides[3]) {
        return true;
    }
    let on = |line: [[f64; 2]; 2], r: [f64; 2]| {
        (0..2).all(|c| line[0][c].min(line[1][c]) <= r[c] && r[c] <= line[0][c].max(line[1][c]))
    };
    (sides[0] == 0.0 && on(a, b[0]))
        || (sides[1] == 0.0 && on(a, b[1]))
        || (sides[2] == 0.0 && on(b, a[0]))
        || (sides[3] == 0.0 && on(b, a[1]))
}

fn opposite(a: f64, b: f64) -> bool {
    (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 2]; 4] = [[1.0, 1.0], [4.0, 1.0], [4.0, 3.0], [1.0, 3.0]];

    #[test]
    fn normals_point_outwards_in_either_order() {
        for points in [SQUARE.to_vec(), SQUARE.iter().rev().copied().collect()] {
            let polygon = Polygon::new(&points).unwrap();
            // In the middle of a side the normal is the side's; at a corner it is half-way between two.
            assert_eq!(
                polygon.meetings(0, 2.0),
                [Intersection { at: 1.0, outward: [-1.0, 0.0] }, Intersection { at: 4.0, outward: [1.0, 0.0] }]
            );
            assert_eq!(
                polygon.meetings(1, 2.5),
                [Intersection { at: 1.0, outward: [0.0, -1.0] }, Intersection { at: 3.0, outward: [0.0, 1.0] }]
            );
            for (meeting, x) in polygon.meetings(0, 1.0).iter().zip([-0.5f64.sqrt(), 0.5f64.sqrt()]) {
                assert!((meeting.outward[0] - x).abs() < 1e-15 && (meeting.outward[1] + 0.5f64.sqrt()).abs() < 1e-15);
            }
            assert_eq!(
                [[2.5, 2.0], [0.0, 2.0], [5.0, 0.0], [3.0, 1.25]].map(|p| polygon.distance(p)),
                [1.0, 1.0, 2f64.sqrt(), 0.25]
            );
            assert_eq!(polygon.meetings(1, 4.5), []);
            assert_eq!(polygon.bounds(), [[1.0, 1.0], [4.0, 3.0]]);
        }
    }

    #[test]
    fn lines_through_corners_meet_an_even_number_of_times() {
        let star = [[0.0, 0.0], [2.0, 1.0], [4.0, 0.0], [3.0, 2.0], [4.0, 4.0], [2.0, 3.0], [0.0, 4.0], [1.0, 2.0]];
        let polygon = Polygon::new(&star).unwrap();
        for axis in [0, 1] {
            for k in -4..40 {
                assert_eq!(polygon.meetings(axis, f64::from(k) / 8.0).len() % 2, 0);
            }
        }
        assert_eq!(polygon.meetings(0, 0.5).len(), 4);
    }

    #[test]
    fn repeated_points_count_once() {
        let [a, b, c, d] = SQUARE;
        assert_eq!(Polygon::new(&[a, a, b, c, c, c, d, a]).unwrap(), Polygon::new(&SQUARE).unwrap());
        for (points, found) in [(vec![], 0), (vec![a, a, a], 1), (vec![a, b, b, a], 2)] {
            assert_eq!(Polygon::new(&points), Err(ExtractError::TooFewPoints { found }));
        }
    }

    #[test]
    fn outlines_that_meet_themselves_are_refused() {
        let crossing = |points: &[[f64; 2]]| match Polygon::new(points) {
            Err(ExtractError::Crossing { edges }) => edges,
            other => panic!("{other:?}"),
        };
        // A bow tie; a touch at a corner; a way back; three points on a line.
        assert_eq!(crossing(&[[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]]), [0, 2]);
        assert_eq!(crossing(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]]), [0, 3]);
        assert_eq!(crossing(&[[0.0, 0.0], [4.0, 0.0], [2.0, 0.0], [2.0, 3.0]]), [0, 1]);
        assert_eq!(crossing(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]), [0, 2]);
        // Points are counted as they were given.
        assert_eq!(crossing(&[[0.0, 0.0], [0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]]), [0, 3]);
    }

    #[test]
    fn points_that_are_no_numbers_are_named() {
        let fault = Polygon::new(&[[0.0, 0.0], [1.0, f64::NAN], [2.0, 2.0]]).unwrap_err();
        assert!(fault.to_string().starts_with("y of point 2 is NaN"), "{fault}");
        assert!(matches!(Polygon::new(&vec![[0.0; 2]; MOST + 1]), Err(ExtractError::TooManyPoints { .. })));
    }
}
