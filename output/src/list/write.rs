//! Writing lists.

use super::COLUMNS;
use crate::{OutputError, atomic};
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Layer, Marks, Page, PageUnit};
use std::fmt::Write;
use std::path::Path;

/// Writes the dots of all layers as CSV; the file appears whole or not at all.
///
/// # Errors
/// [`OutputError::Io`].
pub fn write_dots(marks: &Marks, path: &Path) -> Result<(), OutputError> {
    atomic::write(path, &encode_dots(marks))
}

/// Writes the lines of all layers as CSV; the file appears whole or not at all.
///
/// # Errors
/// [`OutputError::Io`].
pub fn write_lines(marks: &Marks, path: &Path) -> Result<(), OutputError> {
    atomic::write(path, &encode_lines(marks))
}

/// The bytes of [`write_dots`].
pub fn encode_dots(marks: &Marks) -> Vec<u8> {
    let (unit, several) = (Unit::of(&marks.page), marks.layers.len() > 1);
    let mut out = header("", several);
    for layer in &marks.layers {
        let end = end(layer, several);
        for dot in &layer.dots {
            row(&mut out, &unit, dot.at, dot.world, [dot.radius, dot.opacity]);
            out.push_str(&end);
        }
    }
    out.into_bytes()
}

/// The bytes of [`write_lines`].
pub fn encode_lines(marks: &Marks) -> Vec<u8> {
    let (unit, several) = (Unit::of(&marks.page), marks.layers.len() > 1);
    let mut out = header("stroke,t,", several);
    let mut number = 0;
    for layer in &marks.layers {
        let end = end(layer, several);
        for line in &layer.lines {
            let again = line.vertices.first().filter(|_| line.closed);
            for vertex in line.vertices.iter().chain(again) {
                add(&mut out, format_args!("{number},{},", vertex.t));
                row(&mut out, &unit, vertex.at, vertex.world, [vertex.radius, vertex.opacity]);
                out.push_str(&end);
            }
            number += 1;
        }
    }
    out.into_bytes()
}

fn header(before: &str, several: bool) -> String {
    format!("{before}{}{}\n", COLUMNS.join(","), if several { ",pen" } else { "" })
}

/// The end of a layer's rows, its pen's name quoted as CSV has it.
fn end(layer: &Layer, several: bool) -> String {
    if several { format!(",\"{}\"\n", layer.pen.name.replace('"', "\"\"")) } else { "\n".into() }
}

fn row(out: &mut String, unit: &Unit, at: DVec2, world: DVec3, [radius, opacity]: [f64; 2]) {
    unit.add(out, at.x);
    unit.add(out, at.y);
    add(out, format_args!("{},{},{},", world.x, world.y, world.z));
    unit.add(out, radius);
    add(out, format_args!("{opacity}"));
}

fn add(out: &mut String, text: std::fmt::Arguments) {
    // A String takes whatever is written to it.
    let _ = out.write_fmt(text);
}

/// How a length on the page is written.
enum Unit {
    Millimetres,
    /// Times so many pixels, with so many decimals.
    Pixels(f64, usize),
}

impl Unit {
    fn of(page: &Page) -> Self {
        let scale = page.pixels_per_mm();
        match page.unit {
            PageUnit::Millimetres => Self::Millimetres,
            // So many that a step of 0.001 mm is known again: an error of a quarter of it at most.
            PageUnit::Pixels => {
                let finest = (1..20).find(|&d| 2.0 / (0.001 * scale) <= f64::powi(10.0, d)).unwrap_or(20);
                Self::Pixels(scale, finest as usize)
            }
        }
    }

    fn add(&self, out: &mut String, mm: f64) {
        match *self {
            Self::Millimetres => add(out, format_args!("{mm}")),
            Self::Pixels(scale, decimals) => {
                add(out, format_args!("{:.decimals$}", mm * scale));
                let kept = out.trim_end_matches('0').trim_end_matches('.').len();
                out.truncate(kept);
            }
        }
        out.push(',');
    }
}
