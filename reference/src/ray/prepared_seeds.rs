//! The seeds of halos among the samples of the background, a selection or a ghost ([HALO-2], [VS-2]).

use super::error::RenderError;
use crate::labels::Labels;
use crate::volumetric_halos::seed::Seeding;
use drypoint_scene::inputs::ObjectData;
use drypoint_scene::shot::{HaloParams, HaloSeed, LabelLookup, SampleQuery, SeedValue};
use drypoint_scene::transfer::{Function, can_be_above_zero};

/// The seeding of all halos, and the queries of samples for it.
pub(super) struct PreparedSeeds<'v> {
    /// The seeding of each halo, in the halos' order.
    pub(super) list: Vec<Seeding>,
    /// The query of samples that can seed.
    pub(super) query: SampleQuery,
    /// The part of the query that remains after α_u of a function over two quantities.
    pub(super) rest: SampleQuery,
    /// Whether some h_v is α_u.
    pub(super) reads_opacity: bool,
    /// Whether there is an h_p.
    pub(super) reads_places: bool,
    /// The labels, if there is an h_l.
    pub(super) labels: Option<Labels<'v>>,
}

impl<'v> PreparedSeeds<'v> {
    /// Prepares the seeding of halos by the samples of a volume. `over_two` is the query of a function over two
    /// quantities, which is evaluated before α_u is known.
    ///
    /// # Errors
    /// The nodes of an h_v do not make a function, or labels were not handed over.
    pub(super) fn new(
        (halos, query): (&[HaloParams], SampleQuery),
        data: &ObjectData<'v>,
        label_lookup: LabelLookup,
        over_two: Option<SampleQuery>,
    ) -> Result<Self, RenderError> {
        let list: Vec<Seeding> = halos.iter().map(Seeding::new).collect::<Result<_, _>>()?;
        let any = |is: fn(&Seeding) -> bool| list.iter().any(is);
        let labels = if any(|seeding| seeding.labels.is_some()) {
            let labels = data.labels.ok_or(RenderError::NoLabels)?;
            Some(Labels::new(labels, data.volume.grid(), data.volume.anatomy(), label_lookup))
        } else {
            None
        };
        let reads_opacity = any(Seeding::reads_opacity);
        let reads_places = any(|seeding| seeding.focus.is_some());
        let rest = over_two.map_or(query, |first| query.without(first));
        Ok(Self { list, query, rest, reads_opacity, reads_places, labels })
    }
}

/// Whether h_v can be above 0 at a value of a range. `rounded` rounds to the number type of samples.
pub(super) fn can_seed_at(
    seed: &HaloSeed,
    function: &Function,
    range: [f64; 2],
    rounded: impl Fn(f64) -> f64 + Copy,
) -> bool {
    match &seed.value {
        None => true,
        Some(SeedValue::Opacity) => function.can_be_visible(range, None, rounded),
        Some(SeedValue::Nodes(nodes)) => {
            let (at, h): (Vec<f64>, Vec<f64>) = nodes.iter().map(|&[at, h]| (at, h)).unzip();
            can_be_above_zero(&at, &h, range, rounded)
        }
    }
}
