//! The tables of what is laid over a picture: boxes, arrows, fans, labels, scale bar, orientation, legend ([VS-8], [VS-10]).

pub(crate) mod arrow;
pub(crate) mod bounding_box;
mod end;
pub(crate) mod fan;
pub(crate) mod label;
pub(crate) mod legend;
mod legend_rows;
mod line;
mod of_objects;
pub(crate) mod orientation;
pub(crate) mod scale_bar;

pub use arrow::{ArrowEnds, ArrowTable};
pub use bounding_box::{BoxShown, BoxTable};
pub use end::AnnotatedPlace;
pub use fan::{FanShape, FanTable};
pub use label::{LabelAnchor, LabelLayout, LabelSource, LabelTable, LabelsTable};
pub use legend::Legend;
pub use legend_rows::{LegendEntry, LegendRow};
pub use line::LineStyle;
pub use orientation::Orientation;
pub use scale_bar::{Corner, ScaleBar};

use crate::tables::{Length, PartName};

/// Everything that is laid over a picture. [`Scene::all_annotations`](crate::tables::Scene::all_annotations) adds what
/// objects ask for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Annotations {
    /// Bounding boxes, in their order.
    pub boxes: Vec<BoxTable>,
    /// Fans, in their order.
    pub fans: Vec<FanTable>,
    /// Arrows, in their order.
    pub arrows: Vec<ArrowTable>,
    /// Labels, in their order.
    pub labels: Vec<LabelTable>,
    /// The arrangement of the labels; none: the default.
    pub arrangement: Option<LabelsTable>,
    /// A line of known length; none: none.
    pub scale_bar: Option<ScaleBar>,
    /// The directions of the data; none: none.
    pub orientation: Option<Orientation>,
    /// The looks of the transfer function with their names; none: none.
    pub legend: Option<Legend>,
}

impl Annotations {
    /// Whether nothing is drawn.
    pub fn is_empty(&self) -> bool {
        !self.boxes.iter().any(|table| table.show == BoxShown::Always)
            && self.fans.is_empty()
            && self.arrows.is_empty()
            && self.labels.is_empty()
            && self.scale_bar.is_none()
            && self.orientation.is_none()
            && self.legend.is_none()
    }

    /// The line of each table, with the table's key.
    pub(crate) fn lines(&self) -> Vec<(String, &LineStyle)> {
        let mut all: Vec<(String, &LineStyle)> = Vec::new();
        all.extend(self.boxes.iter().enumerate().map(|(i, table)| (format!("box[{i}]"), &table.line)));
        all.extend(self.arrows.iter().enumerate().map(|(i, table)| (format!("arrow[{i}]"), &table.line)));
        all.extend(self.fans.iter().enumerate().map(|(i, table)| (format!("fan[{i}]"), &table.line)));
        all.extend(self.arrangement.iter().map(|table| ("labels".into(), &table.line)));
        all.extend(self.scale_bar.iter().map(|table| ("scale_bar".into(), &table.line)));
        all.extend(self.orientation.iter().map(|table| ("orientation".into(), &table.line)));
        all.extend(self.legend.iter().map(|table| ("legend".into(), &table.line)));
        all
    }

    /// The names of parts, with their keys.
    pub(crate) fn parts(&self) -> Vec<(String, &PartName)> {
        let mut all: Vec<(String, &PartName)> = Vec::new();
        all.extend(self.boxes.iter().enumerate().map(|(i, table)| (format!("box[{i}].of"), &table.of)));
        let arrows = self.arrows.iter().enumerate().map(|(i, arrow)| (format!("arrow[{i}]"), &arrow.from, &arrow.to));
        let fans = self.fans.iter().enumerate().map(|(i, fan)| (format!("fan[{i}]"), &fan.from, &fan.to));
        for (table, from, to) in arrows.chain(fans) {
            for (key, place) in [("from", from), ("to", to)] {
                if let Some(AnnotatedPlace::Part(name)) = place {
                    all.push((format!("{table}.{key}"), name));
                }
            }
        }
        let labels = self.labels.iter().enumerate();
        all.extend(labels.filter_map(|(i, label)| Some((format!("label[{i}].object"), label.object.as_ref()?))));
        all
    }

    /// The lengths on the page, with their tables and keys.
    pub(crate) fn lengths(&self) -> Vec<(String, &'static str, Length)> {
        let mut all: Vec<(String, &'static str, Length)> = Vec::new();
        all.extend(self.lines().into_iter().map(|(table, line)| (table, "width", line.width)));
        all.extend(self.arrows.iter().enumerate().map(|(i, arrow)| (format!("arrow[{i}]"), "head", arrow.head)));
        if let Some(labels) = &self.arrangement {
            let of_labels =
                [("size", labels.size), ("dot", labels.dot), ("gap", labels.gap), ("distance", labels.distance)];
            all.extend(of_labels.map(|(key, length)| ("labels".into(), key, length)));
        }
        all.extend(self.scale_bar.iter().map(|table| ("scale_bar".into(), "size", table.size)));
        all.extend(self.orientation.iter().map(|table| ("orientation".into(), "size", table.size)));
        all.extend(self.legend.iter().map(|table| ("legend".into(), "size", table.size)));
        all
    }

    /// Whether the volume can hide some of it, or tells where labels stand.
    pub fn asks_rays(&self) -> bool {
        self.boxes.iter().any(|table| table.show == BoxShown::Always && table.occluded)
            || self.arrows.iter().any(|table| table.occluded)
            || !self.labels.is_empty()
    }

    /// Whether labels name structures of the label volume.
    pub fn asks_labels(&self) -> bool {
        self.labels.iter().any(|label| label.from.is_some() || label.label.is_some())
    }
}
