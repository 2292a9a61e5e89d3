//! Plots of the integrator on curves that are known: its order, its error against the tolerance, its steps ([HATCH-8]).

mod curves;

use crate::files;
use curves::{Curve, curves};
use kuva::backend::png::PngBackend;
use kuva::plot::LinePlot;
use kuva::plot::legend::LegendPosition;
use kuva::plot::scatter::{MarkerShape, ScatterPlot};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;

/// Okabe and Ito's colours (2008).
const COLORS: [&str; 5] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00"];

const MARKS: [MarkerShape; 5] =
    [MarkerShape::Circle, MarkerShape::Square, MarkerShape::Triangle, MarkerShape::Diamond, MarkerShape::TriangleDown];

/// The smallest number that a logarithmic axis shows.
const LEAST: f64 = 1e-10;

/// Places of one curve on a plot.
type Places = Vec<(f64, f64)>;

/// A plot of all curves.
struct Figure {
    file: &'static str,
    title: &'static str,
    labels: [&'static str; 2],
    of: fn(&Curve) -> Places,
    /// A straight line that the curves are held against, and what it is.
    line: ([(f64, f64); 2], &'static str),
}

const FIGURES: [Figure; 3] = [
    Figure {
        file: "integrator-order",
        title: "Steps of one length: fourth order",
        labels: ["step, voxels", "error, voxels"],
        of: |curve| (0..9).map(|i| 4.0 * 0.5f64.powi(i)).map(|h| (h, curve.in_steps_of(h).error)).collect(),
        line: ([(4.0, 0.1), (4.0 / 128.0, 0.1 / 268_435_456.0)], "slope 4"),
    },
    Figure {
        file: "integrator-tolerance",
        title: "The error follows the tolerance",
        labels: ["tolerance, voxels", "error, voxels"],
        of: |curve| tolerances().map(|t| (t, curve.within(t).error)).collect(),
        line: ([(0.1, 0.1), (1e-10, 1e-10)], "error = tolerance"),
    },
    Figure {
        file: "integrator-steps",
        title: "What a tolerance costs",
        labels: ["tolerance, voxels", "steps in an arc of 40 voxels"],
        of: |curve| tolerances().map(|t| (t, 40.0 * curve.within(t).steps as f64 / curve.length())).collect(),
        line: ([(0.1, 3.0), (1e-10, 3.0 * 177.827_941)], "slope −1/4"),
    },
];

/// 10⁻¹ … 10⁻¹⁰.
fn tolerances() -> impl Iterator<Item = f64> {
    (1..=10).map(|power| 10f64.powi(-power))
}

/// Traces all and writes the plots.
///
/// # Errors
/// What the encoder or the system says.
pub(crate) fn write() -> Result<(), String> {
    for figure in &FIGURES {
        let png = PngBackend::new().with_scale(1.2).render_scene(&figure.drawn())?;
        files::write(&format!("pictures/interactive_volume_illustration/{}.png", figure.file), &png)?;
    }
    Ok(())
}

impl Figure {
    fn drawn(&self) -> kuva::render::render::Scene {
        let (ends, name) = self.line;
        let mut plots = vec![Plot::Line(
            LinePlot::new().with_data(ends.to_vec()).with_color("#bbbbbb").with_stroke_width(3.0).with_legend(name),
        )];
        for ((curve, color), mark) in curves().iter().zip(COLORS).zip(MARKS) {
            let at: Places = (self.of)(curve).into_iter().filter(|(_, y)| *y >= LEAST).collect();
            plots.push(Plot::Line(LinePlot::new().with_data(at.clone()).with_color(color).with_stroke_width(1.2)));
            let marks = ScatterPlot::new().with_data(at).with_color(color).with_marker(mark).with_size(4.5);
            plots.push(Plot::Scatter(marks.with_legend(curve.name)));
        }
        let layout = Layout::auto_from_plots(&plots)
            .with_width(860.0)
            .with_height(480.0)
            .with_log_scale()
            .with_title(self.title)
            .with_x_label(self.labels[0])
            .with_y_label(self.labels[1])
            .with_legend_position(LegendPosition::OutsideRightTop)
            .with_title_size(16)
            .with_label_size(13)
            .with_tick_size(11);
        render_multiple(plots, layout)
    }
}
