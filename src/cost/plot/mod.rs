//! Plots of sweeps ([COST-1]): a panel for each knob, error against time on two logarithmic axes that all panels share.
//! Each setting is labelled. Settings without error stand on the floor under an arrow. Settings of other knobs with the
//! same truth and the Pareto front are drawn in pale colours behind.

mod labels;

use super::front::{front, have_one_truth};
use super::{CostRow, ErrorSubject, Sweep, Truth};
use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::plot::LinePlot;
use kuva::plot::scatter::{MarkerShape, ScatterPlot};
use kuva::render::annotations::{ReferenceLine, TextAnnotation};
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
const OTHERS: &str = "#a8a8a8";

/// Smallest error and time on a logarithmic axis. A smaller error is none.
const LEAST: f64 = 1e-9;

/// Largest number of panels in a row, width and height of a panel, and its margins: left, top, right and bottom. All
/// lengths are in the plot's units.
const COLUMNS: usize = 3;
const PANEL: [f64; 2] = [400.0, 330.0];
const MARGINS: [f64; 4] = [52.0, 52.0, 12.0, 48.0];

/// Length of the arrow to a setting without error, and the distance of its head from the axis.
const ARROW: f64 = 16.0;
const HEAD: f64 = 5.0;

/// Distance between a label and its point above which a line joins them.
const NEAR: f64 = 16.0;

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
    let shown: Vec<&CostRow> = sweep.rows.iter().filter(|row| row.seconds >= LEAST).collect();
    let axes = Axes::of(&shown).ok_or("there is nothing to plot: no setting has an error")?;
    // Rows of a knob stand together. A single one compares nothing.
    let knobs: Vec<&[&CostRow]> = shown.chunk_by(|a, b| a.knob == b.knob).filter(|knob| knob.len() > 1).collect();
    let columns = knobs.len().min(COLUMNS);
    let plots = knobs.iter().map(|knob| panel(sweep, &axes, knob)).collect();
    let layouts = knobs.iter().map(|knob| layout(sweep, &axes, knob)).collect();
    let of_picture = shown.iter().any(|row| row.subject == ErrorSubject::Picture);
    let [width, height] = sweep.size;
    let what = if of_picture { "a frame" } else { "a page, from the voxels on," };
    let runs = sweep.runs;
    let title =
        format!("{name}: error against the time of {what} of {width} × {height} pixels, medians of {runs} runs");
    let figure = Figure::new(knobs.len().div_ceil(columns.max(1)), columns)
        .with_structure((0..knobs.len()).map(|i| vec![i]).collect())
        .with_plots(plots)
        .with_layouts(layouts)
        .with_cell_size(PANEL[0], PANEL[1])
        .with_spacing(10.0)
        .with_title(title)
        .with_title_size(17);
    Ok(figure.render())
}

/// The axes of all panels: ends of time in seconds and of error, both logarithmic.
struct Axes {
    times: [f64; 2],
    errors: [f64; 2],
}

impl Axes {
    /// Returns axes with space around rows and, below the least error, for those without; none if no row has an error.
    fn of(rows: &[&CostRow]) -> Option<Self> {
        let ends = |of: &dyn Fn(&CostRow) -> f64| {
            let values = rows.iter().map(|row| of(row)).filter(|x| *x >= LEAST);
            values.fold([f64::INFINITY, 0.0], |[lo, hi], x| [lo.min(x), hi.max(x)])
        };
        let [times, errors] = [ends(&|row| row.seconds), ends(&|row| row.rms)];
        let floor = if rows.iter().any(|row| row.rms < LEAST) { 12.0 } else { 2.5 };
        (errors[1] > 0.0)
            .then(|| Self { times: [times[0] / 1.5, times[1] * 1.5], errors: [errors[0] / floor, errors[1] * 2.5] })
    }

    /// The area of the data in a panel: left, top, right and bottom.
    fn area() -> labels::Area {
        [MARGINS[0], MARGINS[1], PANEL[0] - MARGINS[2], PANEL[1] - MARGINS[3]]
    }

    /// Returns the point of a row in a panel. A row without error stands on the floor.
    fn point(&self, row: &CostRow) -> [f64; 2] {
        let [left, top, right, bottom] = Self::area();
        let share = |x: f64, [lo, hi]: [f64; 2]| (x / lo).ln() / (hi / lo).ln();
        let down = if row.rms < LEAST { HEAD } else { share(row.rms, self.errors) * (bottom - top) };
        [left + share(row.seconds, self.times) * (right - left), bottom - down]
    }

