//! A body for an outline, which gives a normal to each place inside ([STF-2]).
//!
//! Inside the outline −Δu = 1 is solved with u = 0 on the outline, and the body is z² = 4u/k. Sýkora et al.
//! (*Ink-and-Ray*, 2014) inflate drawings in this way. The outward normal is along
//!
//! (−∇u, √(ku)),
//!
//! which on the outline lies in the picture's plane along the outline's own normal, and inside varies smoothly. For a
//! circle u = (R² − ρ²)/4, for an ellipse u is a multiple of 1 − x²/a² − y²/b². With the right k they become the sphere
//! and any ellipsoid over the ellipse.
//!
//! k sets the depth, which an outline does not show. Unless it is given, the body is as deep as the largest circle
//! inside the outline. A circle then becomes a sphere, an ellipse a spheroid. The body is closed, so it has every
//! normal at least once.
//!
//! Harmonic interpolation of the outline's normals (Johnston, *Lumo*, 2002) is the other well-known method. It makes a
//! sphere of a circle, but does not make an ellipsoid of another ellipse. In the tests it was farther from the blobs.
//!
//! The equation is solved by differences on a square grid whose arms are cut at the outline (Shortley and Weller 1938),
//! which is exact where u is quadratic. The solver is successive over-relaxation with Young's factor.

use super::polygon::{Intersection, Polygon};
use drypoint_scene::math;

/// Nodes along the longer side of the outline's box. The normal varies slowly; the picture is read at its own pixels.
const NODES: usize = 256;

/// The largest number of sweeps. A disk takes about 3 NODES.
const SWEEPS: usize = 8 * NODES;

/// The share of the largest u below which a change is negligible.
const CONVERGED: f64 = 1e-9;

/// The shortest arm, as a share of the spacing. Its reciprocal must be finite.
const SHORTEST: f64 = 1e-9;

/// A place in the picture (y down) with the components (N_x, N_y) of its unit normal (y up).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corner {
    pub(super) place: [f64; 2],
    pub(super) normal: [f64; 2],
}

/// One of the four arms of a node.
#[derive(Clone, Copy)]
struct Arm {
    length: f64,
    /// The outward normal (y down) where the arm is cut by the outline.
    cut: Option<[f64; 2]>,
}

/// A node inside: its arms to the left, right, top and bottom.
#[derive(Clone, Copy)]
struct GridNode {
    arms: [Arm; 4],
}

/// The body over the grid.
pub(super) struct Body {
    /// Place of node (0, 0).
    corner: [f64; 2],
    spacing: f64,
    size: [usize; 2],
    nodes: Vec<Option<GridNode>>,
    u: Vec<f64>,
    /// k.
    flatness: f64,
}

impl Body {
    /// Inflates an outline to a depth in pixels, the body's extent out of the picture. Without a depth it is the radius
    /// of the largest circle inside the outline.
    pub(super) fn new(outline: &Polygon, depth: Option<f64>) -> Self {
        // A square grid of at most NODES nodes a side, centred on the outline's box.
        let [low, high] = outline.bounds();
        let extent = [high[0] - low[0], high[1] - low[1]];
        let spacing = extent[0].max(extent[1]) / NODES as f64;
        let size = extent.map(|e| ((e / spacing).ceil() as usize).clamp(1, NODES));
        let corner = [0, 1].map(|c| (low[c] + high[c] - spacing * (size[c] - 1) as f64) / 2.0);
        // Intersections of each grid row and column with the outline.
        let lines = [0, 1].map(|axis: usize| {
            let other = 1 - axis;
            let across = move |k: usize| corner[other] + spacing * k as f64;
            (0..size[other]).map(|k| outline.meetings(axis, across(k))).collect::<Vec<_>>()
        });
        // For each node inside, the intersections next to it in all four directions.
        let between = |t: usize| {
            let [i, j] = [t % size[0], t / size[0]];
            let place = [corner[0] + spacing * i as f64, corner[1] + spacing * j as f64];
            Some([neighbours(&lines[0][j], place[0])?, neighbours(&lines[1][i], place[1])?])
        };
        let inside: Vec<_> = (0..size[0] * size[1]).map(between).collect();
        // The arms of each node: to the next node, or cut at the outline.
        let node = |t: usize| {
            let [[left, right], [top, bottom]] = inside[t]?;
            let [i, j] = [t % size[0], t / size[0]];
            let there = [
                i > 0 && inside[t - 1].is_some(),
                i + 1 < size[0] && inside[t + 1].is_some(),
                j > 0 && inside[t - size[0]].is_some(),
                j + 1 < size[1] && inside[t + size[0]].is_some(),
            ];
            let ways = [left, right, top, bottom];
            Some(GridNode { arms: std::array::from_fn(|k| arm(ways[k], spacing, there[k])) })
        };
        let nodes: Vec<Option<GridNode>> = (0..inside.len()).map(node).collect();
        // −Δu = 1, and k so that the largest z = √(4u/k) is the depth.
        let u = solve(size, &nodes);
        let mut body = Self { corner, spacing, size, nodes, u, flatness: 1.0 };
        let largest = body.u.iter().copied().fold(0.0, f64::max);
        let depth = depth.unwrap_or_else(|| body.inscribed(outline));
        body.flatness = 4.0 * largest / (depth * depth);
        body
    }

