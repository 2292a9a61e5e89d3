//! Lengths, values and pens of the tables of strokes, with failures that name their keys.

use crate::Failure;
use crate::job::pen_named;
use drypoint_scene::color::Rgba;
use drypoint_scene::marks::{Page, Pen};
use drypoint_scene::space::Grid;
use drypoint_scene::tables::{Iso, Length, Scene};

/// Returns an iso-value. A job has already set those that its scene leaves to the volume.
pub(super) fn value(scene: &Scene, iso: Iso, key: &str) -> Result<f64, Failure> {
    match iso {
        Iso::Value(value) => Ok(value),
        Iso::Auto => Err(Failure::new("the iso-value was not found", scene.given.position(key), "give a number")),
    }
}

/// Returns a length in the volume, in world units.
pub(super) fn in_world(scene: &Scene, length: Length, key: &str, grid: &Grid) -> Result<f64, Failure> {
    length.world(grid).ok_or_else(|| {
        let what = "the length is on the page, not in the volume";
        Failure::new(what, scene.given.position(key), "give it in voxels")
    })
}

/// Returns a length on the page, in mm.
pub(super) fn on_page(scene: &Scene, page: &Page, length: Length, key: &str) -> Result<f64, Failure> {
    page.length(length).ok_or_else(|| {
        let what = "the length is in the volume, not on the page";
        Failure::new(what, scene.given.position(key), "give it in mm or px")
    })
}

/// Returns the pen that draws a table's strokes: one of `[[pen]]`, or the table's own.
pub(super) fn pen(
    scene: &Scene,
    table: &str,
    page: &Page,
    named: Option<&str>,
    (width, color): (Length, Rgba),
) -> Result<Pen, Failure> {
    if let Some(name) = named {
        // The failure names the table's `pen`, or a key that names another pen.
        let key = if table.contains('.') { table.into() } else { format!("{table}.pen") };
        return pen_named(scene, page, name, &key);
    }
    let width = on_page(scene, page, width, &format!("{table}.width"))?;
    Ok(Pen { number: 1, name: table.into(), width, color })
}
