//! Writing of lists.

use super::{COLUMNS, ListFormat};
use crate::encode::hex;
use crate::finite::check_finite;
use crate::{OutputError, atomic};
use drypoint_scene::color::Rgb;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Layer, Marks, Page, PageUnit};
use std::fmt::Write;
use std::path::Path;

/// Writes the dots of all layers. The file appears whole or not at all.
///
/// # Errors
/// [`OutputError::NotFinite`] and [`OutputError::Io`].
pub fn write_dots(marks: &Marks, form: ListFormat, path: &Path) -> Result<(), OutputError> {
    check_finite(marks)?;
    atomic::write(path, &encode_dots(marks, form))
}

/// Writes the lines of all layers. The file appears whole or not at all.
///
/// # Errors
/// [`OutputError::NotFinite`] and [`OutputError::Io`].
pub fn write_lines(marks: &Marks, form: ListFormat, path: &Path) -> Result<(), OutputError> {
    check_finite(marks)?;
    atomic::write(path, &encode_lines(marks, form))
}

/// Returns the bytes of [`write_dots`].
pub fn encode_dots(marks: &Marks, form: ListFormat) -> Vec<u8> {
    // Layers of outlines alone have no rows, and need no pen to be told apart.
    let has_dots = |layer: &&Layer| !layer.dots.is_empty() || layer.lines.is_empty();
    let several = marks.layers.iter().filter(has_dots).count() > 1;
    let mut table = ListWriter::new(marks, form, several, &COLUMNS);
    for layer in &marks.layers {
        let end = table.end(layer);
        for dot in &layer.dots {
            table.mark(dot.at, dot.world, [dot.radius, dot.opacity]);
            table.out.push_str(&end);
        }
    }
    table.out.into_bytes()
}

/// Returns the bytes of [`write_lines`].
pub fn encode_lines(marks: &Marks, form: ListFormat) -> Vec<u8> {
    let columns: Vec<&'static str> = ["stroke", "t"].into_iter().chain(COLUMNS).collect();
    let mut table = ListWriter::new(marks, form, marks.layers.len() > 1, &columns);
    let colored = marks.layers.iter().flat_map(|layer| &layer.lines).flat_map(|line| &line.vertices);
    let colored = colored.into_iter().any(|vertex| vertex.color.is_some());
    if let (true, ListFormat::Csv) = (colored, form) {
        table.add_color();
    }
    let mut number = 0;
    for layer in &marks.layers {
        let end = table.end(layer);
        for line in &layer.lines {
            let again = line.vertices.first().filter(|_| line.closed);
            for vertex in line.vertices.iter().chain(again) {
                table.number(f64::from(number));
                table.number(vertex.t);
                table.mark(vertex.at, vertex.world, [vertex.radius, vertex.opacity]);
                if colored {
                    table.color(vertex.color);
                }
                table.out.push_str(&end);
            }
            number += 1;
        }
    }
    table.out.into_bytes()
}

/// A list being written.
struct ListWriter {
    out: String,
    form: ListFormat,
    unit: LengthFormat,
    several: bool,
    /// Text before each number of a row: commas, or JSON keys.
    before: Vec<String>,
    /// Index of the row's next number.
    next: usize,
}

impl ListWriter {
    fn new(marks: &Marks, form: ListFormat, several: bool, columns: &[&'static str]) -> Self {
        let (out, before) = match form {
            ListFormat::Csv => {
                let before = (0..columns.len()).map(|i| if i == 0 { "" } else { "," }.to_owned());
                (format!("{}{}\n", columns.join(","), if several { ",pen" } else { "" }), before.collect())
            }
            ListFormat::JsonLines => {
                let name = |(i, column): (usize, &&str)| format!("{}\"{column}\":", if i == 0 { '{' } else { ',' });
                (String::new(), columns.iter().enumerate().map(name).collect())
            }
        };
        Self { out, form, unit: LengthFormat::of(&marks.page), several, before, next: 0 }
    }

    /// Returns the end of a layer's rows, with the pen's name if there are several layers.
    fn end(&self, layer: &Layer) -> String {
        let name = &layer.pen.name;
        match (self.form, self.several) {
            (ListFormat::Csv, false) => "\n".into(),
            (ListFormat::Csv, true) => format!(",\"{}\"\n", name.replace('"', "\"\"")),
            (ListFormat::JsonLines, false) => "}\n".into(),
            (ListFormat::JsonLines, true) => format!(",\"pen\":{}}}\n", serde_json::Value::from(name.as_str())),
        }
    }

    fn mark(&mut self, at: DVec2, world: DVec3, [radius, opacity]: [f64; 2]) {
        self.length(at.x);
        self.length(at.y);
        world.to_array().into_iter().for_each(|w| self.number(w));
        self.length(radius);
        self.number(opacity);
    }

    /// Adds the column of colours to the header, before that of pens.
    fn add_color(&mut self) {
        let at = self.out.len() - if self.several { ",pen\n".len() } else { "\n".len() };
        self.out.insert_str(at, ",color");
    }

    /// Writes the colour of a vertex, before the pen. For the pen's colour, the cell is empty in CSV, and the key is
    /// missing in JSON.
    fn color(&mut self, color: Option<Rgb>) {
        let own = color.map(|[r, g, b]| hex([r, g, b, 1.0]));
        match (self.form, own) {
            (ListFormat::Csv, own) => {
                self.out.push(',');
                self.out.push_str(&own.unwrap_or_default());
            }
            // A String takes whatever is written to it.
            (ListFormat::JsonLines, Some(own)) => drop(write!(self.out, ",\"color\":\"{own}\"")),
            (ListFormat::JsonLines, None) => {}
        }
    }

    fn number(&mut self, n: f64) {
        self.begin();
        // A String takes whatever is written to it.
        let _ = write!(self.out, "{n}");
    }

    /// Writes a length in the page's unit.
    fn length(&mut self, mm: f64) {
        match self.unit {
            LengthFormat::Millimetres => self.number(mm),
            LengthFormat::Pixels(scale, decimals) => {
                self.begin();
                let _ = write!(self.out, "{:.decimals$}", mm * scale);
                let kept = self.out.trim_end_matches('0').trim_end_matches('.').len();
                self.out.truncate(kept);
            }
        }
    }

    fn begin(&mut self) {
        self.out.push_str(&self.before[self.next]);
        self.next = (self.next + 1) % self.before.len();
    }
}

/// Unit and digits of lengths.
#[derive(Clone, Copy)]
enum LengthFormat {
    Millimetres,
    /// Pixels of a millimetre, and the number of decimals.
    Pixels(f64, usize),
}

impl LengthFormat {
    fn of(page: &Page) -> Self {
        let scale = page.pixels_per_mm();
        match page.unit {
            PageUnit::Millimetres => Self::Millimetres,
            // Enough decimals to recover a step of 0.001 mm: the error is at most a quarter of it.
            PageUnit::Pixels => {
                let finest = (1..20).find(|&d| 2.0 / (0.001 * scale) <= f64::powi(10.0, d)).unwrap_or(20);
                Self::Pixels(scale, finest as usize)
            }
        }
    }
}
