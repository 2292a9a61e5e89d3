//! Plots of a pen's tone: the measured step wedge and its inverse ([STIP-17]).

use drypoint_scene::tone::{FULL, Tone};
use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::plot::LinePlot;
use kuva::plot::legend::LegendPosition;
use kuva::plot::scatter::ScatterPlot;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::{Scene, render_multiple};

/// Pixels of the PNG for each unit of the plot.
const SCALE: f32 = 1.5;

/// Number of points of the inverse, up to the fullest tone.
const POINTS: usize = 90;

/// Returns the plot as SVG.
pub fn svg(tone: &Tone, name: &str) -> String {
    SvgBackend::default().render_scene(&drawn(tone, name))
}

/// Returns the plot as PNG.
///
/// # Errors
/// Errors of the encoder.
pub fn png(tone: &Tone, name: &str) -> Result<Vec<u8>, String> {
    PngBackend::new().with_scale(SCALE).render_scene(&drawn(tone, name))
}

fn drawn(tone: &Tone, name: &str) -> Scene {
    let rows: Vec<(f64, f64)> = tone.rows().iter().map(|row| (row[0], row[1])).collect();
    let inverse = (0..=POINTS).map(|i| FULL * i as f64 / POINTS as f64).map(|wanted| (wanted, tone.asked(wanted)));
    let line = |data: Vec<(f64, f64)>, color: &str, legend: &str| {
        Plot::Line(LinePlot::new().with_data(data).with_color(color).with_stroke_width(1.6).with_legend(legend))
    };
    let plots = vec![
        line(vec![(0.0, 0.0), (1.0, 1.0)], "#bdbdbd", "as wanted"),
        line(rows.clone(), "#d55e00", "measured"),
        Plot::Scatter(ScatterPlot::new().with_data(rows).with_color("#d55e00").with_size(4.5)),
        line(inverse.collect(), "#0072b2", "asked for instead"),
    ];
    let layout = Layout::auto_from_plots(&plots)
        .with_width(760.0)
        .with_height(560.0)
        .with_x_axis_min(0.0)
        .with_x_axis_max(1.0)
        .with_y_axis_min(0.0)
        .with_y_axis_max(1.0)
        .with_title(format!("{name}: tone"))
        .with_x_label("wanted coverage")
        .with_y_label("coverage")
        .with_legend_position(LegendPosition::OutsideRightTop)
        .with_title_size(18)
        .with_label_size(13)
        .with_tick_size(11);
    render_multiple(plots, layout)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_has_both_curves() {
        let tone = Tone::from_rows(&[[0.0, 0.0], [0.5, 0.7], [0.9, 0.98]]).unwrap();
        let text = svg(&tone, "black");
        assert!(text.contains("measured") && text.contains("asked for instead") && text.contains("black: tone"));
        assert_eq!(&png(&tone, "black").unwrap()[1..4], b"PNG");
    }
}
