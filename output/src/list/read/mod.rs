//! Reading of lists.

mod csv_rows;
mod json_rows;

use super::ListFormat;
use crate::OutputError;
use csv_rows::CsvRows;
use drypoint_scene::color::{Rgb, srgb_to_linear};
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Dot, Layer, Marks, Page, PageUnit, Pen, Polyline, Vertex};
use drypoint_scene::memory::Metered;
use json_rows::JsonRows;
use std::fs::File;
use std::io;
use std::path::Path;

/// The columns of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ListColumn {
    X,
    Y,
    Wx,
    Wy,
    Wz,
    Radius,
    Opacity,
    Stroke,
    T,
    Color,
    Pen,
}

impl ListColumn {
    const NAMES: [&str; 11] = ["x", "y", "wx", "wy", "wz", "radius", "opacity", "stroke", "t", "color", "pen"];

    fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// An error that ends reading.
enum RowError {
    /// The rest of the file cannot be read.
    File(io::Error),
    /// Column or character of a row, and the fault.
    Row(String, String),
}

impl RowError {
    fn at(self, path: &Path, line: u64) -> OutputError {
        match self {
            Self::File(source) => OutputError::Io { path: path.into(), action: "read", source },
            Self::Row(column, fault) => OutputError::List { path: path.into(), line, column, fault },
        }
    }
}

/// Rows of a file, read one after another.
trait RowReader {
    /// Reads the next row. Returns whether there is one.
    fn next(&mut self) -> Result<bool, RowError>;
    /// Returns the line number of the row, from 1. Before the first row, it is the header's line number.
    fn line(&self) -> u64;
    /// Whether the row has a column.
    fn has(&self, column: ListColumn) -> bool;
    /// Returns the column's value as a number.
    fn number(&self, column: ListColumn) -> Option<f64>;
    /// Returns the column's value as text, without blanks around it.
    fn text(&self, column: ListColumn) -> Option<&str>;
    /// Returns the column's value for a message; none if it is absent.
    fn found(&self, column: ListColumn) -> Option<String>;
}

/// Bytes of marks in memory for each byte of a list: the shortest rows have 16 bytes, and a vertex has 112.
const MARKS_PER_BYTE: u64 = 7;

/// Reads a list of dots, or of lines if it has the column `stroke`. A name that ends in `.jsonl` is read as JSON lines,
/// any other as CSV.
///
/// Returns a layer for each of `pens`, in their order. Without pens each name in the list gets a layer, in the colour
/// that a name such as `#c04006` gives, or in black.
///
/// Lengths are in the page's unit, and marks are rounded. Without a column `pen` all marks belong to the first pen.
/// Columns stand in any order; unknown columns are ignored.
///
/// # Errors
/// [`OutputError::Io`]; [`OutputError::List`] with line and column for a value that is missing or invalid.
pub fn read_list(path: &Path, page: &Page, pens: &[Pen]) -> Result<Vec<Layer>, OutputError> {
    let file = Metered::new(File::open(path).map_err(|source| RowError::File(source).at(path, 1))?, MARKS_PER_BYTE);
    match ListFormat::of(path) {
        Some(ListFormat::JsonLines) => ListReader { path, rows: JsonRows::new(file) }.read(page, pens),
        Some(ListFormat::Csv) | None => {
            let rows = CsvRows::new(file).map_err(|wrong| wrong.at(path, 1))?;
            ListReader { path, rows }.read(page, pens)
        }
    }
}

/// A file being read.
struct ListReader<'a, R> {
    path: &'a Path,
    rows: R,
}