    /// The triangles of the grid, cut off at the outline. Their corners carry the normals.
    pub(super) fn triangles(&self) -> Vec<[Corner; 3]> {
        let mut triangles = Vec::new();
        for j in 0..self.size[1] + 1 {
            for i in 0..self.size[0] + 1 {
                let corners = self.cell(i, j);
                triangles.extend((2..corners.len()).map(|k| [corners[0], corners[k - 1], corners[k]]));
            }
        }
        triangles
    }

    /// The radius of the largest circle about a node inside the outline.
    fn inscribed(&self, outline: &Polygon) -> f64 {
        let mut best = 0.0;
        for row in 0..self.size[1] {
            // Between neighbouring nodes the distance to the outline grows by at most the spacing, so most nodes need
            // no evaluation.
            let mut most = f64::INFINITY;
            for t in row * self.size[0]..(row + 1) * self.size[0] {
                if self.nodes[t].is_some() && most > best {
                    most = outline.distance(self.place(t));
                    best = most.max(best);
                }
                most += self.spacing;
            }
        }
        best
    }

    /// The inner part of the cell whose lower right node is (i, j), as a polygon.
    fn cell(&self, i: usize, j: usize) -> Vec<Corner> {
        let node = |column: Option<usize>, row: Option<usize>| {
            let at = column.zip(row).filter(|&(i, j)| i < self.size[0] && j < self.size[1])?;
            let t = at.1 * self.size[0] + at.0;
            self.nodes[t].map(|node| (t, node))
        };
        let (left, top) = (i.checked_sub(1), j.checked_sub(1));
        let (right, bottom) = (Some(i), Some(j));
        // Corners in clockwise order, with the arms that lead from each to the next one and back.
        let round = [
            (node(left, top), RIGHT, LEFT),
            (node(right, top), BOTTOM, TOP),
            (node(right, bottom), LEFT, RIGHT),
            (node(left, bottom), TOP, BOTTOM),
        ];
        let mut corners = Vec::with_capacity(6);
        for k in 0..4 {
            let (here, forth, back) = round[k];
            let (next, ..) = round[(k + 1) % 4];
            match (here, next) {
                (Some((t, node)), Some(_)) => corners.push(self.at_node(t, &node)),
                (Some((t, node)), None) => {
                    corners.push(self.at_node(t, &node));
                    corners.push(self.at_cut(t, &node, forth));
                }
                (None, Some((t, node))) => corners.push(self.at_cut(t, &node, back)),
                (None, None) => {}
            }
        }
        corners
    }

    fn place(&self, t: usize) -> [f64; 2] {
        [(t % self.size[0], self.corner[0]), (t / self.size[0], self.corner[1])]
            .map(|(k, from)| from + self.spacing * k as f64)
    }

    fn at_node(&self, t: usize, node: &GridNode) -> Corner {
        let [gx, gy] = self.gradient(t, node);
        // The length is 0 only for a u that has underflowed.
        let length = (gx * gx + gy * gy + self.flatness * self.u[t]).sqrt().max(f64::MIN_POSITIVE);
        Corner { place: self.place(t), normal: [-gx / length, gy / length] }
    }

    fn at_cut(&self, t: usize, node: &GridNode, way: usize) -> Corner {
        let Arm { length, cut } = node.arms[way];
        let [x, y] = self.place(t);
        let [dx, dy] = [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]][way];
        let normal = cut.map_or_else(|| self.at_node(t, node).normal, |[nx, ny]| [nx, -ny]);
        Corner { place: [x + length * dx, y + length * dy], normal }
    }

    /// ∇u by differences of second order with arms of two lengths; exact for quadratics.
    fn gradient(&self, t: usize, node: &GridNode) -> [f64; 2] {
        let here = self.u[t];
        [[LEFT, RIGHT], [TOP, BOTTOM]].map(|ways| {
            let [(l, before), (r, after)] = ways.map(|way| {
                let Arm { length, cut } = node.arms[way];
                (length, if cut.is_some() { 0.0 } else { self.u[next(self.size[0], t, way)] })
            });
            ((after - here) / r * l + (here - before) / l * r) / (l + r)
        })
    }
}

