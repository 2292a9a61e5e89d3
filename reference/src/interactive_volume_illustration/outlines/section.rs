//! Outlines at clip planes ([HATCH-18], [RAY-8]). Outlines end at a plane, and the section of the iso-surface with the
//! plane is an outline too.

use super::search::{CurveSearch, OutlineStrokes, measure, position};
use super::second_function::SecondFunction;
use super::tetrahedra::any_sign_change;
use crate::field::Field;
use drypoint_scene::clip::{ClipPlane, ClipPlanes, ClippedParts};
use drypoint_scene::glam::DVec3;
use drypoint_scene::strokes::{Stroke, StrokeVertex};

impl CurveSearch<'_> {
    /// Cuts outlines by planes, and adds the curves in which the planes cut the surface.
    pub(super) fn clipped(
        &self,
        field: &Field<'_, f64>,
        bricks: &[[usize; 3]],
        clip: &ClipPlanes,
        mut whole: OutlineStrokes,
    ) -> OutlineStrokes {
        if clip.is_empty() || self.grid.dims().contains(&1) {
            return whole;
        }
        let on_box = whole.strokes.split_off(whole.inside);
        let strokes: Vec<Stroke> = cut_all(whole.strokes, clip);
        let mut left = OutlineStrokes { inside: strokes.len(), strokes, ..whole };
        left.strokes.extend(cut_all(on_box, clip));
        for (i, plane) in clip.0.iter().enumerate() {
            let found = self.curves(field, &PlaneSection(plane), bricks);
            // A section lies on its own plane, so the other planes alone cut it.
            let others = clip.0.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, plane)| plane.clone());
            let others = ClipPlanes(others.collect());
            let on_plane = found.strokes.into_iter().map(|stroke| on_plane(stroke, plane)).collect();
            left.strokes.extend(cut_all(on_plane, &others));
            left.places += found.places;
            left.lost += found.lost;
        }
        left
    }
}

/// The second function of a section: the distance beyond a plane.
struct PlaneSection<'a>(&'a ClipPlane);

impl SecondFunction for PlaneSection<'_> {
    type Corner = f64;

    fn at_voxel(&self, voxel: [usize; 3]) -> f64 {
        self.0.beyond(position(voxel))
    }

    fn may_vanish(&self, corners: &[f64; 8]) -> bool {
        any_sign_change(corners)
    }

    fn values(&self, corners: [f64; 4]) -> Option<[f64; 4]> {
        Some(corners)
    }

    fn near(&self, _start: DVec3) -> Option<impl Fn(DVec3) -> f64> {
        Some(|at: DVec3| self.0.beyond(at))
    }

    fn holds(&self, _at: DVec3) -> bool {
        true
    }
}

/// The parts of strokes that planes do not cut away.
pub(super) fn cut_all(strokes: Vec<Stroke>, clip: &ClipPlanes) -> Vec<Stroke> {
    strokes.into_iter().flat_map(|stroke| cut(stroke, clip)).collect()
}

/// Projects a section onto its plane, exactly up to rounding. Its normals become the direction in which its visibility
/// is tested: halfway between the outward directions of surface and plane, where neither hides it.
fn on_plane(mut stroke: Stroke, plane: &ClipPlane) -> Stroke {
    for StrokeVertex { world, normal, .. } in &mut stroke.vertices {
        *world -= plane.normal * plane.beyond_in_world(*world);
        let along = (*normal - plane.normal * normal.dot(plane.normal)).normalize_or_zero();
        *normal = (along + plane.normal).normalize();
    }
    stroke
}

/// The parts of a stroke that planes do not cut away.
fn cut(stroke: Stroke, clip: &ClipPlanes) -> Vec<Stroke> {
    let Stroke { mut vertices, closed, key } = stroke;
    if closed {
        vertices.extend(vertices.first().copied());
    }
    let between = |a: &StrokeVertex, b: &StrokeVertex, t: f64| StrokeVertex {
        world: a.world.lerp(b.world, t),
        normal: a.normal.lerp(b.normal, t).normalize_or_zero(),
        u: 0.0,
    };
    match clip.cut_line(vertices, closed, |vertex| vertex.world, between) {
        ClippedParts::Whole(mut vertices) => {
            vertices.truncate(vertices.len() - usize::from(closed));
            vec![Stroke { vertices, closed, key }]
        }
        ClippedParts::Parts(parts) => {
            let part = |vertices| {
                let mut part = Stroke { vertices, closed: false, key };
                measure(&mut part);
                part
            };
            parts.into_iter().map(part).collect()
        }
    }
}
