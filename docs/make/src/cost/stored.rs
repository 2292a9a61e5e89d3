//! Sweeps from the tables of `docs/cost-tables.md`, so that plots are drawn anew without measuring.

use drypoint::cost::{CostRow, ErrorSubject, Sweep, Truth};

/// Reads a sweep from its table, as [`drypoint::cost::markdown`] writes it. Its numbers have the table's digits, and
/// settings that were left out are not in it.
///
/// # Errors
/// A line that is no row of such a table.
pub(super) fn sweep(table: &str) -> Result<Sweep, String> {
    let mut lines = table.lines();
    let head = lines.next().unwrap_or_default();
    // "W × H pixels, N threads, medians of N runs": the first four numbers.
    let numbers: Vec<usize> = head.split([' ', '.', ',']).filter_map(|word| word.parse().ok()).take(4).collect();
    let [width, height, threads, runs] = numbers[..] else { return Err(format!("no head of a table: {head}")) };
    let mut rows: Vec<CostRow> = Vec::new();
    for line in lines.filter(|line| line.starts_with('|')).skip(2) {
        let row = row(line, rows.last()).ok_or_else(|| format!("no row of a table: {line}"))?;
        rows.push(row);
    }
    Ok(Sweep { rows, left_out: Vec::new(), runs, threads, size: [width, height] })
}

/// Reads a row; `before` is the row above, whose knob counts where the first cell is empty.
fn row(line: &str, before: Option<&CostRow>) -> Option<CostRow> {
    let mut cells: Vec<&str> = line.trim().trim_matches('|').split('|').map(str::trim).collect();
    // Strokes have an angle, in the sixth cell.
    let angle = if cells.len() == 11 { Some(cells.remove(5)) } else { None };
    let [knob, setting, rms, max, flip, ms, spread, samples, megabytes, truth] = cells[..] else { return None };
    let knob = if knob.is_empty() { before?.knob.clone() } else { knob.trim_matches('`').into() };
    let setting = setting.trim_end_matches(" ●");
    let subject = match (knob.starts_with("stipples"), angle) {
        (true, _) => ErrorSubject::Dots,
        (false, Some(_)) => ErrorSubject::Strokes,
        (false, None) => ErrorSubject::Picture,
    };
    let count = match samples.split_once(' ') {
        Some((n, "k")) => n.parse::<f64>().ok()? * 1e3,
        Some((n, _)) => n.parse::<f64>().ok()? * 1e6,
        None => samples.parse().ok()?,
    };
    Some(CostRow {
        knob,
        subject,
        setting: setting.trim_matches('*').into(),
        own: setting.starts_with("**"),
        rms: rms.parse().ok()?,
        max: max.parse().ok()?,
        flip: flip.parse().ok()?,
        angle: angle.and_then(|angle| angle.trim_end_matches('°').parse().ok()),
        seconds: ms.parse::<f64>().ok()? / 1e3,
        spread: spread.parse::<f64>().ok()? / 1e3,
        samples: count as u64,
        bytes: (megabytes.parse::<f64>().ok()? * 1e6) as u64,
        truth: match truth.strip_prefix("finest: ") {
            Some(setting) => Truth::Finest(setting.into()),
            None => Truth::Analytic,
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::{SCENES, part};
    use crate::files::in_docs;
    use drypoint::cost::markdown;

    /// The tables of the page are what is written of the sweeps that are read from them.
    #[test]
    fn a_table_is_that_of_its_sweep() {
        let page = std::fs::read_to_string(in_docs("cost-tables.md")).unwrap();
        for scene in &SCENES {
            let table = part(&page, &format!("<a id=\"{}\"></a>\n\n", scene.name), "\n## ").unwrap();
            assert_eq!(markdown(&sweep(&table).unwrap()).trim_end(), table.trim_end(), "{}", scene.name);
        }
        assert!(sweep("nothing").is_err());
    }
}
