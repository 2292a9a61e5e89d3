//! The seeds of halos at samples of objects ([VS-2]). s is the maximum over sets of min(μ of the selection set, s of
//! the set's own sample).

use super::object_ray::{ObjectRay, selection_set};
use super::selection_ray::contains;
use crate::number::Real;
use crate::ray::prepared::Prepared;
use crate::ray::prepared_halos::PreparedHalos;
use crate::ray::sample::SampleAttributes;
use drypoint_scene::counts::Counts;

/// Working memory of seeds, with one entry for each halo.
pub(super) struct SeedScratch {
    /// s over all sets.
    pub(super) together: Vec<f64>,
    /// s of one set.
    of_set: Vec<f64>,
    /// h.
    pub(super) h: Vec<f64>,
}

impl SeedScratch {
    /// Working memory for a number of halos.
    pub(super) fn new(halos: usize) -> Self {
        Self { together: vec![0.0; halos], of_set: vec![0.0; halos], h: vec![0.0; halos] }
    }

    /// Adds the seeds of one set, with its membership and a factor, and clears them.
    fn join(&mut self, membership: f64, factor: f64) {
        for (together, s) in self.together.iter_mut().zip(&mut self.of_set) {
            *together = together.max(membership.min(std::mem::take(s) * factor));
        }
    }
}

impl<R: Real> ObjectRay<'_, '_, R> {
    /// All samples that can seed, in order and without overlap.
    pub(super) fn seed_visits(&self) -> Vec<[i64; 2]> {
        self.visits_of(|part| part.seeds.is_some())
    }

    /// The seeds of all sets at sample k, in `scratch.together`.
    #[inline(never)]
    pub(super) fn seed(
        &mut self,
        k: i64,
        (prepared, halos): (&Prepared<'_, R>, &PreparedHalos<'_>),
        scratch: &mut SeedScratch,
        counts: &mut Counts,
    ) {
        let (samples, masked) = (counts.samples, counts.masked);
        scratch.together.fill(0.0);
        let mut here = self.here(k);
        let shares = self.shares(&mut here, counts);
        // The background, faded in front of an object.
        if let Some(seeds) = halos.seeds.as_ref().filter(|_| self.has_background(k, &shares))
            && let Some(sample) = here.sample(&self.behind, counts)
        {
            let SeedScratch { of_set, h, .. } = &mut *scratch;
            self.behind.seed(sample, (seeds, &prepared.eye_axes), h, counts, |halo, s| of_set[halo] = s);
            if of_set.iter().any(|s| *s > 0.0) {
                let faded = if self.is_cut(k) {
                    let query = self.behind.object.query;
                    let attributes = self.behind.evaluate(sample, query, SampleAttributes::neutral(), counts);
                    self.faded(k, attributes)
                } else {
                    R::ONE
                };
                scratch.join(shares.background.to_f64(), faded.to_f64());
            }
        }
        // Ghosts and selections.
        for part in self.parts.iter_mut().filter(|part| contains(part.range, k)) {
            let Some(seeds) = &part.part.seeds else { continue };
            let set = selection_set(part.part, self.combination, &self.selections, &shares);
            let can_seed = |cell: [usize; 3]| part.part.can_seed(cell);
            let member = part.member(k, set, can_seed, &mut here, &self.behind, counts);
            let Some((sample, membership)) = member else { continue };
            let SeedScratch { of_set, h, .. } = &mut *scratch;
            part.evaluator.seed(sample, (seeds, &prepared.eye_axes), h, counts, |halo, s| of_set[halo] = s);
            scratch.join(membership.to_f64(), 1.0);
        }
        for (s, halo) in scratch.together.iter_mut().zip(&halos.list) {
            *s = halo.floored(*s);
        }
        // Samples that are evaluated for seeds are counted as `halo_samples`.
        counts.halo_samples += counts.samples - samples;
        (counts.samples, counts.masked) = (samples, masked);
    }
}