    /// Returns time and error at a point of a panel.
    fn values(&self, [x, y]: [f64; 2]) -> (f64, f64) {
        let [left, top, right, bottom] = Self::area();
        let at = |share: f64, [lo, hi]: [f64; 2]| lo * (hi / lo).powf(share);
        (at((x - left) / (right - left), self.times), at((bottom - y) / (bottom - top), self.errors))
    }
}

/// Returns axes, title and labels of a knob's panel.
fn layout(sweep: &Sweep, axes: &Axes, knob: &[&CostRow]) -> Layout {
    let first = knob[0];
    let unit = if knob.iter().any(|row| row.setting.ends_with(VOXELS)) { " in voxels" } else { "" };
    let of = match first.subject {
        ErrorSubject::Picture => "RMS error",
        ErrorSubject::Dots => "RMS error of tone",
        ErrorSubject::Strokes => "RMS distance in voxels",
    };
    let truth = match &first.truth {
        Truth::Analytic => "the formula".into(),
        Truth::Finest(setting) => format!("{:?}", setting.trim_end_matches(VOXELS)),
    };
    let (times, errors) = (axes.times, axes.errors);
    let mut layout = Layout::new((times[0], times[1]), (errors[0], errors[1]))
        .with_log_scale()
        .with_x_axis_min(times[0])
        .with_x_axis_max(times[1])
        .with_y_axis_min(errors[0])
        .with_y_axis_max(errors[1])
        .with_force_margins(MARGINS[0], MARGINS[2])
        .with_force_margins_y(MARGINS[1], MARGINS[3])
        .with_x_tick_format(TickFormat::Custom(Arc::new(time)))
        .with_y_tick_format(TickFormat::Custom(Arc::new(|error| format!("{error:.0e}"))))
        .with_x_label("time")
        .with_title(format!("{}{unit}", first.knob))
        .with_title_size(14)
        // The name of the upright axis lies over it: kuva's turned text is hard to read in pixels.
        .with_subtitle(format!("{of}, against {truth}"))
        .with_subtitle_size(12)
        .with_label_size(12)
        .with_body_size(labels::SIZE)
        .with_tick_size(10);
    if let Some(own) = sweep.rows.iter().find(|row| row.own) {
        layout = layout.with_reference_line(ReferenceLine::vertical(own.seconds).with_color("#888888"));
    }
    for (text, _, area) in named(axes, knob) {
        // The text's baseline lies six units above the place of an annotation.
        let (x, y) = axes.values([(area[0] + area[2]) / 2.0, area[3] + 3.0]);
        layout = layout.with_annotation(TextAnnotation::new(text, x, y).with_font_size(labels::SIZE));
    }
    layout
}

/// Returns the label of each setting of a knob, its point, and the label's area. The unit stands in the title, and
/// brackets mark what the scene says.
fn named(axes: &Axes, knob: &[&CostRow]) -> Vec<(String, [f64; 2], labels::Area)> {
    let texts: Vec<(String, [f64; 2])> = knob
        .iter()
        .map(|row| {
            let name = row.setting.trim_end_matches(VOXELS).trim_end_matches(" voxel");
            (if row.own { format!("[{name}]") } else { name.into() }, axes.point(row))
        })
        .collect();
    // No label covers a point or the shaft of an arrow.
    let covered: Vec<[f64; 2]> = knob
        .iter()
        .flat_map(|row| {
            let [x, y] = axes.point(row);
            [
                Some([x, y]),
                (row.rms < LEAST).then_some([x, y - ARROW / 2.0]),
                (row.rms < LEAST).then_some([x, y - ARROW]),
            ]
        })
        .flatten()
        .collect();
    let areas = labels::places(&texts, &covered, Axes::area());
    texts.into_iter().zip(areas).map(|((text, point), area)| (text, point, area)).collect()
}

