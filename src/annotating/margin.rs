//! A scale bar and the directions of the data, in the corners and at the edges of a picture.

use super::room::MarginRoom;
use super::{Annotating, lines};
use crate::Failure;
use drypoint_output::text::font::extent;
use drypoint_reference::figure::{AxisOnPage, axes_on_page, edge_letters, round_length, world_per_pixel};
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Layer, Pen, Polyline, Text};
use drypoint_scene::tables::{Orientation, ScaleBar};
use drypoint_scene::view::View;

/// The distance from the picture's edge, in sizes of the text.
const INSET: f64 = 1.0;

/// The least distance of wide letters from the picture's edge, in sizes of the text.
const CLEAR: f64 = 0.25;

/// The longest scale bar that is chosen, as a share of the picture's width.
const LONGEST: f64 = 0.25;

/// The length of an axis of the triad, in sizes of the letters.
const AXIS: f64 = 3.0;

impl Annotating<'_> {
    /// The scale bar, then the directions.
    pub(super) fn margin(
        &self,
        view: &View,
        room: &mut MarginRoom,
        notes: &mut Vec<String>,
    ) -> Result<Vec<Layer>, Failure> {
        let mut layers = Vec::new();
        if let Some(bar) = &self.tables().scale_bar {
            let pen = self.pen(&bar.line, "scale bar", "scale_bar.pen")?;
            match self.scale_bar(view, bar, pen, room) {
                Ok(layer) => layers.push(layer),
                Err(why) => notes.push(format!("the scale bar is left out: {why}")),
            }
        }
        if let Some(orientation) = &self.tables().orientation {
            let pen = self.pen(&orientation.line, "orientation", "orientation.pen")?;
            layers.push(self.orientation(view, orientation, pen, room, notes));
        }
        Ok(layers)
    }

    /// A bar with its length above it, as long as the text says. If there is none, the error tells why.
    fn scale_bar(&self, view: &View, bar: &ScaleBar, pen: Pen, room: &mut MarginRoom) -> Result<Layer, &'static str> {
        let target = self.job.scene.camera.target.unwrap_or_else(|| self.job.volume.grid().centre());
        let world = world_per_pixel(view, -view.to_eye(target).z);
        if world <= 0.0 {
            return Err("the camera's target is not before the eye; try another target");
        }
        // Pixels are stretched by less than half of one to fill a page in mm.
        let mm_per_pixel = self.page.picture().x / view.size[0] as f64;
        let length = bar.length.or_else(|| round_length(LONGEST * view.size[0] as f64 * world));
        let length = length.ok_or("no round length is short enough; try another camera")?;
        let mm = length / world * mm_per_pixel;
        if mm <= pen.width {
            return Err("it is shorter than its line is wide; try a greater length or a thinner line");
        }
        let unit = if bar.unit.is_empty() { String::new() } else { format!(" {}", bar.unit) };
        let place = view.perspective.then(|| format!("{length}{unit} at the target"));
        let size = self.mm(bar.size);
        // In perspective the length holds at one depth. Without room for both, the text has the length alone.
        let placed = place.into_iter().chain([format!("{length}{unit}")]).find_map(|characters| {
            let text = extent(&characters, size);
            let box_size = DVec2::new(mm.max(text.advance), 1.2 * size + pen.width);
            let corner = room.in_corner(bar.corner, box_size, INSET * size)?;
            let at = DVec2::new(corner.x + (box_size.x - text.advance) / 2.0, corner.y + 0.8 * size);
            let bar_at = DVec2::new(corner.x + (box_size.x - mm) / 2.0, corner.y + box_size.y - pen.width / 2.0);
            Some((Text { characters, at, size, opacity: 1.0 }, bar_at))
        });
        let (text, DVec2 { x: from, y }) = placed.ok_or(
            "it has no room in the picture; try a smaller length, a shorter unit, a smaller size or another corner",
        )?;
        // The pen's round ends belong to the bar.
        let ends = [DVec2::new(from + pen.width / 2.0, y), DVec2::new(from + mm - pen.width / 2.0, y)];
        let lines = vec![lines::plain(&ends, pen.width, 1.0, false)];
        Ok(Layer { lines, texts: vec![text], ..Layer::new(pen) })
    }

    /// Letters at the edges, and a triad.
    fn orientation(
        &self,
        view: &View,
        table: &Orientation,
        pen: Pen,
        room: &mut MarginRoom,
        notes: &mut Vec<String>,
    ) -> Layer {
        let mut layer = Layer::new(pen);
        let triad = table.triad.then(|| self.triad(view, table, layer.pen.width, room));
        if triad.as_ref().is_some_and(Option::is_none) {
            notes.push(
                "the triad is left out: it has no room in the picture; try a smaller size or another corner".into(),
            );
        }
        if table.letters {
            let size = self.mm(table.size);
            let [lo, hi] = self.page.frame();
            let middle = (lo + hi) / 2.0;
            let edges = [DVec2::X, DVec2::NEG_X, DVec2::NEG_Y, DVec2::Y];
            for (characters, edge) in edge_letters(view, self.job.volume.anatomy()).into_iter().zip(edges) {
                // Wide letters keep off the edge.
                let inset = (INSET * size).max(extent(&characters, size).advance / 2.0 + CLEAR * size);
                let at = middle + edge * ((hi - lo) / 2.0 - if edge.x == 0.0 { INSET * size } else { inset });
                let (text, rectangle) = centred(characters, at, size);
                if room.take(rectangle) {
                    layer.texts.push(text);
                } else {
                    let letter = text.characters;
                    notes.push(format!(
                        "the direction {letter:?} is left out: it has no room at its edge; try a smaller size"
                    ));
                }
            }
        }
        let (lines, texts) = triad.flatten().unwrap_or_default();
        layer.lines.extend(lines);
        layer.texts.extend(texts);
        layer
    }

    /// The axes of a triad and their letters; none without room.
    fn triad(
        &self,
        view: &View,
        table: &Orientation,
        width: f64,
        room: &mut MarginRoom,
    ) -> Option<(Vec<Polyline>, Vec<Text>)> {
        let size = self.mm(table.size);
        let length = AXIS * size;
        // The box around the tips and their letters goes to the corner.
        let axes = axes_on_page(view, self.job.volume.anatomy());
        let middle_of_letter = |way: DVec2| way * length + way.normalize_or_zero() * (0.7 * size);
        let [lo, hi] = axes.iter().fold([DVec2::ZERO; 2], |[lo, hi], axis| {
            let at = middle_of_letter(axis.way);
            [lo.min(at - size / 2.0), hi.max(at + size / 2.0)]
        });
        let origin = room.in_corner(table.corner, hi - lo, INSET * size)? - lo;
        let axis = |axis: AxisOnPage| {
            let tip = origin + axis.way * length;
            let text = centred(axis.letter, origin + middle_of_letter(axis.way), size).0;
            (lines::plain(&[origin, tip], width, 1.0, false), text)
        };
        Some(axes.into_iter().map(axis).unzip())
    }
}

/// A letter about a place, and the rectangle around it.
fn centred(characters: String, middle: DVec2, size: f64) -> (Text, [DVec2; 2]) {
    // Capitals are about 0.7 of the size high.
    let half = DVec2::new(extent(&characters, size).advance / 2.0, 0.35 * size);
    let at = middle + DVec2::new(-half.x, half.y);
    // Small letters reach below the baseline.
    let below = DVec2::new(half.x, half.y + 0.25 * size);
    (Text { characters, at, size, opacity: 1.0 }, [middle - half, middle + below])
}
