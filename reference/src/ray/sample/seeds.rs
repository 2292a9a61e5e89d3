//! The seeds of a sample: s of each halo ([HALO-2], [HALO-3]).

use super::{Evaluator, EyeAxes, Sample, SampleAttributes};
use crate::field::Sampler;
use crate::number::Real;
use crate::ray::prepared_seeds::PreparedSeeds;
use crate::style_transfer_functions::contour;
use crate::volumetric_halos::seed::{SeedNormal, SeedPlace};
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec3;

impl<R: Real, S: Sampler<R>> Evaluator<'_, '_, R, S> {
    /// Adds the seeds of a sample. `add` receives the index of each halo with s > 0, and s. `h` has an entry for each
    /// halo.
    #[inline]
    pub(crate) fn seed(
        &mut self,
        sample: Sample<R>,
        (seeds, eye_axes): (&PreparedSeeds<'_>, &EyeAxes<R>),
        h: &mut [f64],
        counts: &mut Counts,
        mut add: impl FnMut(usize, f64),
    ) {
        // h_v, h_l and h_p, and for a function over two quantities the quantities of α_u.
        let position = self.position(sample.k);
        let mut attributes = SampleAttributes::neutral();
        let reads = seeds.reads_opacity;
        let (alpha_u, asked) = if reads { self.alpha_u(sample, &mut attributes, counts) } else { (R::ZERO, false) };
        let place = SeedPlace {
            value: sample.s.to_f64(),
            alpha_u: alpha_u.to_f64(),
            world: if seeds.reads_places { self.object.grid.to_world(position.to_glam()) } else { DVec3::ZERO },
            label: seeds.labels.as_ref().map_or(0, |labels| labels.id_at(position)),
        };
        let mut any = false;
        for (h, seeding) in h.iter_mut().zip(&seeds.list) {
            *h = seeding.before_gradient(&place);
            any |= *h > 0.0;
        }
        if !any {
            return;
        }
        // s, for samples that have a normal.
        let rest = if asked { seeds.rest } else { seeds.query };
        let attributes = self.evaluate(sample, rest, attributes, counts);
        if attributes.normal.is_none() {
            return;
        }
        let cut = self.cut_at(sample.k);
        let attributes = cut.map_or(attributes, |cut| cut.attributes(attributes));
        let Some(n) = attributes.normal else { return };
        let eye = eye_axes.normal(&attributes, &self.dirs);
        let mut normal = SeedNormal {
            in_picture: [eye.x.to_f64(), eye.y.to_f64()],
            n_dot_v: n.dot(self.dirs.v).to_f64().abs(),
            magnitude: attributes.magnitude.to_f64(),
            tau: 0.0,
        };
        for (i, (&h, seeding)) in h.iter().zip(&seeds.list).enumerate().filter(|(_, (h, _))| **h > 0.0) {
            normal.tau = seeding.thickness().map_or(0.0, |t| contour::root(attributes.kappa.to_f64().abs() * t));
            let s = seeding.strength(h, &normal);
            if s > 0.0 {
                add(i, s);
            }
        }
    }

    /// α_u of a sample. The flag tells whether a function over two quantities evaluated its query, whose attributes are
    /// then known.
    #[inline]
    pub(in crate::ray) fn alpha_u(
        &mut self,
        sample: Sample<R>,
        attributes: &mut SampleAttributes<R>,
        counts: &mut Counts,
    ) -> (R, bool) {
        let object = self.object;
        let Some(place) = object.function.locate(sample.s) else { return (R::ZERO, false) };
        let Some(over_two) = &object.over_two else { return (place.alpha_u, false) };
        *attributes = self.evaluate(sample, over_two.first, *attributes, counts);
        let here = self.quantities(sample, attributes);
        (over_two.locate(&here).map_or(R::ZERO, |patch| patch.alpha_u), true)
    }
}
