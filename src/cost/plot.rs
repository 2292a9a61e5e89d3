//! Plots of sweeps ([COST-1]): error against time on two logarithmic axes. Each knob has a colour and a marker; the
//! settings of the Pareto fronts are named.

use super::{CostRow, ErrorSubject, Sweep, Truth, front};
use drypoint_scene::math::ln;
use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::plot::legend::LegendPosition;
use kuva::plot::scatter::{MarkerShape, ScatterPlot};
use kuva::plot::{LabelStyle, LinePlot};
use kuva::render::annotations::ReferenceLine;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::{Scene, render_multiple};
use std::sync::Arc;

/// Colours of knobs in order. The first are those of Okabe and Ito (2008), which most colour-blind people can tell
/// apart; then follow darker variants with other markers.
const COLORS: [&str; 12] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#7a4fbf", "#8c510a", "#003f63", "#7f3800",
    "#005f45", "#7a4865",
];

const MARKS: [MarkerShape; 5] =
    [MarkerShape::Circle, MarkerShape::Square, MarkerShape::Triangle, MarkerShape::Diamond, MarkerShape::TriangleDown];

/// Smallest error and time that a logarithmic axis shows.
const LEAST: f64 = 1e-9;

/// Width of the names on the front, relative to that from the fastest setting to the slowest.
const NAMES: f64 = 0.25;

/// Offsets of a name: from the middle of a front's disc left to the name's end, and down to its baseline. They clear
/// the bar of its spread.
const BELOW: [f64; 2] = [8.0, 13.0];

/// Least span of the settings on the axes, and size of a letter, in the plot's units.
const SPAN: [f64; 2] = [440.0, 440.0];
const LETTER: [f64; 2] = [7.0, 15.0];

/// Pixels of the PNG in a unit of the plot.
const SCALE: f32 = 1.5;

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
    let mut knobs: Vec<&str> = sweep.rows.iter().map(|row| row.knob.as_str()).collect();
    knobs.dedup();
    let reaches = [reach(&shown, |row| row.seconds), reach(&shown, |row| row.rms)];
    let [[fast, slow], [small, large]] = reaches;
    // The fronts lie behind everything.
    let (mut plots, names) = fronts(sweep, reaches);
    // A line with markers for each knob.
    for (i, knob) in knobs.iter().enumerate() {
        let rows: Vec<&CostRow> = shown.iter().copied().filter(|row| row.knob == *knob).collect();
        let Some(first) = rows.first() else { continue };
        let truth = match first.truth {
            Truth::Analytic => "",
            Truth::Finest(_) => " *",
        };
        let color = COLORS[i % COLORS.len()];
        let at: Vec<(f64, f64)> = rows.iter().map(|row| (row.seconds, row.rms)).collect();
        plots.push(Plot::Line(LinePlot::new().with_data(at.clone()).with_color(color).with_stroke_width(1.2)));
        let marks = ScatterPlot::new()
            .with_data(at)
            .with_x_err(rows.iter().map(|row| row.spread / 2.0))
            .with_color(color)
            .with_marker(MARKS[i % MARKS.len()])
            .with_size(4.5)
            .with_legend(format!("{knob}{truth}{}", of(first.subject)));
        plots.push(Plot::Scatter(marks));
    }
    plots.push(names);
    let [width, height] = sweep.size;
    // Title, axes and legend.
    let analytic = sweep.rows.iter().any(|row| row.truth == Truth::Analytic);
    let against =
        if analytic { "against the formula; *: against the finest setting" } else { "*: against the finest setting" };
    let of_picture = sweep.rows.iter().any(|row| row.subject == ErrorSubject::Picture);
    let what = if of_picture { "a frame" } else { "a page, from the voxels on," };
    let mut layout = Layout::auto_from_plots(&plots)
        .with_width(1000.0)
        .with_height(640.0)
        .with_log_scale()
        .with_x_axis_min(fast / (slow / fast).max(2.0).powf(NAMES) / 1.2)
        .with_x_axis_max(slow * 1.5)
        .with_y_axis_min(small / 2.0)
        .with_y_axis_max(large * 2.0)
        .with_x_tick_format(TickFormat::Custom(Arc::new(time)))
        .with_title(format!("{name}: RMS error, {against}"))
        .with_x_label(format!("time of {what} of {width} × {height} pixels, median of {} runs", sweep.runs))
        .with_legend_position(LegendPosition::OutsideRightTop)
        .with_title_size(18)
        .with_label_size(13)
        .with_tick_size(11);
    if let Some(own) = sweep.rows.iter().find(|row| row.own) {
        layout = layout.with_reference_line(
            ReferenceLine::vertical(own.seconds).with_label("the scene as it is").with_color("#888888"),
        );
    }
    Ok(render_multiple(plots, layout))
}

