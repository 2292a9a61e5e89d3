//! Tone: the share of the paper that dots cover, and the number of dots that a wanted coverage takes ([STIP-17]).
//!
//! Dots of the area a at the density λ cover a share of the paper between 1 − e^(−λa), if they lie at random, and
//! min(1, λa), if none overlap. Evenly spread dots lie between; `IDEAL` holds the coverage of discs of blue noise. A
//! pen prints more or less than its discs. Its coverage is measured on a step wedge, a table of wanted and measured
//! coverage. The inverse of that table gives the coverage to ask for.

use crate::math::pow;
use crate::memory;
use crate::source::Source;
use std::path::{Path, PathBuf};

/// Coverage of evenly spread discs at λa = 0, ⅛, ¼, …: measured on samples of the page's own elimination.
const IDEAL: [f64; 17] = [
    0.0, 0.125, 0.2499, 0.3746, 0.4966, 0.6064, 0.6980, 0.7717, 0.8298, 0.8745, 0.9087, 0.9345, 0.9537, 0.9677, 0.9776,
    0.9845, 0.9893,
];

/// λa between two entries of [`IDEAL`].
const STEP: f64 = 0.125;

/// The coverage that T = 1 stands for where tone is asked for. Closing the last gaps beyond this coverage takes many
/// dots.
pub const FULL: f64 = 0.9;

/// The tone curve of a pen on its paper: printed coverage over wanted coverage.
#[derive(Clone, Debug, PartialEq)]
pub struct Tone {
    /// Wanted and measured coverage: the first ascends, the second does not descend.
    rows: Vec<[f64; 2]>,
}

/// A fault of a step wedge.
#[derive(Debug, thiserror::Error)]
pub enum ToneError {
    /// The file cannot be read.
    #[error("the step wedge cannot be read: {source}")]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// A line is no row of a step wedge.
    #[error("{fault}")]
    Row {
        /// The file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: u64,
        /// The fault.
        fault: String,
    },
}

impl ToneError {
    /// The file, and the line if it is known.
    pub fn place(&self) -> String {
        match self {
            Self::Io { path, .. } => path.display().to_string(),
            Self::Row { path, line, .. } => format!("{}, line {line}", path.display()),
        }
    }
}

impl Tone {
    /// A pen whose dots are discs of its nib. Printed coverage is wanted coverage.
    pub fn ideal() -> Self {
        Self { rows: vec![[0.0, 0.0], [1.0, 1.0]] }
    }

    /// The curve through rows of wanted and measured coverage. A measured value lower than one before it is pooled:
    /// both become their mean (the pool of adjacent violators). More wanted coverage then never prints less.
    ///
    /// # Errors
    /// The number of a row, from 0, and its fault: a number outside [0, 1], or a wanted coverage that does not ascend.
    /// If there are fewer than two rows, the row after the last is reported.
    pub fn from_rows(rows: &[[f64; 2]]) -> Result<Self, (usize, String)> {
        for (i, row) in rows.iter().enumerate() {
            if let Some(x) = row.iter().find(|x| !(0.0..=1.0).contains(*x)) {
                return Err((i, format!("found {x}, expected a coverage from 0 to 1")));
            }
            if i > 0 && row[0] <= rows[i - 1][0] {
                return Err((i, format!("found {} after {}: wanted tones ascend", row[0], rows[i - 1][0])));
            }
        }
        if rows.len() < 2 {
            return Err((rows.len(), "a step wedge has two rows at least".into()));
        }
        // Blocks of equal numbers: how many, and their sum.
        let mut blocks: Vec<(usize, f64)> = Vec::new();
        for row in rows {
            let mut block = (1, row[1]);
            while let Some(&(count, sum)) = blocks.last()
                && sum / count as f64 > block.1 / block.0 as f64
            {
                block = (block.0 + count, block.1 + sum);
                blocks.pop();
            }
            blocks.push(block);
        }
        let even = blocks.iter().flat_map(|&(count, sum)| std::iter::repeat_n(sum / count as f64, count));
        let mut rows: Vec<[f64; 2]> = rows.iter().zip(even).map(|(row, measured)| [row[0], measured]).collect();
        if rows[0][0] > 0.0 {
            // Where nothing is drawn the paper is bare.
            rows.insert(0, [0.0, 0.0]);
        }
        Ok(Self { rows })
    }

