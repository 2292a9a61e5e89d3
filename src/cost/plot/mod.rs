//! Plots of sweeps ([COST-1]): a panel for each knob, error against time on two logarithmic axes that all panels share.
//! Each setting is labelled. The other knobs and the Pareto front are drawn in pale colours behind.

use super::{CostRow, ErrorSubject, Sweep, Truth, front};
use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::plot::scatter::ScatterPlot;
use kuva::plot::{LabelStyle, LinePlot};
use kuva::render::annotations::ReferenceLine;
use kuva::render::figure::Figure;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::Scene;
use std::sync::Arc;

/// Colour of a panel's own settings.
const OWN: &str = "#0072b2";
/// Colour of the Pareto front.
const FRONT: &str = "#d4d4d4";
/// Colour of the settings of other knobs.
const OTHERS: &str = "#c0c0c0";

/// Smallest error and time on a logarithmic axis.
const LEAST: f64 = 1e-9;

/// Largest number of panels in a row, and width and height of a panel in the plot's units.
const COLUMNS: usize = 3;
const PANEL: [f64; 2] = [400.0, 330.0];

/// The unit of settings that are lengths, behind their numbers.
const VOXELS: &str = " voxels";

/// Pixels of the PNG for each unit of the plot.
const SCALE: f32 = 1.25;

/// Returns the plot as SVG, in the viewer's font.
///
/// # Errors
/// No setting has an error.
pub(super) fn svg(sweep: &Sweep, name: &str) -> Result<String, String> {
    Ok(SvgBackend::default().render_scene(&drawn(sweep, name)?))
}

/// Returns the plot as PNG, in its own font.
///
/// # Errors
/// No setting has an error, or the encoder fails.
pub(super) fn png(sweep: &Sweep, name: &str) -> Result<Vec<u8>, String> {
    PngBackend::new().with_scale(SCALE).render_scene(&drawn(sweep, name)?)
}

fn drawn(sweep: &Sweep, name: &str) -> Result<Scene, String> {
    let shown: Vec<&CostRow> = sweep.rows.iter().filter(|row| row.rms >= LEAST && row.seconds >= LEAST).collect();
    if shown.is_empty() {
        return Err("there is nothing to plot: no setting has an error".into());
    }
    // Rows of a knob stand together.
    let knobs: Vec<&[&CostRow]> = shown.chunk_by(|a, b| a.knob == b.knob).collect();
    let columns = knobs.len().min(COLUMNS);
    let rows = knobs.len().div_ceil(columns);
    let axes = [reach(&shown, |row| row.seconds), reach(&shown, |row| row.rms)];
    let plots = knobs.iter().map(|knob| panel(sweep, &shown, knob)).collect();
    // The axes are named once, under the first panel of the last row and in the title.
    let named = (rows - 1) * columns;
    let layouts = knobs.iter().enumerate().map(|(i, knob)| layout(sweep, knob, axes, i == named)).collect();
    let analytic = shown.iter().any(|row| row.truth == Truth::Analytic);
    let against =
        if analytic { "against the formula; *: against the finest setting" } else { "*: against the finest setting" };
    let of_picture = shown.iter().any(|row| row.subject == ErrorSubject::Picture);
    let [width, height] = sweep.size;
    let what = if of_picture { "a frame" } else { "a page, from the voxels on," };
    let title = format!("{name}: RMS error ({against}) over the time of {what} of {width} × {height} pixels");
    let figure = Figure::new(rows, columns)
        .with_structure((0..knobs.len()).map(|i| vec![i]).collect())
        .with_plots(plots)
        .with_layouts(layouts)
        .with_cell_size(PANEL[0], PANEL[1])
        .with_spacing(10.0)
        .with_title(title)
        .with_title_size(17);
    Ok(figure.render())
}

/// Returns the axes and the title of a knob's panel.
fn layout(sweep: &Sweep, knob: &[&CostRow], [times, errors]: [[f64; 2]; 2], is_named: bool) -> Layout {
    let first = knob[0];
    let star = if first.truth == Truth::Analytic { "" } else { " *" };
    let unit = if knob.iter().any(|row| row.setting.ends_with(VOXELS)) { " in voxels" } else { "" };
    let mut layout = Layout::new((times[0], times[1]), (errors[0], errors[1]))
        .with_log_scale()
        .with_x_axis_min(times[0] / 1.5)
        .with_x_axis_max(times[1] * 1.5)
        .with_y_axis_min(errors[0] / 2.5)
        .with_y_axis_max(errors[1] * 2.5)
        .with_x_tick_format(TickFormat::Custom(Arc::new(time)))
        .with_y_tick_format(TickFormat::Custom(Arc::new(|error| format!("{error:.0e}"))))
        .with_title(format!("{}{unit}{star}{}", first.knob, of(first.subject)))
        .with_title_size(14)
        .with_label_size(12)
        .with_body_size(11)
        .with_tick_size(10);
    if is_named {
        layout = layout.with_x_label(format!("time, median of {} runs", sweep.runs));
    }
    if let Some(own) = sweep.rows.iter().find(|row| row.own) {
        layout = layout.with_reference_line(ReferenceLine::vertical(own.seconds).with_color("#888888"));
    }
    layout
}

