//! Curves on an iso-surface on which a second function q is 0: outlines ([HATCH-18]) and creases ([HATCH-22]).
//!
//! Both functions are taken as linear in the tetrahedra of each cell, which gives curves without branches. Their
//! places are then moved onto the curve of the reconstruction itself.
//!
//! A grid with an axis of one voxel has no cells and no curves.

use super::box_intersection::rim;
use super::chain::{Chain, chains};
use super::curve_refinement::CurveRefinement;
use super::facing::Facing;
use super::iso_difference::IsoDifference;
use super::second_function::SecondFunction;
use super::simplification::kept;
use super::tetrahedra::{FACES, TETRAHEDRA, ValuePair, crossed, is_above, weights};
use crate::field::normal::outward;
use crate::field::{Field, Sampler};
use crate::number::Vec3;
use crate::surface::IsoSurface;
use drypoint_scene::glam::DVec3;
use drypoint_scene::parallel;
use drypoint_scene::shot::Outside;
use drypoint_scene::space::Grid;
use drypoint_scene::strokes::{Stroke, StrokeVertex};
use drypoint_scene::view::View;
use drypoint_scene::volume::{BRICK, Mask};

/// Largest distance of a stroke's segments from the curve, in voxels: half of an outline's tolerance.
const CHORD: f64 = 0.005;

/// Number of halvings of a segment that is farther from the curve.
const HALVINGS: u32 = 4;

/// The largest distance of neighbours on a curve, in voxels. A segment lies in a tetrahedron, of length √3 at most,
/// before its ends are moved.
const LONGEST: f64 = 2.0;

/// Length below which a segment that turns back is an artefact of rounding, in voxels: the order of such places is
/// uncertain.
const BACK: f64 = 0.3;

/// Curves on a surface, hidden parts included.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OutlineStrokes {
    /// Strokes in world space. Those where the surface turns away come before those on the box and those on clip planes,
    /// each group in the order of their cells.
    pub strokes: Vec<Stroke>,
    /// Number of strokes that are neither on the box nor on a clip plane.
    pub inside: usize,
    /// Number of places on curves of the linear functions.
    pub places: u64,
    /// Number of places that were lost, because the reconstruction has no root or no normal nearby.
    pub lost: u64,
}

/// Finds the outlines of a surface, whose field is prepared for gradients, for a camera.
pub fn outlines(surface: &IsoSurface<'_, '_>, view: &View) -> OutlineStrokes {
    let search = CurveSearch::new(surface);
    let (field, bricks) = (surface.field(), surface.bricks());
    let found = search.outlines(field, view, &bricks);
    search.clipped(field, &bricks, surface.clip(), found)
}

/// The inputs of a search for curves, except the field and the second function.
pub(super) struct CurveSearch<'a> {
    pub(super) grid: &'a Grid,
    pub(super) mask: Option<&'a Mask>,
    pub(super) level: IsoDifference,
    pub(super) outside: Outside,
    /// Gradient length that is rounding error ([PREC-3]).
    pub(super) no_normal_below: f64,
}

/// A place on a curve in index space, with the key of the face or edge on which it lies.
pub(super) type CurvePoint = (u64, DVec3);

impl<'a> CurveSearch<'a> {
    pub(super) fn new(surface: &IsoSurface<'_, 'a>) -> Self {
        let field = surface.field();
        let volume = field.volume();
        Self {
            grid: volume.grid(),
            mask: volume.mask(),
            level: IsoDifference::new(volume, surface.iso()),
            outside: field.reconstruction().outside,
            no_normal_below: field.no_normal_below(),
        }
    }

    pub(super) fn outlines(&self, field: &Field<'_, f64>, view: &View, bricks: &[[usize; 3]]) -> OutlineStrokes {
        if self.grid.dims().contains(&1) {
            return OutlineStrokes::default();
        }
        let mut found = self.curves(field, &Facing { view, grid: self.grid, field }, bricks);
        let (chains, on_box) = joined(rim(self, field));
        let at = |key: u64| Some(on_box[on_box.partition_point(|place| place.0 < key)].1);
        found.strokes.extend(parallel::gather(chains.len(), 1, &|chain, rims| {
            rims.extend(chains[chain].iter().flat_map(|chain| self.strokes(field, chain, 3, &at, &|_| None)));
        }));
        found
    }

