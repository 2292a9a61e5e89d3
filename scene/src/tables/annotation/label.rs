//! `[[label]]` and `[labels]`: text beside the picture with leader lines to what it names ([VS-10]).

use super::LineStyle;
use crate::document::declare::{choices, table};
use crate::document::describe::{Instead, Table};
use crate::document::fault::Problem;
use crate::document::kind::{Bounds, Colors, Lengths, Number, Numbers, On, Rule, Text, Whole};
use crate::tables::object::PartNames;
use crate::tables::over::Label;
use crate::tables::{LabelKey, Length, PartName};
use glam::DVec3;

table! {
    /// One table `[[label]]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct LabelTable {
        /// The text.
        text: Option<String> = None, key("VS-10", Text { what: "a line of text" }).absent("the name of what is labelled");
        /// The point that is labelled, in world space.
        at: Option<DVec3> = None, key("VS-10", POINT).absent("`pixel`, `object`, `label` or `from`");
        /// The pixel whose visible structure is labelled, column and row from the top left.
        pixel: Option<[f64; 2]> = None, key("VS-10", PIXEL).absent("`at`, `object`, `label` or `from`");
        /// The part whose box has the labelled centre: the name of an object, or "NAME ghost".
        object: Option<PartName> = None, key("VS-10", PartNames).absent("`at`, `pixel`, `label` or `from`");
        /// The id or the name of the structure of the label volume that is labelled.
        label: Option<LabelKey> = None, key("VS-10", Label).absent("`at`, `pixel`, `object` or `from`");
        /// The place in a structure that the leader line leads to.
        anchor: LabelAnchor = LabelAnchor::Seen, key("VS-10", LabelAnchor::KIND);
        /// Labels for the structures of the label volume that are seen, the largest first.
        from: Option<LabelSource> = None, key("VS-10", LabelSource::KIND).absent("`at`, `pixel`, `object` or `label`");
        /// The largest number of labels that `from` makes.
        most: usize = 12, key("VS-10", Whole { lo: 1, hi: 1000 });
    }
}

choices! {
    /// The place in a structure that a leader line leads to.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum LabelAnchor {
        /// A point on its visible surface, well inside what is seen of it.
        Seen = "seen",
        /// Its centroid.
        Centroid = "centroid",
    }
}

choices! {
    /// The source of several labels.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum LabelSource {
        /// The label volume of `[volume]`, with its names.
        Labels = "labels",
    }
}

table! {
    /// The table `[labels]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct LabelsTable {
        /// The arrangement of the labels.
        layout: LabelLayout = LabelLayout::Hull, key("VS-10", LabelLayout::KIND);
        /// Size of the text, from baseline to baseline of two lines about 1.2 times as much.
        ///
        /// On the page.
        size: Length = Length::Millimetres(3.2), key("VS-10", Lengths { on: On::Page, bounds: Bounds::POSITIVE });
        /// Diameter of the dot at the end of a leader line; 0: no dot.
        dot: Length = Length::Millimetres(0.9), key("VS-10", Lengths { on: On::Page, bounds: Bounds::NOT_NEGATIVE });
        /// Half the least distance between two labels.
        gap: Length = Length::Millimetres(0.6), key("VS-10", Lengths { on: On::Page, bounds: Bounds::NOT_NEGATIVE });
        /// Distance of the labels from what they surround.
        distance: Length = Length::Millimetres(4.0),
            key("VS-10", Lengths { on: On::Page, bounds: Bounds::NOT_NEGATIVE });
        /// o_min: opacity of the leader line of the farthest anchor.
        least_opacity: f64 = 0.25, key("VS-10", Number { bounds: Bounds::UNIT, unit: "" });
        /// The largest number of rounds in which conflicts of labels are resolved.
        rounds: usize = 64, key("VS-10", Whole { lo: 0, hi: 10_000 });
        /// The leader lines.
        line: LineStyle = LineStyle::black(0.2);
        /// Colour of text and leader lines.
        color: key("VS-10", Colors, |l| Some(l.line.color), |l, v| l.line.color = v);
        /// Width of the leader lines.
        width: key("VS-10", Lengths { on: On::Page, bounds: Bounds::POSITIVE },
            |l| Some(l.line.width), |l, v| l.line.width = v);
        /// The pen of `[[pen]]` that draws text and leader lines.
        pen: key("VS-10", Text { what: "the name of a pen" }, |l| l.line.pen.clone(), |l, v| l.line.pen = Some(v))
            .absent("`color` and `width`");
    }
}

choices! {
    /// The arrangement of labels.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum LabelLayout {
        /// Around the convex hull of what is shown: the paper's.
        Hull = "hull",
        /// In two columns, at the left and at the right of what is shown, as in atlases.
        Columns = "columns",
    }
}

const POINT: Numbers<3> = Numbers { what: "a point [x, y, z]", bounds: Bounds::ANY, rule: Rule::Free };
const PIXEL: Numbers<2> = Numbers { what: "a pixel [column, row]", bounds: Bounds::NOT_NEGATIVE, rule: Rule::Free };

/// The keys of which a label has one.
const ANCHORS: [&str; 5] = ["at", "pixel", "object", "label", "from"];

/// The description of a table `[[label]]`.
pub(crate) static LABEL: Table<LabelTable> = Table {
    instead: &[
        Instead { one: "at", others: &["pixel", "object", "label", "from"] },
        Instead { one: "pixel", others: &["object", "label", "from"] },
        Instead { one: "object", others: &["label", "from"] },
        Instead { one: "label", others: &["from"] },
        Instead { one: "from", others: &["text"] },
    ],
    check: |label, check| {
        if !ANCHORS.iter().any(|key| check.has(key)) {
            let what = "the label names nothing".into();
            let remedy = format!("add one of {}", ANCHORS.join(", "));
            check.fault_in("text", Problem::Contradiction { what, remedy });
        } else if label.text.is_none() && (check.has("at") || check.has("pixel")) {
            let what = "the label has no text".into();
            check.fault_in("text", Problem::Contradiction { what, remedy: "add text = \"…\"".into() });
        }
    },
    ..LabelTable::description("a label", "Text beside the picture, with a leader line to what it names.")
};

/// The description of `[labels]`.
pub(crate) static LABELS: Table<LabelsTable> =
    LabelsTable::description("[labels]", "The arrangement of all labels, their text and their leader lines.");
