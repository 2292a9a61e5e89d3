//! Reading lists.

use super::COLUMNS;
use crate::OutputError;
use csv::ByteRecord;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Dot, Layer, Marks, Page, PageUnit, Pen, Polyline, Vertex};
use std::fs::File;
use std::path::Path;

/// Reads a list of dots, or of lines if it has the column `stroke`: a layer for each of `pens`, in their order.
///
/// Lengths are in the page's unit; marks are put onto their steps. Without a column `pen` all belong to the first pen.
/// Columns may stand in any order, and others beside them are passed over.
///
/// # Errors
/// [`OutputError::Io`]; [`OutputError::List`] with the line and the column for what is missing or cannot stand there.
pub fn read_list(path: &Path, page: &Page, pens: &[Pen]) -> Result<Vec<Layer>, OutputError> {
    let refused = |source| OutputError::Io { path: path.into(), action: "read", source };
    let file = File::open(path).map_err(refused)?;
    // Rows of another length are told by the column that is missing.
    let mut table = csv::ReaderBuilder::new().flexible(true).from_reader(file);
    let mut list = List { path, columns: Vec::new(), row: ByteRecord::new(), line: 1 };
    let fault = |list: &List, error: csv::Error| list.fault(list.line, "x", error.to_string());
    list.columns = table.byte_headers().map_err(|error| fault(&list, error))?.iter().map(<[u8]>::to_vec).collect();
    let at = COLUMNS.map(|name| list.column(name));
    let [x, y, wx, wy, wz, radius, opacity] = lift(at)?;
    let pen = list.column("pen").ok();
    let stroke = match list.column("stroke") {
        Ok(stroke) => Some((stroke, list.column("t")?)),
        Err(_) => None,
    };
    let scale = match page.unit {
        PageUnit::Millimetres => 1.0,
        PageUnit::Pixels => 1.0 / page.pixels_per_mm(),
    };

    let mut layers: Vec<Layer> = pens.iter().cloned().map(Layer::new).collect();
    let mut last = None;
    let mut row = ByteRecord::new();
    while table.read_byte_record(&mut row).map_err(|error| fault(&list, error))? {
        list.line = row.position().map_or(0, csv::Position::line);
        std::mem::swap(&mut list.row, &mut row);
        let any = |at| list.number(at, |_| true, "a number");
        let place = DVec2::new(any(x)?, any(y)?) * scale;
        let world = DVec3::new(any(wx)?, any(wy)?, any(wz)?);
        let radius = list.number(radius, |r| r > 0.0, "a number above 0")? * scale;
        let opacity = list.number(opacity, |a| a > 0.0 && a <= 1.0, "a number above 0 and of at most 1")?;
        let layer = list.layer(pen, &mut layers)?;
        let Some((stroke, t)) = stroke else {
            layer.dots.push(Dot { at: place, world, radius, opacity });
            continue;
        };
        let number = list.number(stroke, |n| n.fract() == 0.0, "a whole number")?;
        let t = list.number(t, |t| (0.0..=1.0).contains(&t), "a number from 0 to 1")?;
        if last != Some(number) {
            layer.lines.push(Polyline { vertices: Vec::new(), closed: false });
            last = Some(number);
        }
        if let Some(line) = layer.lines.last_mut() {
            line.vertices.push(Vertex { at: place, world, radius, opacity, t });
        }
    }
    let mut marks = Marks { page: *page, layers };
    marks.layers.iter_mut().flat_map(|layer| &mut layer.lines).for_each(close);
    marks.round();
    Ok(marks.layers)
}

/// A line whose last vertex is its first again is closed.
fn close(line: &mut Polyline) {
    if let [first, .., last] = line.vertices.as_slice()
        && line.vertices.len() > 3
        && (first.at, first.world) == (last.at, last.world)
    {
        line.vertices.pop();
        line.closed = true;
    }
}

fn lift<const N: usize>(found: [Result<usize, OutputError>; N]) -> Result<[usize; N], OutputError> {
    let mut all = [0; N];
    for (place, found) in all.iter_mut().zip(found) {
        *place = found?;
    }
    Ok(all)
}

/// The file while it is read.
struct List<'a> {
    path: &'a Path,
    columns: Vec<Vec<u8>>,
    row: ByteRecord,
    line: u64,
}

impl List<'_> {
    fn fault(&self, line: u64, column: &str, fault: String) -> OutputError {
        OutputError::List { path: self.path.into(), line, column: column.into(), fault }
    }

    /// Where the column of that name is.
    fn column(&self, name: &str) -> Result<usize, OutputError> {
        let at = self.columns.iter().position(|column| column.trim_ascii() == name.as_bytes());
        at.ok_or_else(|| self.fault(1, name, "is not there".into()))
    }

    /// What the row has in a column is not what should stand there.
    fn wrong(&self, at: usize, expected: &str) -> OutputError {
        let found = match self.row.get(at) {
            Some(bytes) => format!("{:?}", String::from_utf8_lossy(bytes)),
            None => "nothing".into(),
        };
        let column = String::from_utf8_lossy(&self.columns[at]).trim().to_owned();
        self.fault(self.line, &column, format!("found {found}, expected {expected}"))
    }

    fn text(&self, at: usize) -> Option<&str> {
        self.row.get(at).and_then(|bytes| std::str::from_utf8(bytes).ok()).map(str::trim)
    }

    /// A finite number that may stand there.
    fn number(&self, at: usize, may: impl Fn(f64) -> bool, expected: &str) -> Result<f64, OutputError> {
        let number = self.text(at).and_then(|text| text.parse::<f64>().ok());
        number.filter(|&n| n.is_finite() && may(n)).ok_or_else(|| self.wrong(at, expected))
    }

    /// The layer of the row's pen.
    fn layer<'l>(&self, pen: Option<usize>, layers: &'l mut [Layer]) -> Result<&'l mut Layer, OutputError> {
        let at = match pen {
            Some(at) => {
                layers.iter().position(|layer| self.text(at) == Some(layer.pen.name.trim())).ok_or_else(|| {
                    let names: Vec<String> = layers.iter().map(|layer| format!("{:?}", layer.pen.name)).collect();
                    self.wrong(at, &names.join(" or "))
                })?
            }
            None => 0,
        };
        layers.get_mut(at).ok_or_else(|| self.fault(self.line, "pen", "there is no pen to draw with".into()))
    }
}
