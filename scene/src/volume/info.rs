//! The report of `info` about a volume file.

use super::Volume;
use super::bricked::{BrickCensus, SIDE};
use super::histogram::{Histogram, quantiles};
use crate::math;
use serde::Serialize;
use std::fmt;
use std::path::Path;

/// Bins of the histogram.
const BINS: usize = 64;

/// The percentiles of the report.
const PERCENTS: [f64; 9] = [1.0, 5.0, 10.0, 25.0, 50.0, 75.0, 90.0, 95.0, 99.0];

/// A volume in numbers. Values are after slope and intercept ([VAL-1]); lengths are in the file's own world units.
/// `Display` prints the report for a person. Serialized, it is the object of `--json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Info {
    /// The file, as it was named.
    pub file: String,
    /// Voxels along x, y, z.
    pub dims: [usize; 3],
    /// Stored type: `u8`, `f32`, …
    #[serde(rename = "type")]
    pub voxel_type: &'static str,
    /// Norms of the columns of D.
    pub spacing: [f64; 3],
    /// The columns of D: direction times spacing of each axis ([SPACE-2]).
    pub axes: [[f64; 3]; 3],
    /// World position of voxel (0, 0, 0).
    pub origin: [f64; 3],
    /// The anatomical space that the file names, such as `left-posterior-superior`.
    pub anatomy: Option<&'static str>,
    /// Lowest and highest finite value.
    pub range: [f64; 2],
    /// Voxels that are NaN or ±∞ in the file ([PREC-2]).
    pub invalid: usize,
    /// Value = slope · stored + intercept.
    pub slope: f64,
    /// Value = slope · stored + intercept.
    pub intercept: f64,
    /// Bytes of the voxels in memory.
    pub bytes: usize,
    /// The bricks of a selection volume with these voxels ([VS-1]).
    pub bricks: BrickCensus,
    /// Counts of the finite values in 64 equal bins over their range.
    pub histogram: Histogram,
    /// Quantiles of the finite values, ascending ([VAL-2]).
    pub percentiles: Vec<Percentile>,
}

/// A quantile of the values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Percentile {
    /// The share of the values that are at most `value`, in percent.
    pub percent: f64,
    /// The value.
    pub value: f64,
}

impl Info {
    /// The numbers of a volume that came from a file.
    pub fn new(file: &Path, volume: &Volume) -> Self {
        let grid = volume.grid();
        let values = quantiles(volume, &PERCENTS.map(|percent| percent / 100.0));
        Self {
            file: file.display().to_string(),
            dims: grid.dims(),
            voxel_type: volume.voxels().voxel_type().name(),
            spacing: grid.spacing(),
            axes: grid.axes().to_cols_array_2d(),
            origin: grid.origin().to_array(),
            anatomy: volume.anatomy().map(|anatomy| anatomy.name()),
            range: volume.range(),
            invalid: volume.mask().map_or(0, |mask| mask.count()),
            slope: volume.slope(),
            intercept: volume.intercept(),
            bytes: volume.voxels().bytes(),
            bricks: BrickCensus::new(volume),
            histogram: Histogram::new(volume, BINS),
            percentiles: PERCENTS
                .into_iter()
                .zip(values)
                .map(|(percent, value)| Percentile { percent, value })
                .collect(),
        }
    }
}

impl fmt::Display for Info {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let row = |numbers: [f64; 3]| numbers.map(short).join("  ");
        let [nx, ny, nz] = self.dims;
        writeln!(f, "file       {}", self.file)?;
        writeln!(f, "dims       {nx} × {ny} × {nz}")?;
        writeln!(f, "type       {}, {}", self.voxel_type, size(self.bytes))?;
        writeln!(f, "spacing    {}", row(self.spacing))?;
        for (name, axis) in ["axis x", "axis y", "axis z"].into_iter().zip(self.axes) {
            writeln!(f, "{name}     {}", row(axis))?;
        }
        writeln!(f, "origin     {}", row(self.origin))?;
        writeln!(f, "world      {}", self.anatomy.unwrap_or("not anatomical, or not said"))?;
        if self.slope != 1.0 || self.intercept != 0.0 {
            writeln!(f, "value      {} · stored + {}", short(self.slope), short(self.intercept))?;
        }
        writeln!(f, "range      {} … {}", short(self.range[0]), short(self.range[1]))?;
        writeln!(f, "invalid    {} (NaN or infinite)", self.invalid)?;
        let BrickCensus { count, distinct, bytes } = self.bricks;
        writeln!(f, "bricks     {count} of {SIDE}³ voxels, {distinct} distinct, {}", size(bytes))?;
        writeln!(f, "histogram  {}", bars(&self.histogram.bins))?;
        writeln!(f, "           log of the counts in {BINS} bins over the range")?;
        let percentiles: Vec<String> =
            self.percentiles.iter().map(|p| format!("{} %: {}", p.percent, short(p.value))).collect();
        write!(f, "quantiles  {}", percentiles.join("  "))
    }
}

