//! A sample with its colour and its opacity per reference length.

use super::need::{self, Need};
use super::{Evaluator, OverTwo, Sample, SampleAttributes};
use crate::field::Sampler;
use crate::number::Real;
use crate::transfer::NodePlace;
use crate::transfer::over::SampleQuantities;
use drypoint_scene::counts::Counts;

/// Straight colour and opacity per reference length, and the field's attributes from which they were computed.
pub(crate) type Shaded<R> = (([R; 3], R), SampleAttributes<R>);

impl<R: Real, S: Sampler<R>> Evaluator<'_, '_, R, S> {
    /// Evaluates and shades a visible sample of a function over the value.
    #[inline(always)]
    pub(crate) fn shaded<N: Need>(
        &mut self,
        sample: Sample<R>,
        place: &NodePlace<R>,
        counts: &mut Counts,
    ) -> Shaded<R> {
        let object = self.object;
        let query = N::query(object);
        let attributes = self.evaluate(sample, query, SampleAttributes::neutral(), counts);
        counts.without_normal += u64::from(query.gradient && attributes.normal.is_none());
        let (dirs, cut) = (&self.dirs, self.cut_at(sample.k));
        let seen = cut.map_or(attributes, |cut| cut.attributes(attributes));
        let shaded = match &object.table {
            Some(table) if N::MORE => object.shader.shade(table.between_nodes(place), seen, dirs, counts),
            _ => object.shader.shade(*place, seen, dirs, counts),
        };
        (cut.map_or(shaded, |cut| cut.shade(shaded)), attributes)
    }

    /// Evaluates and shades a sample of any function. Returns none if the sample is transparent.
    pub(crate) fn shaded_by_any(&mut self, sample: Sample<R>, counts: &mut Counts) -> Option<Shaded<R>> {
        match &self.object.over_two {
            Some(over_two) => self.shaded_over_two(over_two, sample, counts),
            None => {
                let place = self.object.function.locate(sample.s)?;
                Some(self.shaded::<need::Anything>(sample, &place, counts))
            }
        }
    }

    /// Unlit straight colour and opacity of a visible sample. The attributes need not be its own: if two objects meet,
    /// the attributes of one shade both ([VS-4]). `own` are the sample's.
    pub(crate) fn unlit(
        &self,
        sample: Sample<R>,
        [own, attributes]: [SampleAttributes<R>; 2],
        counts: &mut Counts,
    ) -> ([R; 3], R) {
        let (object, dirs) = (self.object, &self.dirs);
        let unlit = match &object.over_two {
            Some(over_two) => {
                let patch = over_two.locate(&self.quantities(sample, &own));
                patch.map(|patch| object.shader.unlit(patch, attributes, dirs, counts))
            }
            None => object.function.locate(sample.s).map(|place| match &object.table {
                Some(table) => object.shader.unlit(table.between_nodes(&place), attributes, dirs, counts),
                None => object.shader.unlit(place, attributes, dirs, counts),
            }),
        };
        unlit.unwrap_or(([R::ZERO; 3], R::ZERO))
    }

    /// The quantities of a sample that a function can be over.
    #[inline(always)]
    pub(super) fn quantities(&self, sample: Sample<R>, attributes: &SampleAttributes<R>) -> SampleQuantities<R> {
        let of_normal = |x: R| if attributes.normal.is_some() { x } else { R::ZERO };
        SampleQuantities {
            position: self.position(sample.k),
            place: sample.at,
            value: sample.s,
            gradient: of_normal(attributes.gradient.length()),
            magnitude: of_normal(attributes.magnitude),
            principal: attributes.principal,
            kappa: attributes.kappa,
        }
    }

    /// Evaluates and shades a sample of a function over two quantities. These quantities are evaluated first, the rest
    /// only if α_u > 0.
    #[inline(always)]
    pub(crate) fn shaded_over_two(
        &mut self,
        over_two: &OverTwo<'_, R>,
        sample: Sample<R>,
        counts: &mut Counts,
    ) -> Option<Shaded<R>> {
        let object = self.object;
        let attributes = self.evaluate(sample, over_two.first, SampleAttributes::neutral(), counts);
        let patch = over_two.locate(&self.quantities(sample, &attributes))?;
        let attributes = self.evaluate(sample, over_two.rest, attributes, counts);
        counts.without_normal += u64::from(object.query.gradient && attributes.normal.is_none());
        let cut = self.cut_at(sample.k);
        let seen = cut.map_or(attributes, |cut| cut.attributes(attributes));
        let shaded = object.shader.shade(patch, seen, &self.dirs, counts);
        Some((cut.map_or(shaded, |cut| cut.shade(shaded)), attributes))
    }
}
