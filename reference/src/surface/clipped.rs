//! The first place at which a line meets the part of an iso-surface that clip planes leave ([RAY-8]).

use super::RootFinder;
use super::traversal::IndexLine;
use crate::field::{Field, Sampler};
use crate::number::{Real, Vec3};
use drypoint_scene::clip::ClipPlanes;
use drypoint_scene::shot::Outside;
use drypoint_scene::volume::Mask;

/// A place where a line meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SurfaceHit {
    /// The parameter of the line.
    pub(crate) t: f64,
    /// Index of the plane on which the place lies; none for the surface itself.
    pub(crate) cut: Option<usize>,
}

/// Clip planes, and the side of a surface that is outside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clipped<'c> {
    pub(crate) clip: &'c ClipPlanes,
    pub(crate) outside: Outside,
}

impl RootFinder {
    /// The first place in a closed range at which the line meets the clipped surface: the surface, or a plane that cuts
    /// its inside open.
    pub(crate) fn first_left<R: Real>(
        &self,
        field: &Field<'_, R>,
        mask: Option<&Mask>,
        line: IndexLine,
        range: [f64; 2],
        clipped: Clipped<'_>,
    ) -> Option<SurfaceHit> {
        if clipped.clip.is_empty() {
            return self.first(field, mask, line, range).map(|t| SurfaceHit { t, cut: None });
        }
        let kept = clipped.clip.kept(line, range)?;
        let [from, to] = kept.range;
        if kept.entry.is_some() && self.is_inside(field, mask, line, from, clipped.outside) {
            return Some(SurfaceHit { t: from, cut: kept.entry });
        }
        // The search covers the whole range, so that planes behind a root change no bit of it.
        let root = self.first(field, mask, line, [from, range[1]]);
        root.filter(|t| *t <= to).map(|t| SurfaceHit { t, cut: None })
    }

    /// Whether any part of the clipped surface lies on a line in a closed range. The eye is at the end of the line.
    pub(crate) fn is_left<R: Real>(
        &self,
        field: &Field<'_, R>,
        mask: Option<&Mask>,
        line: IndexLine,
        range: [f64; 2],
        clipped: Clipped<'_>,
    ) -> bool {
        let Some(kept) = clipped.clip.kept(line, range) else { return false };
        let is_cut = |t: f64| self.is_inside(field, mask, line, t, clipped.outside);
        self.first(field, mask, line, kept.range).is_some() || kept.exit.is_some() && is_cut(kept.range[1])
    }

    /// Whether a place on a line is inside the surface or on it. Places outside the box, and in cells that touch a
    /// masked voxel, are not.
    fn is_inside<R: Real>(
        &self,
        field: &Field<'_, R>,
        mask: Option<&Mask>,
        [origin, along]: IndexLine,
        t: f64,
        outside: Outside,
    ) -> bool {
        let index = origin + along * t;
        if !self.holds(index) {
            return false;
        }
        let at = field.place(Vec3::from_glam(index));
        if mask.is_some_and(|mask| mask.touches_cell(at.cell)) {
            return false;
        }
        let over = field.value_at(at).to_f64() - self.iso();
        match outside {
            Outside::Low => over >= 0.0,
            Outside::High => over <= 0.0,
        }
    }
}