/// Returns the plots of a knob's panel, from back to front.
fn panel(sweep: &Sweep, axes: &Axes, knob: &[&CostRow]) -> Vec<Plot> {
    let places = |rows: &[&CostRow]| rows.iter().map(|row| axes.values(axes.point(row))).collect::<Vec<_>>();
    let line = |places: Vec<(f64, f64)>, color: &str, width| {
        Plot::Line(LinePlot::new().with_data(places).with_color(color).with_stroke_width(width))
    };
    let dots = |rows: &[&CostRow], color: &str, size| {
        ScatterPlot::new().with_data(places(rows)).with_color(color).with_size(size)
    };
    // The front of the knob's truth, and the other knobs with this truth.
    let best: Vec<&CostRow> = front(&sweep.rows, knob[0]).into_iter().filter(|row| row.seconds >= LEAST).collect();
    let others: Vec<&CostRow> =
        sweep.rows.iter().filter(|row| have_one_truth(row, knob[0]) && row.knob != knob[0].knob).collect();
    let mut plots = vec![
        line(places(&best), FRONT, 7.0),
        Plot::Scatter(dots(&best, FRONT, 7.0)),
        Plot::Scatter(dots(&others, OTHERS, 2.5)),
    ];
    // Numbers are joined in their order. Kinds have none.
    let mut numbers: Vec<(f64, &CostRow)> =
        knob.iter().filter(|row| row.rms >= LEAST).filter_map(|row| Some((number(&row.setting)?, *row))).collect();
    numbers.sort_by(|a, b| a.0.total_cmp(&b.0));
    let numbers: Vec<&CostRow> = numbers.into_iter().map(|(_, row)| row).collect();
    plots.push(line(places(&numbers), OWN, 1.2));
    // Leader lines of labels that had to go aside.
    for (_, [x, y], area) in named(axes, knob) {
        let near = [x.clamp(area[0], area[2]), y.clamp(area[1], area[3])];
        if (near[0] - x).hypot(near[1] - y) > NEAR {
            plots.push(line(vec![axes.values([x, y]), axes.values(near)], OTHERS, 0.8));
        }
    }
    // The settings: points with the spread of their time, and arrows to those without error.
    let (exact, apart): (Vec<&CostRow>, Vec<&CostRow>) = knob.iter().copied().partition(|row| row.rms < LEAST);
    for row in &exact {
        let [x, y] = axes.point(row);
        plots.push(line(vec![axes.values([x, y - ARROW]), axes.values([x, y])], OWN, 1.6));
    }
    plots.push(Plot::Scatter(dots(&exact, OWN, 4.0).with_marker(MarkerShape::TriangleDown)));
    plots.push(Plot::Scatter(dots(&apart, OWN, 3.5).with_x_err(apart.iter().map(|row| row.spread / 2.0))));
    plots
}

/// Returns the number of a setting, before its unit; none for a kind.
fn number(setting: &str) -> Option<f64> {
    setting.split(' ').next()?.parse().ok()
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
    fn every_setting_and_every_axis_has_a_name() {
        let rows = vec![
            row("sampling.step", "4 voxels", 0.01, 0.5),
            row("sampling.step", "1 voxel", 0.1, 0.05),
            row("sampling.kernel", "slow and bad", 0.2, 0.4),
            row("sampling.kernel", "its own truth", 0.3, 0.0),
            row("sampling.number", "f32", 0.2, 1e-6),
            row("sampling.number", "f64", 0.1, 0.0),
            row("picture.samples", "alone", 0.9, 0.01),
        ];
        let text = svg(&sweep(rows), "a <scene>").unwrap();
        for (part, times) in [
            ("sampling.step in voxels", 1),
            ("sampling.kernel", 1),
            (">[4]<", 1),
            (">1<", 1),
            (">slow and bad<", 1),
            (">its own truth<", 1),
            (">f32<", 1),
            (">f64<", 1),
            ("a &lt;scene&gt;: error against the time of a frame", 1),
            // Three panels have two axes each; a knob with one setting has none.
            (">time<", 3),
            (">RMS error, against &quot;f&quot;<", 3),
            ("picture.samples", 0),
            // One format of errors, with the same ticks in each panel.
            (">1e-3<", 3),
            (">0.1<", 0),
        ] {
            assert_eq!(text.matches(part).count(), times, "{part}\n{text}");
        }
        let two = vec![row("sampling.step", "4 voxels", 0.01, 0.5), row("sampling.step", "1 voxel", 0.1, 0.05)];
        assert!(png(&sweep(two), "a").unwrap().starts_with(b"\x89PNG"));
    }

    /// The floor is below every error, and places and values are inverse.
    #[test]
    fn a_setting_without_error_stands_on_the_floor() {
        let rows = [row("k", "a", 0.01, 0.5), row("k", "b", 0.1, 1e-6), row("k", "c", 1.0, 0.0)];
        let axes = Axes::of(&rows.iter().collect::<Vec<_>>()).unwrap();
        let [a, b, c] = rows.each_ref().map(|row| axes.point(row));
        assert!(a[1] < b[1] && b[1] + ARROW + HEAD < c[1] && c[1] == Axes::area()[3] - HEAD, "{a:?} {b:?} {c:?}");
        let (seconds, error) = axes.values(b);
        assert!((seconds / 0.1 - 1.0).abs() < 1e-12 && (error / 1e-6 - 1.0).abs() < 1e-12);
        assert!(Axes::of(&[&rows[2]]).is_none());
    }

    #[test]
    fn kinds_have_no_numbers() {
        assert_eq!(["0.5 voxels", "1 voxel", "64", "1e-3"].map(number), [0.5, 1.0, 64.0, 1e-3].map(Some));
        assert_eq!(["auto", "exact", "bspline5", "true", "f32"].map(number), [None; 5]);
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