/// Names of the arms.
const LEFT: usize = 0;
const RIGHT: usize = 1;
const TOP: usize = 2;
const BOTTOM: usize = 3;

/// The intersections before and after a coordinate. Returns none if it lies outside the outline.
fn neighbours(line: &[Intersection], x: f64) -> Option<[(f64, [f64; 2]); 2]> {
    let after = line.partition_point(|meeting| meeting.at <= x);
    if after % 2 == 0 {
        return None;
    }
    Some([line[after - 1], *line.get(after)?].map(|meeting| ((meeting.at - x).abs(), meeting.outward)))
}

/// An arm towards an intersection with the outline. Rounding can put the next node outside although the outline is
/// farther away than this node. The outline then counts as lying at the node.
fn arm((distance, outward): (f64, [f64; 2]), spacing: f64, next_is_inside: bool) -> Arm {
    if next_is_inside && distance >= spacing {
        return Arm { length: spacing, cut: None };
    }
    Arm { length: distance.clamp(SHORTEST * spacing, spacing), cut: Some(outward) }
}

/// The node at the end of an arm that is not cut.
fn next(columns: usize, t: usize, way: usize) -> usize {
    match way {
        LEFT => t - 1,
        RIGHT => t + 1,
        TOP => t - columns,
        _ => t + columns,
    }
}

/// The equation of a node, solved for its u: Σ weight · u + source.
struct Equation {
    node: usize,
    /// The four neighbours. The index after the last node stands for the outline, where u = 0.
    at: [usize; 4],
    weight: [f64; 4],
    source: f64,
}

impl Equation {
    fn new(columns: usize, outline: usize, t: usize, node: &GridNode) -> Self {
        let [l, r, o, b] = node.arms.map(|arm| arm.length);
        let whole = 1.0 / (l * r) + 1.0 / (o * b);
        let at = std::array::from_fn(|way| if node.arms[way].cut.is_some() { outline } else { next(columns, t, way) });
        let weight = [1.0 / (l * (l + r)), 1.0 / (r * (l + r)), 1.0 / (o * (o + b)), 1.0 / (b * (o + b))];
        Self { node: t, at, weight: weight.map(|w| w / whole), source: 0.5 / whole }
    }
}