    /// Reads a table with the columns `wanted` and `measured`. Rows that were not measured are passed over.
    ///
    /// # Errors
    /// [`ToneError`] with the line.
    pub fn read(source: &dyn Source, path: &Path) -> Result<Self, ToneError> {
        let bytes = memory::read(source, path).map_err(|source| ToneError::Io { path: path.into(), source })?;
        let fault = |line, fault: String| ToneError::Row { path: path.into(), line, fault };
        let mut table = csv::ReaderBuilder::new().flexible(true).from_reader(bytes.as_slice());
        let heads = table.headers().map_err(|error| fault(1, error.to_string()))?.clone();
        let column = |name: &str| {
            let found = heads.iter().position(|head| head.trim() == name);
            found.ok_or_else(|| fault(1, format!("the column {name:?} is not there")))
        };
        let columns = [column("wanted")?, column("measured")?];
        let (mut rows, mut lines) = (Vec::new(), Vec::new());
        for record in table.records() {
            let record = record.map_err(|error| {
                fault(error.position().map_or(1, csv::Position::line), "the line is no text".into())
            })?;
            let line = record.position().map_or(0, csv::Position::line);
            let cell = |column: usize| record.get(column).unwrap_or_default().trim();
            if cell(columns[1]).is_empty() {
                continue;
            }
            let number = |column: usize| {
                let text = cell(column);
                text.parse::<f64>().map_err(|_| fault(line, format!("found {text:?}, expected a coverage from 0 to 1")))
            };
            rows.push([number(columns[0])?, number(columns[1])?]);
            lines.push(line);
        }
        Self::from_rows(&rows).map_err(|(row, what)| {
            let after = lines.last().map_or(2, |line| line + 1);
            fault(lines.get(row).copied().unwrap_or(after), what)
        })
    }

    /// Wanted and measured coverage, in ascending order.
    pub fn rows(&self) -> &[[f64; 2]] {
        &self.rows
    }

    /// The coverage that the pen prints if `wanted` is asked for.
    pub fn printed(&self, wanted: f64) -> f64 {
        along(&self.rows, wanted, 0)
    }

    /// The coverage to ask for so that `coverage` is printed: the inverse of [`printed`](Self::printed). The result is
    /// the least of several, and the last row's if the pen prints less.
    pub fn asked(&self, coverage: f64) -> f64 {
        along(&self.rows, coverage, 1)
    }

    /// The coverage of evenly spread dots with `ink` = λa.
    pub fn coverage(&self, ink: f64) -> f64 {
        self.printed(ideal(ink))
    }

    /// The λa of evenly spread dots that give a coverage.
    pub fn ink(&self, coverage: f64) -> f64 {
        let asked = self.asked(coverage);
        let i = IDEAL.partition_point(|&c| c < asked).clamp(1, IDEAL.len() - 1);
        let share = (asked - IDEAL[i - 1]) / (IDEAL[i] - IDEAL[i - 1]);
        STEP * (i as f64 - 1.0 + share.clamp(0.0, 1.0))
    }
}

impl Tone {
    /// The coverage of evenly spread dots with `ink` = λa in independent layers: 1 − (1 − c)^layers, c the coverage of
    /// one layer.
    pub fn coverage_of_layers(&self, ink: f64, layers: f64) -> f64 {
        1.0 - pow(1.0 - self.coverage(ink / layers), layers)
    }

    /// The λa of dots in several layers that give a coverage.
    pub fn ink_of_layers(&self, coverage: f64, layers: f64) -> f64 {
        layers * self.ink(1.0 - pow((1.0 - coverage).max(0.0), 1.0 / layers))
    }
}

/// Coverage of evenly spread discs; beyond the table, its last entry.
fn ideal(ink: f64) -> f64 {
    let at = (ink / STEP).clamp(0.0, (IDEAL.len() - 1) as f64);
    let i = (at as usize).min(IDEAL.len() - 2);
    IDEAL[i] + (at - i as f64) * (IDEAL[i + 1] - IDEAL[i])
}