    /// The curves f = iso, q = 0 in some bricks.
    pub(super) fn curves<Q: SecondFunction>(
        &self,
        field: &Field<'_, f64>,
        function: &Q,
        bricks: &[[usize; 3]],
    ) -> OutlineStrokes {
        if self.grid.dims().contains(&1) {
            return OutlineStrokes::default();
        }
        let segments = parallel::gather(bricks.len(), 1, &|run, segments| {
            bricks[run].iter().for_each(|brick| segments.extend(self.in_brick(field, function, *brick)));
        });
        let (chains, found) = joined(segments);
        let onto_curve = |start: DVec3| {
            let over = &|value| self.level.over(value);
            let refine = CurveRefinement { field, over, q: function.near(start)?, bounds: self.grid.index_box() };
            refine.onto_curve(start)
        };
        let holds = |at: &DVec3| self.normal(field, *at).is_some() && function.holds(*at);
        let moved = parallel::gather(found.len(), 16, &|run, moved| {
            moved.extend(found[run].iter().map(|place| onto_curve(place.1).filter(holds)));
        });
        let (places, lost) = (found.len(), moved.iter().filter(|at| at.is_none()).count());
        let at = |key: u64| moved[found.partition_point(|place| place.0 < key)];
        let strokes = parallel::gather(chains.len(), 1, &|chain, turning| {
            turning.extend(chains[chain].iter().flat_map(|chain| self.strokes(field, chain, 6, &at, &onto_curve)));
        });
        OutlineStrokes { inside: strokes.len(), strokes, places: places as u64, lost: lost as u64 }
    }

    fn normal(&self, field: &Field<'_, f64>, at: DVec3) -> Option<DVec3> {
        outward(field.gradient(Vec3::from_glam(at)), self.outside, self.no_normal_below).map(Vec3::to_glam)
    }

    /// The linear index of a voxel.
    pub(super) fn voxel(&self, [x, y, z]: [usize; 3]) -> u64 {
        let [nx, ny, _] = self.grid.dims().map(|n| n as u64);
        (z as u64 * ny + y as u64) * nx + x as u64
    }

    /// Segments of curves in the cells of a brick.
    fn in_brick<Q: SecondFunction>(
        &self,
        field: &Field<'_, f64>,
        function: &Q,
        brick: [usize; 3],
    ) -> Vec<[CurvePoint; 2]> {
        const SIDE: usize = BRICK + 1;
        let first = brick.map(|b| b * BRICK);
        let cells: [usize; 3] = std::array::from_fn(|a| BRICK.min(self.grid.dims()[a] - 1 - first[a]));
        let local = |[x, y, z]: [usize; 3]| (z * SIDE + y) * SIDE + x;
        let at = |cell: [usize; 3], steps: usize| std::array::from_fn(|a| cell[a] + (steps >> a & 1));
        // f − iso at all corners of the brick's cells.
        let mut over = [0.0; SIDE * SIDE * SIDE];
        for_each(cells.map(|n| n + 1), |voxel| {
            let index: [usize; 3] = std::array::from_fn(|a| first[a] + voxel[a]);
            over[local(voxel)] = self.level.over(field.value(Vec3::from_glam(position(index))));
        });
        // q is computed only at corners of cells in which f − iso changes its sign.
        let mut second: Vec<Option<Q::Corner>> = vec![None; SIDE * SIDE * SIDE];
        let mut segments = Vec::new();
        for_each(cells, |cell| {
            let corner = |steps: usize| over[local(at(cell, steps))];
            let above = is_above(corner(0));
            if (1..8).all(|steps| is_above(corner(steps)) == above) {
                return;
            }
            let index: [usize; 3] = std::array::from_fn(|a| first[a] + cell[a]);
            if self.mask.is_some_and(|mask| mask.touches_cell(index)) {
                return;
            }
            let corners: [Q::Corner; 8] = std::array::from_fn(|steps| {
                *second[local(at(cell, steps))].get_or_insert_with(|| function.at_voxel(at(index, steps)))
            });
            if function.may_vanish(&corners) {
                self.in_cell(function, index, &std::array::from_fn(corner), &corners, &mut segments);
            }
        });
        segments
    }