/// −Δu = 1 inside, u = 0 on the outline.
fn solve([columns, rows]: [usize; 2], nodes: &[Option<GridNode>]) -> Vec<f64> {
    let outline = nodes.len();
    let equations: Vec<Equation> =
        (0..outline).filter_map(|t| nodes[t].map(|node| Equation::new(columns, outline, t, &node))).collect();
    let mut u = vec![0.0; outline + 1];
    // Young's factor for a square with this many nodes. The best factor for smaller regions is only slightly lower.
    let factor = 2.0 / (1.0 + math::sin(std::f64::consts::PI / (columns.max(rows) + 1) as f64));
    for _ in 0..SWEEPS {
        let (mut change, mut largest) = (0.0f64, 0.0f64);
        for Equation { node, at, weight, source } in &equations {
            let sum = weight[LEFT] * u[at[LEFT]]
                + weight[RIGHT] * u[at[RIGHT]]
                + weight[TOP] * u[at[TOP]]
                + weight[BOTTOM] * u[at[BOTTOM]];
            let step = factor * (sum + source - u[*node]);
            u[*node] += step;
            change = change.max(step.abs());
            largest = largest.max(u[*node].abs());
        }
        if change <= CONVERGED * largest {
            break;
        }
    }
    // Over-relaxation may make a tiny positive number negative.
    u.iter_mut().for_each(|u| *u = u.max(0.0));
    u.truncate(outline);
    u
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An ellipse about (40, 30) with its first half axis turned by an angle, of n points.
    fn ellipse([a, b]: [f64; 2], angle: f64, n: usize) -> Polygon {
        let (cos, sin) = (angle.cos(), angle.sin());
        let point = |k: usize| {
            let t = std::f64::consts::TAU * k as f64 / n as f64;
            let (u, v) = (a * t.cos(), b * t.sin());
            [40.0 + cos * u - sin * v, 30.0 + sin * u + cos * v]
        };
        Polygon::new(&(0..n).map(point).collect::<Vec<_>>()).unwrap()
    }

    /// The largest difference of the body's normals from those of the ellipsoid of that depth.
    fn error([a, b]: [f64; 2], depth: Option<f64>, angle: f64, n: usize) -> f64 {
        let (cos, sin) = (angle.cos(), angle.sin());
        let c2 = depth.unwrap_or(a.min(b)).powi(2);
        let corners = Body::new(&ellipse([a, b], angle, n), depth).triangles().into_iter().flatten();
        let differ = |corner: Corner| {
            let [dx, dy] = [corner.place[0] - 40.0, corner.place[1] - 30.0];
            let (u, v) = (cos * dx + sin * dy, cos * dy - sin * dx);
            let (gu, gv) = (u / (a * a), v / (b * b));
            let z2 = (1.0 - u * gu - v * gv).max(0.0) / c2;
            let length = (gu * gu + gv * gv + z2).sqrt();
            let expected = [(cos * gu - sin * gv) / length, -(sin * gu + cos * gv) / length];
            (corner.normal[0] - expected[0]).abs().max((corner.normal[1] - expected[1]).abs())
        };
        corners.map(differ).fold(0.0, f64::max)
    }

    /// u is quadratic in an ellipse, so what differs is the polygon from the curve: its edges turn by 2π/n, and their
    /// normals lie up to half as much off the curve's, stretched by a/b at the ends. Of the largest circle's radius the
    /// grid may miss a spacing, 1/128 of the longer half axis.
    #[test]
    fn an_ellipse_becomes_its_ellipsoid() {
        for (axes, depth, angle) in [
            ([20.0, 20.0], None, 0.0),
            ([24.0, 12.0], None, 0.3),
            ([24.0, 12.0], Some(30.0), 0.0),
            ([9.0, 16.0], Some(9.0), 0.7),
        ] {
            let stretch = f64::max(axes[0] / axes[1], axes[1] / axes[0]);
            let n = 1000;
            let missed = if depth.is_none() { stretch / 128.0 } else { 0.0 };
            let bound = 1.2 * stretch * std::f64::consts::PI / n as f64 + missed;
            let found = error(axes, depth, angle, n);
            assert!(found < bound, "{axes:?} {depth:?}: {found} {bound}");
        }
    }

    /// The normal on the outline is the outline's. Inside, N_z > 0, and every normal is a unit vector's.
    #[test]
    fn normals_of_any_outline_are_normals() {
        let kidney: Vec<[f64; 2]> = (0..90)
            .map(|k| f64::from(k) * std::f64::consts::TAU / 90.0)
            .map(|t| [50.0 + 30.0 * t.cos(), 40.0 + 18.0 * t.sin() + 14.0 * t.cos().powi(2)])
            .collect();
        let polygon = Polygon::new(&kidney).unwrap();
        let triangles = Body::new(&polygon, None).triangles();
        for corner in triangles.iter().flatten() {
            let [nx, ny] = corner.normal;
            assert!(nx * nx + ny * ny <= 1.0 + 1e-12, "{corner:?}");
        }
        // The area of the triangles is that of the outline, but for its corners cut off by the grid.
        let area = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
            ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2.0
        };
        let sum: f64 = triangles.iter().map(|[a, b, c]| area(a.place, b.place, c.place)).sum();
        let whole: f64 = (1..89).map(|k| area(kidney[0], kidney[k], kidney[k + 1])).sum();
        assert!((sum / whole - 1.0).abs() < 1e-4, "{sum} {whole}");
    }

    /// Twice as large, or moved, or turned by a quarter: the same body.
    #[test]
    fn bodies_scale_with_their_outlines() {
        let normals = |scale: f64, shift: f64| -> Vec<[f64; 2]> {
            let points: Vec<[f64; 2]> = [[0.0, 0.0], [9.0, 2.0], [7.0, 5.0], [12.0, 9.0], [1.0, 8.0]]
                .map(|p| p.map(|c| scale * c + shift))
                .into();
            Body::new(&Polygon::new(&points).unwrap(), None).triangles().iter().flatten().map(|c| c.normal).collect()
        };
        let (one, other) = (normals(1.0, 0.0), normals(4.0, 64.0));
        assert_eq!(one.len(), other.len());
        for (a, b) in one.iter().zip(&other) {
            assert!((a[0] - b[0]).abs() < 1e-8 && (a[1] - b[1]).abs() < 1e-8, "{a:?} {b:?}");
        }
    }
}
