//! `dabs` of an intersection: a Gaussian brush on its function of two values ([VS-4]).

use crate::document::check::Check;
use crate::document::declare::table;
use crate::document::describe::{Kind, Shape, Table};
use crate::document::item::Item;
use crate::document::kind::{Bounds, Colors, ListOf, MANY, Number, Numbers, Rule, TableOf};
use crate::document::out::Out;
use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};

table! {
    /// A dab of a Gaussian brush on a function of the value at p and the value at T p.
    #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
    pub struct Dab {
        /// Its centre: the value of the ghost or the background, and that of the selection.
        at: [f64; 2] = [0.0; 2], key("VS-4", AT).required();
        /// Standard deviation of the Gaussian, in units of the values, or one for each value.
        width: [f64; 2] = [1.0; 2], key("VS-4", Widths).required();
        /// Its colour. An opacity in the colour is the dab's at its centre.
        ///
        /// Linear, straight.
        color: [f64; 4] = [0.0, 0.0, 0.0, 1.0], key("VS-4", Colors).required();
    }
}

/// The description of a dab.
static DAB: Table<Dab> = Dab::description(
    "a dab",
    "A dab of a Gaussian brush: its colour and opacity, over the function about one pair of values.",
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