    /// Adds the segments in the tetrahedra of a cell, from the functions at its corners.
    fn in_cell<Q: SecondFunction>(
        &self,
        function: &Q,
        cell: [usize; 3],
        over: &[f64; 8],
        second: &[Q::Corner; 8],
        segments: &mut Vec<[CurvePoint; 2]>,
    ) {
        for tetrahedron in TETRAHEDRA {
            let Some(q) = function.values(tetrahedron.map(|steps| second[steps])) else { continue };
            let pairs: [ValuePair; 4] = std::array::from_fn(|k| [over[tetrahedron[k]], q[k]]);
            let Some(faces) = crossed(pairs) else { continue };
            segments.push(faces.map(|face| {
                let [a, b, c] = FACES[face].map(|k| tetrahedron[k]);
                let w = weights(FACES[face].map(|k| pairs[k]));
                let from: [usize; 3] = std::array::from_fn(|axis| cell[axis] + (a >> axis & 1));
                let at = [a, b, c].map(|steps| position(std::array::from_fn(|axis| cell[axis] + (steps >> axis & 1))));
                // A face's key: its first voxel, and the steps from it to the other two.
                let key = (self.voxel(from) << 6) | ((b - a) << 3 | (c - a)) as u64;
                (key, at[0] * w[0] + at[1] * w[1] + at[2] * w[2])
            }));
        }
    }

    /// Returns the strokes of a chain; several if places on it are lost. A place's key is its voxel's key followed by
    /// `bits` bits. `onto_curve` moves a nearby place onto the curve.
    fn strokes(
        &self,
        field: &Field<'_, f64>,
        chain: &Chain,
        bits: u32,
        at: &(dyn Fn(u64) -> Option<DVec3> + Sync),
        onto_curve: &(dyn Fn(DVec3) -> Option<DVec3> + Sync),
    ) -> Vec<Stroke> {
        let mut places: Vec<DVec3> = chain.places.iter().filter_map(|&key| at(key)).collect();
        without_turns(&mut places);
        let mut parts = split(places, chain.closed);
        parts.retain(|(places, _)| places.len() > 1);
        let key = chain.places.iter().min().map_or(0, |key| key >> bits);
        let stroke = |(places, closed): (Vec<DVec3>, bool)| {
            let within = CHORD * self.grid.voxel();
            let world: Vec<DVec3> = places.iter().map(|&at| self.grid.to_world(at)).collect();
            let is_kept = kept(&world, closed, within);
            let left: Vec<DVec3> = places.iter().zip(&is_kept).filter(|(_, kept)| **kept).map(|(at, _)| *at).collect();
            let vertex = |at: DVec3| {
                let world = self.grid.to_world(at);
                self.normal(field, at).map(|normal| StrokeVertex { world, normal, u: 0.0 })
            };
            let bent = self.bent(left, closed, onto_curve);
            let mut stroke = Stroke { vertices: bent.into_iter().filter_map(vertex).collect(), closed, key };
            measure(&mut stroke);
            stroke
        };
        let whole = |stroke: &Stroke| stroke.vertices.len() > if stroke.closed { 2 } else { 1 };
        parts.into_iter().map(stroke).filter(whole).collect()
    }
}

impl CurveSearch<'_> {
    /// Adds places to a curve where its segments are too far from `onto_curve`.
    fn bent(
        &self,
        places: Vec<DVec3>,
        closed: bool,
        onto_curve: &(dyn Fn(DVec3) -> Option<DVec3> + Sync),
    ) -> Vec<DVec3> {
        let n = places.len();
        let within = CHORD * self.grid.voxel();
        let mut bent = Vec::with_capacity(n);
        for (i, &from) in places.iter().enumerate() {
            bent.push(from);
            if i + 1 == n && !closed {
                break;
            }
            // A stack of the remaining segments' ends; the next one is last.
            let mut rest = vec![(places[(i + 1) % n], 0)];
            let mut at = from;
            while let Some(&(to, halvings)) = rest.last() {
                let middle = 0.5 * (at + to);
                let moved = onto_curve(middle).filter(|moved| {
                    let off = (self.grid.axes() * (*moved - middle)).length();
                    // A longer move would lead to a neighbouring part of the curve.
                    off > within && off < 0.5 * (self.grid.axes() * (to - at)).length()
                });
                match moved.filter(|_| halvings < HALVINGS) {
                    Some(moved) => {
                        rest.pop();
                        rest.extend([(to, halvings + 1), (moved, halvings + 1)]);
                    }
                    None => {
                        rest.pop();
                        if !rest.is_empty() {
                            bent.push(to);
                        }
                        at = to;
                    }
                }
            }
        }
        bent
    }
}

