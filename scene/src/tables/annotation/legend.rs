//! `[legend]`: the styles or colours of the transfer function, with names.

use super::{Corner, LineStyle};
use crate::document::check::Check;
use crate::document::declare::table;
use crate::document::describe::{Kind, Shape, Table};
use crate::document::item::Item;
use crate::document::kind::{Bounds, Colors, FEW, Lengths, ListOf, On, Text};
use crate::document::out::Out;
use crate::tables::Length;
use serde_json::{Value as Json, json};

table! {
    /// The table `[legend]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Legend {
        /// The corner of the picture that it stands in.
        corner: Corner = Corner::TopLeft, key("VS-8", Corner::KIND);
        /// Size of the letters; a lit sphere is twice as large.
        ///
        /// On the page.
        size: Length = Length::Millimetres(3.0), key("VS-8", Lengths { on: On::Page, bounds: Bounds::POSITIVE });
        /// A name for each row, in order of the value or of the rows of labels; "" leaves the row out.
        names: Option<Vec<String>> = None, key("VS-8", ListOf { what: "a list of names", most: FEW, each: RowName })
            .absent("the names of the styles or labels, or the values of colours");
        /// A line of text above the rows.
        title: Option<String> = None, key("VS-8", Text { what: "a line of text" }).absent("no title");
        /// The line of the circles around colours.
        line: LineStyle = LineStyle::black(0.2);
        /// Colour of text and circles.
        color: key("VS-8", Colors, |l| Some(l.line.color), |l, v| l.line.color = v);
        /// Width of the circles around colours.
        width: key("VS-8", Lengths { on: On::Page, bounds: Bounds::POSITIVE },
            |l| Some(l.line.width), |l, v| l.line.width = v);
        /// The pen of `[[pen]]` that draws text and circles.
        pen: key("VS-8", Text { what: "the name of a pen" }, |l| l.line.pen.clone(), |l, v| l.line.pen = Some(v))
            .absent("`color` and `width`");
    }
}

/// The description of `[legend]`.
pub(crate) static TABLE: Table<Legend> = Legend::description(
    "[legend]",
    "The look of each visible node of [transfer] with a name: lit spheres of styles, or colours. Neighbouring nodes of \
     one look share a row. Of a function over labels each row of labels has one.",
);

impl Legend {
    /// The fault of names that are not as many as the rows, with its remedy; none if they are, or if there are none.
    pub fn wrong_names(&self, rows: usize) -> Option<(String, String)> {
        let names = self.names.as_ref().filter(|names| names.len() != rows)?;
        let counted = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
        let [names, rows] = [counted(names.len(), "name"), counted(rows, "row")];
        let what = format!("legend.names has {names}, and the legend has {rows}");
        Some((what, "give one name for each row; \"\" leaves a row out".into()))
    }
}

/// A name of a row, which may be empty.
struct RowName;

impl Shape for RowName {
    fn expected(&self) -> String {
        "a name in quotes".into()
    }

    fn schema(&self) -> Json {
        json!({ "type": "string" })
    }
}

impl Kind for RowName {
    type Of = String;

    fn read(&self, item: &Item, check: &mut Check) -> Option<String> {
        item.text().map(str::to_owned).or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &String) -> Out {
        Out::Text(value.clone())
    }
}
