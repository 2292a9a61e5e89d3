//! Cusps of outlines ([HATCH-18]): places where an outline passes behind its own surface.
//!
//! Along the line of sight through an outline, f − iso touches 0. The outline is visible where the surface bends away
//! from this line on both sides, that is, where f has an extremum from outside (Koenderink, *What does the occluding
//! contour tell us about solid shape?*, Perception 13, 1984). Behind a cusp the surface lies in front of its own
//! outline. At first the distance is smaller than any at which visibility is tested, so hooks of the hidden part would
//! be drawn.

use super::facing::Facing;
use crate::field::Outside;
use crate::field::Sampler;
use crate::number::Vec3;
use crate::surface::IsoSurface;
use drypoint_scene::parallel;
use drypoint_scene::strokes::{Stroke, StrokeVertex};
use drypoint_scene::view::View;

/// Distance of the two places of a difference along the line of sight from their middle, in voxels.
const APART: f64 = 1.0;

/// Accuracy of a cusp, in voxels.
const CHANGE: f64 = 0.05;

/// Returns the parts of outlines in front of which the surface does not bend towards the eye. `strokes` lie where the
/// surface turns away.
pub fn before_cusps(surface: &IsoSurface<'_, '_>, view: &View, strokes: &[Stroke]) -> Vec<Stroke> {
    let field = surface.field();
    let grid = field.volume().grid();
    let outside = if field.reconstruction().outside == Outside::Low { 1.0 } else { -1.0 };
    let sign = outside * surface.front(view);
    let [lo, hi] = grid.index_box();
    let facing = Facing { view, grid, field };
    let is_seen = |vertex: &StrokeVertex| {
        let towards = if view.perspective { (view.eye - vertex.world).normalize_or_zero() } else { -view.forward };
        let slope = |s: f64| {
            let at = grid.to_index(vertex.world + towards * (s * APART * grid.voxel())).clamp(lo, hi);
            facing.product(at, field.gradient(Vec3::from_glam(at)))
        };
        (slope(1.0) - slope(-1.0)) * sign <= 0.0
    };
    parallel::gather(strokes.len(), 1, &|run, seen| {
        seen.extend(strokes[run].iter().flat_map(|stroke| parts(stroke, grid.voxel(), &is_seen)));
    })
}

/// The parts of a stroke on which a condition holds. It is tested every `step`, and changes are narrowed down to a
/// share of the step.
fn parts(stroke: &Stroke, step: f64, holds: &dyn Fn(&StrokeVertex) -> bool) -> Vec<Stroke> {
    let between = |a: &StrokeVertex, b: &StrokeVertex, t: f64| StrokeVertex {
        world: a.world.lerp(b.world, t),
        normal: a.normal.lerp(b.normal, t).normalize_or(a.normal),
        u: a.u + (b.u - a.u) * t,
    };
    let again = stroke.vertices.first().filter(|_| stroke.closed).map(|first| StrokeVertex { u: 1.0, ..*first });
    let vertices: Vec<StrokeVertex> = stroke.vertices.iter().copied().chain(again).collect();
    let Some(first) = vertices.first() else { return Vec::new() };
    let (mut before, mut is_whole) = (holds(first), true);
    let begins = before;
    let mut parts: Vec<Vec<StrokeVertex>> = if before { vec![vec![*first]] } else { Vec::new() };
    for pair in vertices.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let length = a.world.distance(b.world);
        let steps = (length / step).ceil().max(1.0) as u32;
        let mut last = 0.0;
        for k in 1..=steps {
            let t = f64::from(k) / f64::from(steps);
            let now = holds(&between(&a, &b, t));
            if now != before {
                let (mut lo, mut hi) = (last, t);
                while (hi - lo) * length > CHANGE * step {
                    let middle = 0.5 * (lo + hi);
                    if holds(&between(&a, &b, middle)) == before { lo = middle } else { hi = middle }
                }
                let change = between(&a, &b, 0.5 * (lo + hi));
                match parts.last_mut().filter(|_| before) {
                    Some(part) => part.push(change),
                    None => parts.push(vec![change]),
                }
                is_whole = false;
            }
            (before, last) = (now, t);
        }
        if let Some(part) = parts.last_mut().filter(|_| before) {
            part.push(b);
        }
    }
    if is_whole {
        return if begins { vec![stroke.clone()] } else { Vec::new() };
    }
    if stroke.closed && begins && before && parts.len() > 1 {
        // The last part of a ring continues in the first.
        let mut last = parts.pop().unwrap_or_default();
        last.pop();
        last.append(&mut parts[0]);
        parts[0] = last;
    }
    parts.retain(|part| part.len() > 1);
    parts.into_iter().map(|vertices| Stroke { vertices, closed: false, key: stroke.key }).collect()
}

#[cfg(test)]
mod tests {
    use super::super::outlines;
    use super::*;
    use crate::field::{Field, Reconstruction, Rung};
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::phantom::{by_name, sample};
    use drypoint_scene::space::Grid;
    use drypoint_scene::tables::{Camera, Projection};
    use drypoint_scene::volume::VoxelType;

    /// A torus seen from beside. The curvature along the view of its formula, −vᵀHv/‖g‖, is not negative on any part, and
    /// 0 where a part ends. A ball has no cusp and stays whole.
    #[test]
    fn outlines_end_where_the_curvature_along_the_view_changes_its_sign() {
        let grid = Grid::with_spacing([49, 49, 33], [1.0; 3]).unwrap();
        let camera = Camera {
            projection: Projection::Orthographic { height: None },
            direction: DVec3::new(1.0, 0.1, -0.4),
            ..Camera::default()
        };
        let view = View::new(&camera, &grid, [64, 64]).unwrap();
        let parts = |name: &str, params: &[(String, f64)]| {
            let phantom = by_name(name, &grid, params).unwrap();
            let volume = sample(phantom.as_ref(), grid.clone(), VoxelType::F64).unwrap();
            let field = Field::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
            let surface = IsoSurface::new(&field, 0.0);
            let whole = outlines(&surface, &view).strokes;
            (phantom, before_cusps(&surface, &view, &whole), whole)
        };
        let (_, ball, whole) = parts("sphere", &[("R".into(), 12.0)]);
        assert_eq!(ball, whole);
        let (torus, cut, whole) = parts("torus", &[("R".into(), 14.0), ("r".into(), 6.0)]);
        let length = |strokes: &[Stroke]| strokes.iter().map(Stroke::length).sum::<f64>();
        assert!(length(&cut) < 0.95 * length(&whole) && length(&cut) > 0.5 * length(&whole));
        let along = |at: DVec3| {
            let jet = torus.jet(at);
            -view.forward.dot(jet.hessian * view.forward) / jet.gradient.length()
        };
        // Differences over a voxel either way are off by a sixth of the third derivative of κ along the view, some
        // hundredths of a voxel.
        let off = 0.03;
        let mut ends = 0;
        for stroke in &cut {
            assert!(stroke.vertices.iter().all(|vertex| along(vertex.world) >= -off));
            if !stroke.closed {
                for vertex in [stroke.vertices[0], stroke.vertices[stroke.vertices.len() - 1]] {
                    assert!(along(vertex.world).abs() <= off, "{}", along(vertex.world));
                    ends += 1;
                }
            }
        }
        assert_eq!(ends, 4);
    }
}