/// Returns the plots of a knob's panel, from back to front.
fn panel(sweep: &Sweep, shown: &[&CostRow], knob: &[&CostRow]) -> Vec<Plot> {
    let places = |rows: &[&CostRow]| rows.iter().map(|row| (row.seconds, row.rms)).collect::<Vec<_>>();
    let first = knob[0];
    let mut plots = Vec::new();
    // The front of the knob's kind of error.
    let best: Vec<&CostRow> = front(&sweep.rows, first.subject, first.truth == Truth::Analytic)
        .into_iter()
        .filter(|row| row.rms >= LEAST && row.seconds >= LEAST)
        .collect();
    plots.push(Plot::Line(LinePlot::new().with_data(places(&best)).with_color(FRONT).with_stroke_width(7.0)));
    let others: Vec<&CostRow> = shown.iter().copied().filter(|row| row.knob != first.knob).collect();
    plots.push(Plot::Scatter(ScatterPlot::new().with_data(places(&others)).with_color(OTHERS).with_size(2.5)));
    // The knob's own settings, coarse to fine, with their spreads and names. The unit stands in the title, and brackets
    // mark what the scene says.
    plots.push(Plot::Line(LinePlot::new().with_data(places(knob)).with_color(OWN).with_stroke_width(1.2)));
    let names = knob.iter().map(|row| {
        let name = row.setting.trim_end_matches(VOXELS).trim_end_matches(" voxel");
        if row.own { format!("[{name}]") } else { name.into() }
    });
    let settings = ScatterPlot::new()
        .with_data(places(knob))
        .with_x_err(knob.iter().map(|row| row.spread / 2.0))
        .with_color(OWN)
        .with_size(3.5)
        .with_labels(names)
        .with_label_style(LabelStyle::Repel);
    plots.push(Plot::Scatter(settings));
    plots
}

/// Returns the subject of an error for a title, unless it is the picture.
fn of(subject: ErrorSubject) -> &'static str {
    match subject {
        ErrorSubject::Picture => "",
        ErrorSubject::Dots => ", dots",
        ErrorSubject::Strokes => ", strokes (voxels)",
    }
}

/// Returns the smallest and the largest value of rows.
fn reach(rows: &[&CostRow], of: fn(&CostRow) -> f64) -> [f64; 2] {
    rows.iter().map(|row| of(row)).fold([f64::INFINITY, 0.0], |[lo, hi], x| [lo.min(x), hi.max(x)])
}

/// Returns seconds in s, ms or µs.
fn time(seconds: f64) -> String {
    // Ticks of a logarithmic axis are 1, 2 or 5 times a power of ten, up to rounding.
    let digits = |x: f64| format!("{}", (x * 1e6).round() / 1e6);
    match seconds {
        _ if seconds >= 1.0 => format!("{} s", digits(seconds)),
        _ if seconds >= 1e-3 => format!("{} ms", digits(seconds * 1e3)),
        _ => format!("{} µs", digits(seconds * 1e6)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(knob: &str, setting: &str, seconds: f64, rms: f64) -> CostRow {
        let truth = Truth::Finest("f".into());
        let (knob, setting) = (knob.into(), setting.into());
        CostRow {
            knob,
            subject: ErrorSubject::Picture,
            setting,
            own: rms == 0.5,
            rms,
            max: rms,
            flip: rms,
            angle: None,
            seconds,
            spread: 0.1,
            samples: 1,
            bytes: 1,
            truth,
        }
    }

    fn sweep(rows: Vec<CostRow>) -> Sweep {
        Sweep { rows, left_out: Vec::new(), runs: 1, threads: 1, size: [3, 2] }
    }

    #[test]
    fn every_setting_has_a_name_and_every_axis_one() {
        let rows = vec![
            row("sampling.step", "4 voxels", 0.01, 0.5),
            row("sampling.step", "1 voxel", 0.1, 0.05),
            row("sampling.kernel", "slow and bad", 0.2, 0.4),
            row("sampling.kernel", "its own truth", 0.3, 0.0),
            row("sampling.number", "f32", 0.2, 1e-6),
            row("picture.samples", "2", 0.9, 0.01),
        ];
        let text = svg(&sweep(rows), "a <scene>").unwrap();
        for (part, times) in [
            ("sampling.step in voxels *", 1),
            ("sampling.kernel *", 1),
            (">[4]<", 1),
            (">1<", 1),
            (">slow and bad<", 1),
            (">f32<", 1),
            ("its own truth", 0),
            ("a &lt;scene&gt;: RMS error", 1),
            ("time, median of 1 runs", 1),
        ] {
            assert_eq!(text.matches(part).count(), times, "{part}\n{text}");
        }
        // One format of errors, with the same ticks in each of four panels.
        assert_eq!(text.matches(">1e-3<").count(), 4, "{text}");
        assert!(!text.contains(">0.1<") && !text.contains(">0.01<"));
        let bytes = png(&sweep(vec![row("sampling.step", "4 voxels", 0.01, 0.5)]), "a").unwrap();
        assert!(bytes.starts_with(b"\x89PNG"));
    }

    #[test]
    fn nothing_to_plot_is_an_error() {
        assert!(svg(&sweep(vec![row("sampling.step", "fine", 0.1, 0.0)]), "a").is_err());
    }

    #[test]
    fn times_have_their_units() {
        assert_eq!([2.0, 0.5, 0.1 + 0.2 - 0.28, 2e-5].map(time), ["2 s", "500 ms", "20 ms", "20 µs"]);
    }
}