/// The other column at `x` in one, linear between rows and level beyond.
fn along(rows: &[[f64; 2]], x: f64, column: usize) -> f64 {
    let other = 1 - column;
    let i = rows.partition_point(|row| row[column] < x);
    if i == 0 {
        return rows[0][other];
    }
    if i == rows.len() {
        return rows[i - 1][other];
    }
    let (a, b) = (rows[i - 1], rows[i]);
    a[other] + (x - a[column]) / (b[column] - a[column]) * (b[other] - a[other])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Disk;

    /// The coverage lies between those of dots without overlap and of random places, and more ink never covers less.
    #[test]
    fn discs_cover_what_they_can() {
        for (i, pair) in IDEAL.windows(2).enumerate() {
            let ink = STEP * (i + 1) as f64;
            assert!(pair[0] < pair[1] && pair[1] <= ink.min(1.0) && pair[1] >= 1.0 - (-ink).exp(), "{ink}");
        }
        let tone = Tone::ideal();
        for k in 0..=95 {
            let wanted = f64::from(k) / 100.0;
            assert!((tone.coverage(tone.ink(wanted)) - wanted).abs() < 1e-12, "{wanted}");
        }
        // Two layers that cover 0.4966 each: 1 − 0.5034².
        assert!((tone.coverage_of_layers(1.0, 2.0) - 0.746_588_44).abs() < 1e-8);
        assert!((tone.ink_of_layers(0.746_588_44, 2.0) - 1.0).abs() < 1e-7);
        assert_eq!([tone.ink(0.0), tone.ink(1.0), tone.coverage(9.0)], [0.0, 2.0, 0.9893]);
    }

    #[test]
    fn hand_worked_inverse() {
        // Dots that print half as much again, up to 0.9.
        let gain = Tone::from_rows(&[[0.2, 0.3], [0.6, 0.9], [0.9, 0.9]]).unwrap();
        assert_eq!([gain.printed(0.1), gain.asked(0.15), gain.asked(0.6)].map(|x| (x * 1e9).round()), [15e7, 1e8, 4e8]);
        // The least that prints 0.9; more than the pen can is the most that was tried.
        assert_eq!([gain.asked(0.9), gain.asked(0.95)], [0.6, 0.9]);
        // 0.5 and 0.3 change places: both are 0.4.
        let rough = Tone::from_rows(&[[0.0, 0.0], [0.4, 0.5], [0.5, 0.3], [0.9, 0.9]]).unwrap();
        assert_eq!(rough.rows(), [[0.0, 0.0], [0.4, 0.4], [0.5, 0.4], [0.9, 0.9]]);
    }

    #[test]
    fn errors_name_the_line() {
        let folder = tempfile::tempdir().unwrap();
        let read = |text: &str| {
            let path = folder.path().join("wedge.csv");
            std::fs::write(&path, text).unwrap();
            Tone::read(&Disk, &path).map_err(|error| match error {
                ToneError::Row { line, fault, .. } => (line, fault),
                ToneError::Io { .. } => panic!("{error}"),
            })
        };
        assert_eq!(read("wanted,measured\n0.1,0.15\n0.3,\n0.5,0.7\n").unwrap().rows().len(), 3);
        for (text, line, fault) in [
            ("wanted,measured\n0.1,0.15\n0.2,much\n", 3, "found \"much\", expected a coverage from 0 to 1"),
            ("wanted,measured\n0.1,0.15\n0.2,1.5\n", 3, "found 1.5, expected a coverage from 0 to 1"),
            ("wanted,measured\n0.1,0.15\n0.1,0.2\n", 3, "found 0.1 after 0.1: wanted tones ascend"),
            ("wanted,measured\n0.1,NaN\n0.2,0.2\n", 2, "found NaN, expected a coverage from 0 to 1"),
            ("wanted,measured\n0.1,\n", 2, "a step wedge has two rows at least"),
            ("wanted\n0.1\n", 1, "the column \"measured\" is not there"),
        ] {
            assert_eq!(read(text).unwrap_err(), (line, fault.into()), "{text}");
        }
        assert!(matches!(Tone::read(&Disk, &folder.path().join("none.csv")), Err(ToneError::Io { .. })));
    }
}