/// Six significant digits at the most, no zeros at the end.
pub fn short(number: f64) -> String {
    let magnitude = number.abs();
    if magnitude != 0.0 && !(1e-4..1e9).contains(&magnitude) {
        return format!("{number:.5e}");
    }
    let decimals = [1e5, 1e4, 1e3, 1e2, 1e1, 1e0].iter().filter(|&&limit| magnitude < limit).count();
    let text = format!("{number:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_string(),
        false => text,
    }
}

fn size(bytes: usize) -> String {
    match bytes {
        0..10_000 => format!("{bytes} B"),
        10_000..1_000_000 => format!("{:.1} kB", bytes as f64 / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", bytes as f64 / 1e6),
        _ => format!("{:.1} GB", bytes as f64 / 1e9),
    }
}

/// One character a bin, whose height shows the logarithm of the count. An empty bin is a blank.
fn bars(counts: &[u64]) -> String {
    const HEIGHTS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
    let height = |count: u64| math::ln_1p(count as f64);
    let highest = counts.iter().copied().max().map_or(0.0, height);
    let bar = |&count: &u64| match count {
        0 => HEIGHTS[0],
        _ => HEIGHTS[((height(count) / highest * 8.0).ceil() as usize).clamp(1, 8)],
    };
    counts.iter().map(bar).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Grid;
    use crate::volume::{Anatomy, Voxels};

    fn info() -> Info {
        let grid = Grid::with_spacing([2, 2, 2], [0.5, 1.0, 2.25]).unwrap();
        let stored = vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, f32::NAN];
        let volume = Volume::new(grid, Voxels::F32(stored), 2.0, -1000.0).unwrap();
        Info::new(Path::new("head.nii"), &volume.with_anatomy(Some(Anatomy::RightAnteriorSuperior)))
    }

    #[test]
    fn the_object_has_the_names_that_scripts_read() {
        let json = serde_json::to_value(info()).unwrap();
        assert_eq!(json["type"], "f32");
        assert_eq!(json["dims"], serde_json::json!([2, 2, 2]));
        assert_eq!(json["axes"][2], serde_json::json!([0.0, 0.0, 2.25]));
        assert_eq!(json["anatomy"], "right-anterior-superior");
        assert_eq!(json["range"], serde_json::json!([-1000.0, -988.0]));
        assert_eq!((&json["invalid"], &json["bytes"]), (&1.into(), &32.into()));
        assert_eq!(json["histogram"]["bins"].as_array().unwrap().len(), 64);
        assert_eq!(json["percentiles"][4], serde_json::json!({ "percent": 50.0, "value": -994.0 }));
    }

    #[test]
    fn what_a_person_reads() {
        let text = info().to_string();
        for line in [
            "dims       2 × 2 × 2",
            "type       f32, 32 B",
            "spacing    0.5  1  2.25",
            "axis z     0  0  2.25",
            "world      right-anterior-superior",
            "value      2 · stored + -1000",
            "range      -1000 … -988",
            "bricks     1 of 16³ voxels, 1 distinct, 16.4 kB",
            "invalid    1 (NaN or infinite)",
        ] {
            assert!(text.lines().any(|l| l == line), "{line:?} in\n{text}");
        }
        assert!(text.lines().all(|l| l.chars().count() < 120));
    }

    #[test]
    fn numbers_are_short_but_not_wrong() {
        let cases = [(0.0, "0"), (1.0, "1"), (-1024.0, "-1024"), (2.007843, "2.00784"), (123456.7, "123457")];
        for (number, text) in cases {
            assert_eq!(short(number), text);
        }
        assert_eq!([short(1e-9), short(2.5e12)], ["1.00000e-9", "2.50000e12"]);
        assert_eq!(bars(&[0, 1, 1000]), " ▁█");
        assert_eq!(size(16_777_216), "16.8 MB");
    }
}
