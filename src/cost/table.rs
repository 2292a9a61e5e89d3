//! Tables of sweeps: CSV and Markdown.

use super::variant::{FEW, LONG};
use super::{CostRow, ErrorSubject, Sweep, front};

/// Columns of the CSV, a documented format.
const COLUMNS: &str = "knob,setting,rms,max,flip,seconds,spread,samples,bytes,truth,angle";

/// Returns a line with names, then one line for each setting. Numbers have all significant digits.
pub fn csv(sweep: &Sweep) -> String {
    let mut text = format!("{COLUMNS}\n");
    for row in &sweep.rows {
        let CostRow { rms, max, flip, seconds, spread, samples, bytes, .. } = row;
        let [knob, setting, truth] = [&row.knob, &row.setting, &row.truth.to_string()].map(|cell| quoted(cell));
        let angle = row.angle.map(|degrees| format!("{degrees:e}")).unwrap_or_default();
        text += &format!(
            "{knob},{setting},{rms:e},{max:e},{flip:e},{seconds},{spread},{samples},{bytes},{truth},{angle}\n"
        );
    }
    text
}

/// Returns a cell, quoted if it has a comma, a quote or a line break.
fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell.into() }
}

/// Returns a table for people. The scene's own settings are bold; Pareto-optimal ones have a dot.
pub fn markdown(sweep: &Sweep) -> String {
    let Sweep { size: [width, height], runs, threads, .. } = sweep;
    let of_strokes = sweep.rows.iter().any(|row| row.subject == ErrorSubject::Strokes);
    let voxels = if of_strokes { " RMS and max of strokes are in voxels." } else { "" };
    let has_angles = sweep.rows.iter().any(|row| row.angle.is_some());
    let [angle, angle_rule] = if has_angles { [" angle |", "--:|"] } else { [""; 2] };
    let is_long =
        sweep.rows.iter().any(|row| row.subject != ErrorSubject::Picture && row.seconds > LONG) && *runs > FEW;
    let few = if is_long { format!(", of {FEW} where a page takes more than {LONG} s") } else { String::new() };
    let mut text = format!(
        "{width} × {height} pixels, {threads} threads, medians of {runs} runs{few}. **Bold**: what the scene says; ●: no \
         other setting with the same truth has less error in less time.{voxels}\n\n\
         | knob | setting | RMS | max | FLIP |{angle} ms | spread | samples | MB | truth |\n\
         |---|---|--:|--:|--:|{angle_rule}--:|--:|--:|--:|---|\n"
    );
    let mut last = "";
    for row in &sweep.rows {
        let knob = if row.knob == last { String::new() } else { format!("`{}`", row.knob) };
        last = &row.knob;
        let setting = if row.own { format!("**{}**", row.setting) } else { row.setting.clone() };
        let dot = if front(&sweep.rows, row).iter().any(|best| std::ptr::eq(*best, row)) { " ●" } else { "" };
        let [rms, max, flip] = [row.rms, row.max, row.flip].map(error);
        let [ms, spread] = [row.seconds, row.spread].map(|seconds| format!("{:.1}", seconds * 1e3));
        let (samples, megabytes) = (count(row.samples), row.bytes as f64 / 1e6);
        let truth = row.truth.to_string();
        let angle = match row.angle {
            Some(degrees) => format!(" {}° |", error(degrees)),
            None if has_angles => " |".into(),
            None => String::new(),
        };
        text += &format!(
            "| {knob} | {setting}{dot} | {rms} | {max} | {flip} |{angle} {ms} | {spread} | {samples} | {megabytes:.1} | {truth} |\n"
        );
    }
    text
}

/// Returns two significant digits.
fn error(x: f64) -> String {
    if x == 0.0 { "0".into() } else { format!("{x:.1e}") }
}

/// Returns a count in thousands or millions.
fn count(n: u64) -> String {
    match n {
        0..10_000 => n.to_string(),
        10_000..10_000_000 => format!("{:.0} k", n as f64 / 1e3),
        _ => format!("{:.1} M", n as f64 / 1e6),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Truth;
    use super::*;

    fn sweep() -> Sweep {
        let row = CostRow {
            knob: "sampling.step".into(),
            subject: ErrorSubject::Picture,
            setting: "2 voxels".into(),
            own: false,
            rms: 0.0123,
            max: 0.5,
            flip: 0.001,
            angle: None,
            seconds: 0.0125,
            spread: 0.0005,
            samples: 123_456,
            bytes: 2_600_000,
            truth: Truth::Analytic,
        };
        let fine = CostRow {
            setting: "1 voxel".into(),
            own: true,
            rms: 0.0,
            truth: Truth::Finest("a, b".into()),
            ..row.clone()
        };
        Sweep { rows: vec![row, fine], left_out: Vec::new(), runs: 3, threads: 2, size: [32, 24] }
    }

    #[test]
    fn as_csv() {
        let expected = "knob,setting,rms,max,flip,seconds,spread,samples,bytes,truth,angle\n\
             sampling.step,2 voxels,1.23e-2,5e-1,1e-3,0.0125,0.0005,123456,2600000,analytic,\n\
             sampling.step,1 voxel,0e0,5e-1,1e-3,0.0125,0.0005,123456,2600000,\"finest: a, b\",\n";
        assert_eq!(csv(&sweep()), expected);
    }

    #[test]
    fn as_markdown() {
        let text = markdown(&sweep());
        let lines: Vec<&str> = text.lines().skip(2).collect();
        assert!(text.starts_with("32 × 24 pixels, 2 threads, medians of 3 runs."));
        assert_eq!(
            lines[2],
            "| `sampling.step` | 2 voxels ● | 1.2e-2 | 5.0e-1 | 1.0e-3 | 12.5 | 0.5 | 123 k | 2.6 | analytic |"
        );
        assert_eq!(lines[3], "|  | **1 voxel** ● | 0 | 5.0e-1 | 1.0e-3 | 12.5 | 0.5 | 123 k | 2.6 | finest: a, b |");
    }

    /// Strokes have an angle, and what takes long fewer runs.
    #[test]
    fn strokes_have_a_column_more() {
        let mut sweep = Sweep { runs: 5, ..sweep() };
        let stroke =
            CostRow { subject: ErrorSubject::Strokes, angle: Some(0.25), seconds: 3.0, ..sweep.rows[0].clone() };
        sweep.rows.push(stroke);
        assert!(csv(&sweep).ends_with(",analytic,2.5e-1\n"));
        let text = markdown(&sweep);
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines[0].contains("medians of 5 runs, of 3 where a page takes more than 2 s."), "{text}");
        assert!(lines[2].contains("| FLIP | angle | ms |") && lines[3].matches('|').count() == 12, "{text}");
        assert!(
            lines[4].contains("| 1.0e-3 | | 12.5 |") && lines[6].contains("| 1.0e-3 | 2.5e-1° | 3000.0 |"),
            "{text}"
        );
    }

    #[test]
    fn counts_are_short() {
        assert_eq!([0, 9_999, 10_000, 12_345_678].map(count), ["0", "9999", "10 k", "12.3 M"]);
    }
}
