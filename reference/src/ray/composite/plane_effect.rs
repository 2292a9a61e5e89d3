//! Effects that read what lies on the planes before: what they see of samples, rays and planes.

use crate::number::Real;
use crate::ray::sample::{Sample, SampleAttributes};

/// An effect over the planes of a picture. Numbers are f64, whatever the samples compute in.
///
/// Planes come in groups: group g has the planes k with ⌊k/M⌋ = g. Within a group rays go on independently, on any thread. At
/// the end of a group all rays meet, so an effect reads what its neighbours left on the groups before.
pub trait PlaneEffect: Sync {
    /// The number of numbers that the effect keeps for each ray.
    fn numbers(&self) -> usize;

    /// M, the planes of a group.
    fn planes_per_group(&self) -> i64 {
        1
    }

    /// The linear straight colour that a visible sample is composited in.
    fn before(&self, sample: &SampleOnPlane<'_>, rgb: [f64; 3]) -> [f64; 3];

    /// Reads a sample after it was composited; `own` are the ray's numbers. A sample that a line splits is read once a
    /// share.
    fn after(&self, sample: &SampleOnPlane<'_>, own: &mut [f64]);

    /// Whether the effect lays something behind planes of a group.
    fn lays_behind(&self, group: i64) -> bool;

    /// Lays something behind a plane of an open ray, with or without a sample there.
    fn behind(&self, k: i64, ray: RayOnPlane<'_>);

    /// Ends a group. Rays that had a sample in the group are seen once, others at most once. Returns whether the next group is
    /// due even if no ray has a sample there.
    fn end_of_group(&mut self, group: i64, rays: &mut dyn Iterator<Item = RayOnPlane<'_>>) -> bool;
}

/// A visible sample.
pub struct SampleOnPlane<'a> {
    /// Its ray: column and row among the rays of the picture.
    pub ray: [usize; 2],
    /// Its plane.
    pub k: i64,
    /// The value.
    pub value: f64,
    /// Opacity per reference length; 0 before it was composited.
    pub alpha: f64,
    /// Its attributes.
    pub attributes: &'a SampleAttributes<f64>,
}

/// A ray at the end of a plane or of a group.
pub struct RayOnPlane<'a> {
    /// Column and row among the rays of the picture.
    pub ray: [usize; 2],
    /// Whether something behind would be seen.
    pub is_open: bool,
    /// The ray's numbers.
    pub own: &'a mut [f64],
    /// The ray, to lay something behind its front.
    pub front: &'a mut dyn LayBehind,
}

/// A ray behind whose front something can be laid.
pub trait LayBehind {
    /// Lays a linear straight colour of an opacity behind what is there.
    fn over(&mut self, rgb: [f64; 3], alpha: f64);
}

/// An effect at the samples of one ray.
pub(crate) struct Hook<'a> {
    pub(crate) effect: &'a dyn PlaneEffect,
    pub(crate) ray: [usize; 2],
    pub(crate) own: &'a mut [f64],
}

impl Hook<'_> {
    /// The colour that a sample is composited in.
    pub(super) fn before<R: Real>(&self, sample: Sample<R>, rgb: [R; 3], attributes: &SampleAttributes<R>) -> [R; 3] {
        let (attributes, rgb) = (attributes.to_f64(), rgb.map(Real::to_f64));
        self.effect.before(&self.on_plane(sample, 0.0, &attributes), rgb).map(R::from_f64)
    }

    /// Hands over a sample that was composited.
    pub(super) fn after<R: Real>(&mut self, sample: Sample<R>, alpha: R, attributes: &SampleAttributes<R>) {
        let attributes = attributes.to_f64();
        let sample = self.on_plane(sample, alpha.to_f64(), &attributes);
        self.effect.after(&sample, self.own);
    }

    fn on_plane<'a, R: Real>(
        &self,
        Sample { k, s, .. }: Sample<R>,
        alpha: f64,
        attributes: &'a SampleAttributes<f64>,
    ) -> SampleOnPlane<'a> {
        SampleOnPlane { ray: self.ray, k, value: s.to_f64(), alpha, attributes }
    }
}