impl<R: RowReader> ListReader<'_, R> {
    fn read(mut self, page: &Page, pens: &[Pen]) -> Result<Vec<Layer>, OutputError> {
        let scale = match page.unit {
            PageUnit::Millimetres => 1.0,
            PageUnit::Pixels => 1.0 / page.pixels_per_mm(),
        };
        let mut layers: Vec<Layer> = pens.iter().cloned().map(Layer::new).collect();
        let mut last = None;
        while self.rows.next().map_err(|wrong| wrong.at(self.path, self.rows.line()))? {
            let any = |column| self.number(column, |_| true, "a number");
            let at = DVec2::new(any(ListColumn::X)?, any(ListColumn::Y)?) * scale;
            let world = DVec3::new(any(ListColumn::Wx)?, any(ListColumn::Wy)?, any(ListColumn::Wz)?);
            let radius = self.number(ListColumn::Radius, |r| r > 0.0, "a number above 0")? * scale;
            let opacity =
                self.number(ListColumn::Opacity, |a| a > 0.0 && a <= 1.0, "a number above 0 and of at most 1")?;
            let layer = self.layer(&mut layers, pens.is_empty())?;
            if !self.rows.has(ListColumn::Stroke) {
                layer.dots.push(Dot { at, world, radius, opacity });
                continue;
            }
            let color = self.color()?;
            let number = self.number(ListColumn::Stroke, |n| n.fract() == 0.0, "a whole number")?;
            let t = self.number(ListColumn::T, |t| (0.0..=1.0).contains(&t), "a number from 0 to 1")?;
            if last != Some(number) {
                layer.lines.push(Polyline { vertices: Vec::new(), closed: false });
                last = Some(number);
            }
            if let Some(line) = layer.lines.last_mut() {
                line.vertices.push(Vertex { at, world, radius, opacity, t, color });
            }
        }
        let mut marks = Marks { page: *page, layers };
        marks.layers.iter_mut().flat_map(|layer| &mut layer.lines).for_each(close);
        marks.round();
        Ok(marks.layers)
    }

    fn fault(&self, column: &str, fault: String) -> OutputError {
        OutputError::List { path: self.path.into(), line: self.rows.line(), column: column.into(), fault }
    }

    /// Returns the error of a value that is not the expected one.
    fn wrong(&self, column: ListColumn, expected: &str) -> OutputError {
        let name = column.name();
        let fault = match self.rows.found(column) {
            Some(found) => format!("found {found}, expected {expected}"),
            None => format!("{name} is missing, expected {expected}"),
        };
        self.fault(name, fault)
    }

    /// Returns the column's number if it is finite and `may` accepts it.
    fn number(&self, column: ListColumn, may: impl Fn(f64) -> bool, expected: &str) -> Result<f64, OutputError> {
        let number = self.rows.number(column);
        number.filter(|&n| n.is_finite() && may(n)).ok_or_else(|| self.wrong(column, expected))
    }

    /// Returns a vertex's own colour, if it has one.
    fn color(&self) -> Result<Option<Rgb>, OutputError> {
        let Some(text) = self.rows.text(ListColumn::Color).filter(|text| !text.is_empty()) else { return Ok(None) };
        hex(text).map(Some).ok_or_else(|| self.wrong(ListColumn::Color, "a colour such as #c04006"))
    }

    /// Returns the layer of the row's pen. With `are_found` a new pen name adds a layer.
    fn layer<'l>(&self, layers: &'l mut Vec<Layer>, are_found: bool) -> Result<&'l mut Layer, OutputError> {
        let has_pens = self.rows.has(ListColumn::Pen);
        if are_found {
            let name = if has_pens { self.rows.text(ListColumn::Pen) } else { Some("stipples") };
            if let Some(name) = name.filter(|name| layers.iter().all(|layer| layer.pen.name != *name)) {
                layers.push(Layer::new(found_pen(layers.len() + 1, name)));
            }
        }
        let at = if has_pens {
            let text = self.rows.text(ListColumn::Pen);
            layers.iter().position(|layer| text == Some(layer.pen.name.trim())).ok_or_else(|| {
                let names: Vec<String> = layers.iter().map(|layer| format!("{:?}", layer.pen.name)).collect();
                self.wrong(ListColumn::Pen, &names.join(" or "))
            })?
        } else {
            0
        };
        layers.get_mut(at).ok_or_else(|| self.fault("pen", "there is no pen to draw with".into()))
    }
}

/// Returns a pen of which only the name is known.
fn found_pen(number: usize, name: &str) -> Pen {
    let [r, g, b] = hex(name).unwrap_or_default();
    Pen { number, name: name.into(), width: FOUND_WIDTH, color: [r, g, b, 1.0] }
}

/// Returns the linear colour of `#rrggbb`.
fn hex(name: &str) -> Option<Rgb> {
    let digits = name.strip_prefix('#').filter(|digits| digits.len() == 6)?;
    let bytes = u32::from_str_radix(digits, 16).ok()?.to_be_bytes();
    Some([bytes[1], bytes[2], bytes[3]].map(|byte| srgb_to_linear(f64::from(byte) / 255.0)))
}

/// Nib of a pen that is known by its name alone, in mm.
const FOUND_WIDTH: f64 = 0.3;

/// Closes a line whose last vertex repeats the first.
fn close(line: &mut Polyline) {
    if let [first, .., last] = line.vertices.as_slice()
        && line.vertices.len() > 3
        && (first.at, first.world) == (last.at, last.world)
    {
        line.vertices.pop();
        line.closed = true;
    }
}
