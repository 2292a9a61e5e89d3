//! The opaque iso-surface of a picture, where rays end ([HATCH-14]).

use super::sample::Lit;
use crate::field::Field;
use crate::number::Real;
use crate::surface::RootFinder;
use drypoint_scene::counts::Counts;
use drypoint_scene::shot::{OpaqueSurface, SampleQuery};
use drypoint_scene::volume::Bricks;

/// An iso-surface prepared for rays.
pub(super) struct PreparedSurface<R> {
    pub(super) roots: RootFinder,
    /// Linear colour.
    pub(super) rgb: [R; 3],
    pub(super) lit: Lit<R>,
    /// The query of a place on the surface.
    pub(super) query: SampleQuery,
    /// The further query of a place with nothing in front of it, for the layers `first.*`.
    pub(super) first: SampleQuery,
    /// Whether the surface is drawn alone, without the volume.
    pub(super) alone: bool,
}

impl<R: Real> PreparedSurface<R> {
    /// Prepares the search for an iso-value in a field.
    pub(super) fn new(
        surface: &OpaqueSurface,
        field: &Field<'_, R>,
        bricks: Option<&Bricks>,
        counts: &mut Counts,
    ) -> Self {
        let roots = RootFinder::new(field, surface.iso, bricks);
        counts.bytes.insert("surface".into(), roots.bytes() as u64);
        Self {
            roots,
            rgb: surface.rgb.map(R::from_f64),
            lit: Lit::new(&surface.lit),
            query: surface.query,
            first: surface.first,
            alone: surface.alone,
        }
    }
}
