//! `dabs` of an intersection: a Gaussian brush on its function of two values ([VS-4]).

use crate::document::check::Check;
use crate::document::declare::keys;
use crate::document::describe::{Kind, Shape, Table};
use crate::document::item::Item;
use crate::document::kind::{Bounds, Colors, ListOf, MANY, Number, Numbers, Rule, TableOf};
use crate::document::out::Out;
use serde::Serialize;
use serde_json::{Value as Json, json};

/// A dab of a Gaussian brush on a function of the value at p and the value at T p.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Dab {
    /// Both values at its centre.
    pub at: [f64; 2],
    /// The standard deviations along both values, above 0.
    pub width: [f64; 2],
    /// Its linear straight colour, and its opacity at the centre.
    pub color: [f64; 4],
}

/// The description of a dab.
static DAB: Table<Dab> = Table::new(
    "a dab",
    "A dab of a Gaussian brush: its colour and opacity, over the function about one pair of values.",
    || Dab { at: [0.0; 2], width: [1.0; 2], color: [0.0, 0.0, 0.0, 1.0] },
    keys! { Dab {
        /// Its centre: the value of the ghost or the background, and that of the selection.
        at: key("VS-4", AT).required();
        /// Standard deviation of the Gaussian, in units of the values, or one for each value.
        width: key("VS-4", Widths).required();
        /// Its colour. An opacity in the colour is the dab's at its centre.
        color: key("VS-4", Colors).required();
    } },
);

/// The kind of `dabs`.
pub(super) const DABS: ListOf<TableOf<Dab>> = ListOf { what: "a list of dabs", most: MANY, each: TableOf(&DAB) };

const AT: Numbers<2> = Numbers { what: "two values [v, w]", bounds: Bounds::ANY, rule: Rule::Free };

/// A width for both values, or one for each.
struct Widths;

const WIDTH: Number = Number { bounds: Bounds::POSITIVE, unit: "" };
const WIDTHS: Numbers<2> = Numbers { what: "two of them [v, w]", bounds: Bounds::POSITIVE, rule: Rule::Free };

impl Shape for Widths {
    fn expected(&self) -> String {
        format!("{}, or {}", WIDTH.expected(), WIDTHS.what)
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [WIDTH.schema(), WIDTHS.schema()] })
    }
}

impl Kind for Widths {
    type Of = [f64; 2];

    fn read(&self, item: &Item, check: &mut Check) -> Option<[f64; 2]> {
        let one = item.number().filter(|&x| WIDTH.bounds.contain(x)).map(|x| [x; 2]);
        one.or_else(|| WIDTHS.of(item)).or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &[f64; 2]) -> Out {
        if value[0] == value[1] { Out::Number(value[0]) } else { WIDTHS.write(value) }
    }
}
