//! Scenes as texts, held to their bounds.

use drypoint::job::Job;
use drypoint::reference::ray::Renderer;
use drypoint::reference::ray::bounds::{Bounds, BoundsError, RayOrigin};
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::picture::{LayerKind, Picture};
use drypoint::scene::tables::Number;
use std::collections::BTreeMap;

/// A scene file's text.
pub(crate) struct Text<'a>(pub(crate) &'a str);

/// The figures of a scene.
pub(crate) struct Measured {
    /// The median of the decided pixels' bounds, among those that are not 0.
    pub(crate) median: f64,
    /// The largest difference of a decided pixel.
    pub(crate) measured: f64,
    /// The share of pixels at a decision.
    pub(crate) undecided: f64,
}

/// The channels of the beauty.
fn channels(picture: &Picture) -> &[Vec<f64>] {
    &picture.layer(LayerKind::Beauty).unwrap().channels
}

impl Text<'_> {
    fn job(&self, number: Number) -> Job {
        let mut scene = parse(self.0, "scene.toml".as_ref(), &Overrides::default())
            .unwrap_or_else(|faults| panic!("{faults}\n{}", self.0));
        scene.sampling.number = number;
        Job::load(scene).unwrap_or_else(|failures| panic!("{failures}"))
    }

    fn bounds(&self, origin: RayOrigin) -> Result<Bounds, BoundsError> {
        let job = self.job(Number::F64);
        let shot = job.shot().unwrap();
        Renderer::bounds(&shot, job.inputs(&shot), None, origin)
    }

    fn drawn(&self, number: Number) -> Picture {
        self.job(number).renderer().unwrap().frame(&|_| ()).0
    }

    /// The part of the scene that has no bound.
    pub(crate) fn unknown(&self) -> Option<&'static str> {
        match self.bounds(RayOrigin::Middle) {
            Err(BoundsError::Unknown { what }) => Some(what),
            Err(error) => panic!("{error}"),
            Ok(_) => None,
        }
    }

    /// Holds the reference in f32 to the bounds, and the values of the bounds to the picture.
    pub(crate) fn compared(&self, name: &str) -> Measured {
        let bounds = self.bounds(RayOrigin::Eye).unwrap_or_else(|error| panic!("{name}: {error}"));
        let [truth, single] = [Number::F64, Number::F32].map(|number| self.drawn(number));
        let [values, errors] = [&bounds.values, &bounds.errors].map(channels);
        let [truth, single] = [&truth, &single].map(channels);
        let mut reasons = BTreeMap::new();
        let (mut measured, mut of_pixels) = (0.0f64, Vec::new());
        for i in 0..bounds.undecided.len() {
            for c in 0..4 {
                assert_eq!(values[c][i].to_bits(), truth[c][i].to_bits(), "{name}, pixel {i}, channel {c}");
            }
            if let Some(decision) = bounds.undecided[i] {
                *reasons.entry(decision).or_insert(0) += 1;
                continue;
            }
            for c in 0..4 {
                let off = (single[c][i] - values[c][i]).abs();
                let bound = errors[c][i];
                assert!(off <= bound, "{name}, pixel {i}, channel {c}: off by {off:e}, bound {bound:e}");
                measured = measured.max(off);
            }
            of_pixels.push((0..4).map(|c| errors[c][i]).fold(0.0, f64::max));
        }
        of_pixels.retain(|bound| *bound > 0.0);
        of_pixels.sort_by(f64::total_cmp);
        let at = |share: f64| of_pixels[((of_pixels.len() - 1) as f64 * share) as usize];
        let undecided = reasons.values().sum::<usize>() as f64 / bounds.undecided.len() as f64;
        let (median, bound) = (at(0.5), at(1.0));
        println!(
            "{name:<34} median {median:8.1e} 99 % {:8.1e} largest {bound:8.1e} measured {measured:8.1e} undecided {:5.2} % \
             {reasons:?}",
            at(0.99),
            100.0 * undecided
        );
        Measured { median, measured, undecided }
    }
}