/// Calls a function for each index triple below the given sizes, the first index fastest.
fn for_each([nx, ny, nz]: [usize; 3], mut f: impl FnMut([usize; 3])) {
    for z in 0..nz {
        for y in 0..ny {
            for x in 0..nx {
                f([x, y, z]);
            }
        }
    }
}

/// The position of a voxel in index space.
pub(super) fn position(voxel: [usize; 3]) -> DVec3 {
    DVec3::from_array(voxel.map(|i| i as f64))
}

/// Chains of segments, and all places sorted by key.
fn joined(segments: Vec<[CurvePoint; 2]>) -> (Vec<Chain>, Vec<CurvePoint>) {
    let chains = chains(segments.iter().map(|segment| segment.map(|(key, _)| key)).collect());
    let mut places: Vec<CurvePoint> = segments.into_iter().flatten().collect();
    places.sort_unstable_by_key(|(key, _)| *key);
    // Both tetrahedra at a face give the same place.
    places.dedup_by_key(|(key, _)| *key);
    (chains, places)
}

/// Removes places at which the curve turns back by less than [`BACK`].
fn without_turns(places: &mut Vec<DVec3>) {
    let mut left: Vec<DVec3> = Vec::with_capacity(places.len());
    for &c in places.iter() {
        while let [.., a, b] = left[..] {
            let (first, second) = (b - a, c - b);
            if first.dot(second) >= 0.0 || first.length().min(second.length()) >= BACK {
                break;
            }
            left.pop();
        }
        left.push(c);
    }
    *places = left;
}

/// Cuts a curve where neighbours are too far apart. The flag tells whether a part is closed.
fn split(places: Vec<DVec3>, closed: bool) -> Vec<(Vec<DVec3>, bool)> {
    let (first, last) = (places.first().copied(), places.last().copied());
    let mut parts: Vec<Vec<DVec3>> = Vec::new();
    for at in places {
        match parts.last_mut() {
            Some(part) if part.last().is_some_and(|before| before.distance(at) <= LONGEST) => part.push(at),
            _ => parts.push(vec![at]),
        }
    }
    let meets = closed && first.zip(last).is_some_and(|(first, last)| first.distance(last) <= LONGEST);
    match (meets, parts.len()) {
        (true, 1) => parts.pop().into_iter().map(|part| (part, true)).collect(),
        (true, n) if n > 1 => {
            // The last part continues in the first.
            let mut last = parts.pop().unwrap_or_default();
            last.append(&mut parts[0]);
            parts[0] = last;
            parts.into_iter().map(|part| (part, false)).collect()
        }
        _ => parts.into_iter().map(|part| (part, false)).collect(),
    }
}

/// Sets u: the arc length as a share of the whole length.
pub(super) fn measure(stroke: &mut Stroke) {
    let mut along = 0.0;
    let mut before: Option<DVec3> = None;
    for vertex in &mut stroke.vertices {
        along += before.map_or(0.0, |before| before.distance(vertex.world));
        vertex.u = along;
        before = Some(vertex.world);
    }
    let first = stroke.vertices.first().map(|vertex| vertex.world);
    let back = before.zip(first).filter(|_| stroke.closed).map_or(0.0, |(last, first)| last.distance(first));
    let whole = along + back;
    stroke.vertices.iter_mut().for_each(|vertex| vertex.u = if whole > 0.0 { vertex.u / whole } else { 0.0 });
}

#[cfg(test)]
mod tests;
