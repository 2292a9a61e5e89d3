//! A scale bar and the directions of the data, in the corners and at the edges of a picture.

use super::{Annotating, lines};
use crate::Failure;
use drypoint_output::text::font::extent;
use drypoint_reference::figure::{axes_on_page, edge_letters, round_length, world_per_pixel};
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Layer, Pen, Text};
use drypoint_scene::tables::{Corner, Orientation, ScaleBar};
use drypoint_scene::view::View;

/// The distance from the picture's edge, in sizes of the text.
const INSET: f64 = 1.0;

/// The longest scale bar that is chosen, as a share of the picture's width.
const LONGEST: f64 = 0.25;

/// The length of an axis of the triad, in sizes of the letters.
const AXIS: f64 = 3.0;

impl Annotating<'_> {
    /// The scale bar, then the directions.
    pub(super) fn margin(&self, view: &View) -> Result<Vec<Layer>, Failure> {
        let mut layers = Vec::new();
        if let Some(bar) = &self.tables().scale_bar {
            let pen = self.pen(&bar.line, "scale bar", "scale_bar.pen")?;
            layers.extend(self.scale_bar(view, bar, pen));
        }
        if let Some(orientation) = &self.tables().orientation {
            let pen = self.pen(&orientation.line, "orientation", "orientation.pen")?;
            layers.push(self.orientation(view, orientation, pen));
        }
        Ok(layers)
    }

    /// A bar with its length above it.
    fn scale_bar(&self, view: &View, bar: &ScaleBar, pen: Pen) -> Option<Layer> {
        let target = self.job.scene.camera.target.unwrap_or_else(|| self.job.volume.grid().centre());
        let world = world_per_pixel(view, -view.to_eye(target).z);
        // Pixels are stretched by less than half of one to fill a page in mm.
        let mm_per_pixel = self.page.picture().x / view.size[0] as f64;
        let length = bar.length.or_else(|| round_length(LONGEST * view.size[0] as f64 * world))?;
        let mm = length / world * mm_per_pixel;
        let place = if view.perspective { " at the target" } else { "" };
        let unit = if bar.unit.is_empty() { String::new() } else { format!(" {}", bar.unit) };
        let characters = format!("{length}{unit}{place}");
        let size = self.mm(bar.size);
        let text = extent(&characters, size);
        let box_size = DVec2::new(mm.max(text.advance), 1.2 * size + pen.width);
        let corner = self.in_corner(bar.corner, box_size, INSET * size);
        let y = corner.y + box_size.y - pen.width / 2.0;
        let from = corner.x + (box_size.x - mm) / 2.0;
        // The pen's round ends belong to the bar.
        let ends = [DVec2::new(from + pen.width / 2.0, y), DVec2::new(from + mm - pen.width / 2.0, y)];
        let at = DVec2::new(corner.x + (box_size.x - text.advance) / 2.0, corner.y + 0.8 * size);
        let lines = vec![lines::plain(&ends, pen.width, 1.0, false)];
        let texts = vec![Text { characters, at, size, opacity: 1.0 }];
        Some(Layer { lines, texts, ..Layer::new(pen) })
    }

    /// Letters at the edges, and a triad.
    fn orientation(&self, view: &View, table: &Orientation, pen: Pen) -> Layer {
        let (anatomy, size) = (self.job.volume.anatomy(), self.mm(table.size));
        let mut layer = Layer::new(pen);
        let centred = |characters: String, middle: DVec2| {
            let text = extent(&characters, size);
            // Capitals are about 0.7 of the size high.
            let at = middle + DVec2::new(-text.advance / 2.0, 0.35 * size);
            Text { characters, at, size, opacity: 1.0 }
        };
        let (lo, hi) = (DVec2::splat(self.page.margin), self.page.size - self.page.margin);
        if table.letters {
            let (middle, inset) = ((lo + hi) / 2.0, INSET * size);
            let places = [
                DVec2::new(hi.x - inset, middle.y),
                DVec2::new(lo.x + inset, middle.y),
                DVec2::new(middle.x, lo.y + inset),
                DVec2::new(middle.x, hi.y - inset),
            ];
            let letters = edge_letters(view, anatomy).into_iter().zip(places);
            layer.texts.extend(letters.map(|(letter, at)| centred(letter, at)));
        }
        if table.triad {
            let length = AXIS * size;
            // The box around the tips and their letters goes to the corner.
            let axes = axes_on_page(view, anatomy);
            let middle_of_letter = |way: DVec2| way * length + way.normalize_or_zero() * (0.7 * size);
            let [lo, hi] = axes.iter().fold([DVec2::ZERO; 2], |[lo, hi], axis| {
                let at = middle_of_letter(axis.way);
                [lo.min(at - size / 2.0), hi.max(at + size / 2.0)]
            });
            let origin = self.in_corner(table.corner, hi - lo, INSET * size) - lo;
            for axis in axes {
                let tip = origin + axis.way * length;
                layer.lines.push(lines::plain(&[origin, tip], layer.pen.width, 1.0, false));
                layer.texts.push(centred(axis.letter, origin + middle_of_letter(axis.way)));
            }
        }
        layer
    }

    /// Returns the upper left corner of a box in a corner of the picture, in mm.
    pub(super) fn in_corner(&self, corner: Corner, size: DVec2, inset: f64) -> DVec2 {
        let (lo, hi) = (self.page.margin + inset, self.page.size - (self.page.margin + inset) - size);
        let x = match corner {
            Corner::TopLeft | Corner::BottomLeft => lo,
            Corner::TopRight | Corner::BottomRight => hi.x,
        };
        let y = match corner {
            Corner::TopLeft | Corner::TopRight => lo,
            Corner::BottomLeft | Corner::BottomRight => hi.y,
        };
        DVec2::new(x, y)
    }
}
