//! The colours of values in the transfer function, for views beside the picture.

use super::Job;
use drypoint_reference::dot_colors::VoxelColors;
use drypoint_scene::color::Rgb;
use drypoint_scene::tables::Mix;

impl Job {
    /// Returns the linear colour of each of some values in the transfer function of the volume, whatever the opacity. A
    /// style is evaluated facing the eye. None for values that the function does not show, and for all values if there is
    /// no function over the value alone.
    pub fn value_colors(&self, values: &[f64]) -> Vec<Option<Rgb>> {
        let nothing = || vec![None; values.len()];
        let Some(function) = self.function().filter(|function| function.nodes().2.is_none()) else { return nothing() };
        let colors = VoxelColors {
            function,
            styles: &self.assets.styles,
            mix: self.scene.transfer.as_ref().map_or(Mix::Premultiplied, |transfer| transfer.mix),
            labels: None,
            by_label: false,
            range: self.volume.range(),
        };
        let Ok(colors) = colors.at_values(values) else { return nothing() };
        let is_shown = |value: f64| function.can_be_visible([value; 2], None, |node| node);
        values.iter().zip(colors).map(|(&value, color)| is_shown(value).then_some(color)).collect()
    }
}