/// Returns the subject of an error for the legend, unless it is the picture.
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

/// Returns the fronts, wide and grey, which go behind everything, and the names of their settings, which go before
/// everything.
fn fronts(sweep: &Sweep, reaches: [[f64; 2]; 2]) -> (Vec<Plot>, Plot) {
    let (mut lines, mut places, mut names) = (Vec::new(), Vec::new(), Vec::new());
    let looks = [(true, "#bdbdbd", "Pareto front"), (false, "#e3e3e3", "Pareto front *")];
    for (subject, (analytic, color, legend)) in
        ErrorSubject::ALL.iter().flat_map(|subject| looks.map(|look| (*subject, look)))
    {
        let legend = format!("{legend}{}", of(subject));
        let rows: Vec<&CostRow> =
            front(&sweep.rows, subject, analytic).into_iter().filter(|row| row.rms >= LEAST).collect();
        if rows.is_empty() {
            continue;
        }
        let at: Vec<(f64, f64)> = rows.iter().map(|row| (row.seconds, row.rms)).collect();
        places.extend_from_slice(&at);
        names.extend(rows.iter().map(|row| {
            let key = row.knob.rsplit('.').next().unwrap_or_default();
            format!("{key} {}", row.setting.replace(" voxels", "").replace(" voxel", ""))
        }));
        let line = LinePlot::new().with_data(at.clone()).with_color(color).with_stroke_width(8.0).with_legend(legend);
        let discs = ScatterPlot::new().with_data(at).with_color(color).with_size(9.0);
        lines.extend([Plot::Line(line), Plot::Scatter(discs)]);
    }
    // No setting lies to the lower left of a front's point. Where fronts cross or are flat, names are pushed apart.
    let (style, size) = if are_apart(&places, &names, reaches) {
        // The marker is so large that no line leads from it to its name.
        (LabelStyle::Arrow { offset_x: -BELOW[0], offset_y: -BELOW[1] }, BELOW[0].hypot(BELOW[1]))
    } else {
        (LabelStyle::Repel, 9.0)
    };
    let named = ScatterPlot::new().with_data(places).with_size(size).with_marker_opacity(0.0);
    (lines, Plot::Scatter(named.with_labels(names).with_label_style(style)))
}

/// Whether names that end at points do not overlap, on axes with these ranges.
fn are_apart(places: &[(f64, f64)], names: &[String], [times, errors]: [[f64; 2]; 2]) -> bool {
    let units = |x: f64, [lo, hi]: [f64; 2], span: f64| ln(x / lo) / ln(hi / lo).max(ln(2.0)) * span;
    let ends: Vec<f64> = places.iter().map(|place| units(place.0, times, SPAN[0])).collect();
    let lines: Vec<f64> = places.iter().map(|place| units(place.1, errors, SPAN[1])).collect();
    let starts: Vec<f64> = ends.iter().zip(names).map(|(end, n)| end - LETTER[0] * n.chars().count() as f64).collect();
    (0..names.len())
        .all(|i| (0..i).all(|j| starts[i] > ends[j] || starts[j] > ends[i] || (lines[i] - lines[j]).abs() > LETTER[1]))
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
    fn every_knob_has_a_place_and_the_front_has_names() {
        let rows = vec![
            row("sampling.step", "4 voxels", 0.01, 0.5),
            row("sampling.step", "1 voxel", 0.1, 0.05),
            row("sampling.kernel", "slow and bad", 0.2, 0.4),
            row("sampling.kernel", "its own truth", 0.3, 0.0),
        ];
        let text = svg(&sweep(rows), "a <scene>").unwrap();
        for part in
            ["sampling.step *", "sampling.kernel *", ">step 4<", ">step 1<", "Pareto front *", "a &lt;scene&gt;"]
        {
            assert!(text.contains(part), "{part}\n{text}");
        }
        assert!(!text.contains("slow and bad") && !text.contains("its own truth"));
        let bytes = png(&sweep(vec![row("sampling.step", "4 voxels", 0.01, 0.5)]), "a").unwrap();
        assert!(bytes.starts_with(b"\x89PNG"));
    }

    #[test]
    fn names_stand_beside_their_places_where_there_is_room() {
        let names = ["a name".to_owned(), "another".to_owned()];
        let apart = |places: [(f64, f64); 2]| are_apart(&places, &names, [[1.0, 100.0], [0.01, 1.0]]);
        // A steep front, names side by side, and names that would cover each other.
        assert!(apart([(1.0, 1.0), (1.1, 0.01)]) && apart([(1.0, 1.0), (100.0, 1.0)]));
        assert!(!apart([(1.0, 1.0), (1.1, 0.9)]) && !apart([(1.0, 1.0); 2]));
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
