//! The data that the function and the material of an object name.

use super::load::{function_failure, further, halo_labels, lighting_table, named, styles};
use super::target::calls_for_function;
use crate::Failure;
use crate::labels::SceneLabels;
use drypoint_reference::suggest;
use drypoint_scene::counts::Counts;
use drypoint_scene::inputs::ObjectData;
use drypoint_scene::plan::{Pass, Plan, Quantity};
use drypoint_scene::shot::Clipping;
use drypoint_scene::source::Source;
use drypoint_scene::space::Grid;
use drypoint_scene::style::Style;
use drypoint_scene::tables::Scene;
use drypoint_scene::transfer::Function;
use drypoint_scene::volume::Volume;
use drypoint_scene::volume::labels::LabelVolume;
use std::sync::Arc;

/// The data that the function and the material of an object name.
pub(crate) struct Assets {
    /// The transfer function, if it is needed. In a scene without a function, it shows nothing.
    pub(super) function: Option<Arc<Function>>,
    /// The label volume, if it is needed.
    pub(crate) labels: Option<LabelVolume>,
    /// The further volumes over which the function is.
    pub(super) further: [Option<Volume>; 2],
    /// The styles that the function names, then those of caps.
    pub(crate) styles: Vec<Style>,
}

impl Assets {
    /// Loads the data that the tables of an object name, over its volume. For a part, `main` is the grid of `[volume]`.
    /// A function without nodes is found in the data, and names of labels become ids. Adds faults to `failures`.
    pub(super) fn load(
        source: &dyn Source,
        tables: &mut Scene,
        plan: &mut Plan,
        volume: &Volume,
        main: Option<&Grid>,
        counts: &mut Counts,
        failures: &mut Vec<Failure>,
    ) -> Self {
        let labels = match plan.reads_labels() {
            true => SceneLabels::load(source, &tables.volume, volume, failures),
            false => SceneLabels::default(),
        };
        plan.warnings.extend(labels.warning(&tables.volume, volume));
        if failures.is_empty() && plan.needs_at_seeds(Quantity::Label) {
            halo_labels(tables, &labels.names, main.is_some(), failures);
        }
        // The function. An iso-surface needs none.
        let calls_for_function = calls_for_function(plan, tables);
        let range = tables.volume.range.unwrap_or_else(|| volume.range());
        let mut function = tables.transfer.is_none().then(Function::nothing);
        if let Some(transfer) = tables.transfer.as_mut().filter(|_| calls_for_function) {
            if transfer.is_automatic() {
                suggest::fill_function(transfer, volume, tables.volume.outside, counts);
            }
            let found = Function::new(transfer, range, volume, &|name| labels.names.id(name));
            function = found.unwrap_or_else(|errors| {
                // Without the table of labels every name would be unknown.
                if failures.is_empty() {
                    failures.extend(errors.iter().map(|error| function_failure(error, &tables.given, &labels.names)));
                }
                None
            });
        }
        // The styles. Those of caps come last.
        let mut styles_of = |names: &mut dyn Iterator<Item = &str>| styles(source, tables, names, failures);
        let mut styles = match &function {
            Some(Function::Style { names, .. }) => styles_of(&mut names.iter().map(String::as_str)),
            None if calls_for_function => styles_of(&mut tables.transfer.iter().flat_map(named)),
            Some(Function::Regular(_)) | None => Vec::new(),
        };
        let has_rays = plan.has_pass(Pass::Rays);
        if has_rays {
            let of_caps = match main {
                Some(grid) => Clipping::styles_of_part(tables, grid),
                None => Clipping::new(tables, volume.grid()).styles,
            };
            styles.extend(styles_of(&mut of_caps.iter().map(String::as_str)));
        }
        lighting_table(source, tables, plan, failures);
        let further = if has_rays { further(source, tables, failures) } else { [None, None] };
        if calls_for_function && function.is_none() && failures.is_empty() {
            let place = tables.given.position("transfer.nodes");
            failures.push(Failure::new("the transfer function has no node", place, "give it at least one"));
        }
        Self { function: function.map(Arc::new), labels: labels.volume, further, styles }
    }

    /// Returns the data that a shot names of an object.
    pub(crate) fn of<'a>(&'a self, volume: &'a Volume) -> ObjectData<'a> {
        let Self { labels, further, styles, .. } = self;
        ObjectData { volume, labels: labels.as_ref(), further: further.each_ref().map(Option::as_ref), styles }
    }
}
