//! A legend: the looks of the transfer function with their names, in a corner of the picture.

use super::room::MarginRoom;
use super::{Annotating, lines, name_of_label, words};
use crate::Failure;
use crate::job::{Job, RenderTarget};
use drypoint_output::paint::PageWindow;
use drypoint_output::text::font::extent;
use drypoint_reference::style_transfer_functions::lit_disc;
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Area, Layer, Text};
use drypoint_scene::picture::Overlay;
use drypoint_scene::tables::{LegendEntry, LegendRow, NodeColor, RowAt, Stand};
use drypoint_scene::view::View;
use drypoint_scene::volume::info::short;
use std::f64::consts::TAU;

/// The distance from the picture's edge, in sizes of the text.
const INSET: f64 = 1.0;

/// The diameter of a lit sphere, in sizes of the text.
const SPHERE: f64 = 2.0;

/// The diameter of a circle of one colour, in sizes of the text.
const SWATCH: f64 = 1.0;

/// The least distance between rows, in sizes of the text.
const LEADING: f64 = 1.4;

/// The space between the discs of two rows, in sizes of the text.
const APART: f64 = 0.35;

/// The space between a disc and its name, in sizes of the text.
const GAP: f64 = 0.6;

/// The height of the title, in sizes of the text.
const TITLE: f64 = 1.6;

/// The points of a circle's outline.
const POINTS: usize = 96;

/// A named row of a legend.
pub(super) struct NamedRow {
    name: String,
    look: NodeColor,
}

/// A legend on the page.
pub(super) struct DrawnLegend {
    /// Circles and text.
    pub(super) layer: Layer,
    /// Lit spheres in the picture's pixels.
    pub(super) spheres: Vec<Overlay>,
}

/// Returns the rows of a job's legend.
///
/// # Errors
/// The scene gives another number of names.
pub(super) fn rows(job: &Job) -> Result<Vec<NamedRow>, Failure> {
    let (Some(legend), Some(transfer)) = (&job.scene.annotations.legend, &job.scene.transfer) else {
        return Ok(Vec::new());
    };
    let rows = transfer.legend_rows().unwrap_or_default();
    // An automatic function that nothing called for was not looked for.
    if transfer.is_automatic() {
        return Ok(Vec::new());
    }
    if let Some((what, remedy)) = legend.wrong_names(rows.len()) {
        return Err(Failure::new(what, job.scene.given.position("legend.names"), remedy));
    }
    let names = rows.iter().enumerate().map(|(i, row)| match &legend.names {
        Some(names) => names[i].clone(),
        None => name(job, row),
    });
    let named = rows.iter().zip(names).map(|(row, name)| NamedRow { name, look: row.look.clone() });
    Ok(named.filter(|row| !row.name.is_empty()).collect())
}

/// The name of a row: that of its label or its style, or its value.
fn name(job: &Job, row: &LegendRow<'_>) -> String {
    let label = |stand: &Stand<'_>| match *stand {
        Stand::Name(name) => words(name),
        Stand::Number(id) => name_of_label(job, id as u32),
    };
    match (row.of, row.look) {
        (LegendEntry::Labels(RowAt::Labels(labels)), NodeColor::Style(style)) if labels.len() > 1 => words(style),
        (LegendEntry::Labels(at), _) => at.each().iter().map(label).collect::<Vec<_>>().join(", "),
        (LegendEntry::Value(_), NodeColor::Style(style)) => words(style),
        (LegendEntry::Value(value), NodeColor::Color(_)) => short(value),
    }
}

impl Annotating<'_> {
    /// The legend; none if the scene has none, nothing to list, or no room for it.
    pub(super) fn legend(
        &self,
        view: &View,
        room: &mut MarginRoom,
        notes: &mut Vec<String>,
    ) -> Result<Option<DrawnLegend>, Failure> {
        let Some(table) = self.tables().legend.as_ref().filter(|_| !self.rows.is_empty()) else { return Ok(None) };
        let mut layer = Layer::new(self.pen(&table.line, "legend", "legend.pen")?);
        let (size, rows) = (self.mm(table.size), &self.rows);
        // The box of all rows and the title, and its place.
        let has_spheres = rows.iter().any(|row| matches!(row.look, NodeColor::Style(_)));
        let disc = if has_spheres { SPHERE } else { SWATCH } * size;
        let pitch = (disc + APART * size).max(LEADING * size);
        let title = if table.title.is_some() { TITLE * size } else { 0.0 };
        let width = |text: &str| extent(text, size).advance;
        let widest = rows.iter().map(|row| width(&row.name)).fold(0.0, f64::max);
        let of_title = table.title.as_deref().map_or(0.0, width);
        let high = title + disc.max(size) + pitch * (rows.len() - 1) as f64;
        let extent = DVec2::new((disc + GAP * size + widest).max(of_title), high);
        let Some(corner) = room.in_corner(table.corner, extent, INSET * size) else {
            notes.push(
                "the legend is left out: it has no room in the picture; try a smaller size or fewer names".into(),
            );
            return Ok(None);
        };
        if let Some(title) = &table.title {
            let at = corner + DVec2::new(0.0, 0.8 * size);
            layer.texts.push(Text { characters: title.clone(), at, size, opacity: 1.0 });
        }
        // Rows: a disc, and a name whose capitals are centred beside it.
        let mut spheres = Vec::new();
        let first = corner + DVec2::new(disc / 2.0, title + disc.max(size) / 2.0);
        for (i, row) in rows.iter().enumerate() {
            let centre = first + DVec2::new(0.0, pitch * i as f64);
            match self.sphere(view, row, centre, disc / 2.0) {
                Some(sphere) => spheres.push(sphere),
                None => self.circle(row, centre, disc / 2.0, &mut layer),
            }
            let at = centre + DVec2::new(disc / 2.0 + GAP * size, 0.35 * size);
            layer.texts.push(Text { characters: row.name.clone(), at, size, opacity: 1.0 });
        }
        if layer.areas.is_empty() && spheres.is_empty() {
            notes.push("the legend has circles without looks: no pixels are drawn, or a pen draws them".into());
        }
        Ok(Some(DrawnLegend { layer, spheres }))
    }

    /// The lit sphere of a row in the picture's pixels; none where a colour or an empty circle stands for the row. Its
    /// centre is that of a pixel, so that all spheres are antialiased alike.
    fn sphere(&self, view: &View, row: &NamedRow, centre: DVec2, radius: f64) -> Option<Overlay> {
        let NodeColor::Style(name) = &row.look else { return None };
        let has_pixels = self.job.target() == RenderTarget::Picture && !self.is_plotted();
        let style = self.job.style(name).filter(|_| has_pixels)?;
        let window = PageWindow::frame(&self.page, view.size);
        let centre = window.place(centre).map(|c| c.floor() + 0.5);
        Some(lit_disc(style, centre, window.length(radius), view.size))
    }

    /// Draws the circle of a row. A pen does not fill it.
    fn circle(&self, row: &NamedRow, centre: DVec2, radius: f64, layer: &mut Layer) {
        let angle = |i: usize| TAU * i as f64 / POINTS as f64;
        let at = |i: usize| centre + radius * DVec2::from_angle(angle(i));
        let outline: Vec<DVec2> = (0..POINTS).map(at).collect();
        if let NodeColor::Color(color) = row.look
            && !self.is_plotted()
        {
            layer.areas.push(Area { outlines: vec![outline.clone()], opacity: 1.0, color: Some(color) });
        }
        layer.lines.push(lines::plain(&outline, layer.pen.width, 1.0, true));
    }
}
