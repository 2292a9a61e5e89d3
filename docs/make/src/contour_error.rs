//! Plot of the error of printed contours of lighting functions over the angle between light and eye ([VS-5]).

use crate::files;
use drypoint::scene::lighting::ContourRule;
use kuva::backend::png::PngBackend;
use kuva::plot::LinePlot;
use kuva::plot::legend::LegendPosition;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::{Scene, render_multiple};

/// Writes the plot.
///
/// # Errors
/// Errors of the encoder and of the system.
pub(crate) fn write() -> Result<(), String> {
    let png = PngBackend::new().with_scale(1.2).render_scene(&drawn())?;
    files::write("pictures/volumeshop/contour-error.png", &png)
}

/// The error in degrees of a rule, at each degree between light and eye.
fn errors(rule: ContourRule) -> Vec<(f64, f64)> {
    let error = |degrees: f64| {
        let l_dot_v = degrees.to_radians().cos();
        ContourRule::error(rule.factor(l_dot_v), l_dot_v)
    };
    (0..=170).map(f64::from).map(|degrees| (degrees, error(degrees))).collect()
}

fn drawn() -> Scene {
    let line = |rule, color: &str, name: &str| {
        Plot::Line(LinePlot::new().with_data(errors(rule)).with_color(color).with_stroke_width(2.0).with_legend(name))
    };
    let plots = vec![
        line(ContourRule::Printed, "#d55e00", "printed: c = 2"),
        line(ContourRule::Exact, "#0072b2", "exact: c = ‖L + V‖"),
    ];
    let layout = Layout::auto_from_plots(&plots)
        .with_width(860.0)
        .with_height(480.0)
        .with_title("Contours of a lighting function beside the silhouette")
        .with_x_label("angle between light and eye, degrees")
        .with_y_label("error, degrees")
        .with_legend_position(LegendPosition::OutsideRightTop)
        .with_title_size(16)
        .with_label_size(13)
        .with_tick_size(11);
    render_multiple(plots, layout)
}
