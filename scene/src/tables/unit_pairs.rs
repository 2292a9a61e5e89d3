//! Piecewise-linear functions from values to [0, 1], as pairs ([SCN-2]).

use crate::document::Problem;
use crate::document::check::Check;
use crate::document::describe::{Kind, Shape};
use crate::document::item::Item;
use crate::document::kind::{Bounds, ListOf, MANY};
use crate::document::out::Out;
use serde_json::{Value as Json, json};

/// A list of pairs [value, number], the number in [0, 1], in non-decreasing order of the value.
pub(super) struct UnitPairs;

/// A value and a number from 0 to 1.
struct Pair;

/// The pairs, whatever their order.
const PAIRS: ListOf<Pair> = ListOf { what: "a list of pairs", most: MANY, each: Pair };

impl Shape for Pair {
    fn expected(&self) -> String {
        "[value, number], the number from 0 to 1".into()
    }

    fn schema(&self) -> Json {
        let number = json!({ "type": "number" });
        json!({ "type": "array", "prefixItems": [number, Bounds::UNIT.schema()], "minItems": 2, "maxItems": 2 })
    }
}

impl Kind for Pair {
    type Of = [f64; 2];

    fn read(&self, item: &Item, check: &mut Check) -> Option<[f64; 2]> {
        let numbers = item.list().map(|list| list.iter().map(Item::number).collect::<Vec<_>>());
        match numbers.as_deref() {
            Some(&[Some(value), Some(factor)]) if Bounds::UNIT.contain(factor) => Some([value, factor]),
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &[f64; 2]) -> Out {
        Out::numbers(value)
    }
}

impl Shape for UnitPairs {
    fn expected(&self) -> String {
        PAIRS.expected()
    }

    fn schema(&self) -> Json {
        PAIRS.schema()
    }
}

impl Kind for UnitPairs {
    type Of = Vec<[f64; 2]>;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Vec<[f64; 2]>> {
        let nodes = PAIRS.read(item, check)?;
        match nodes.windows(2).position(|pair| pair[1][0] < pair[0][0]) {
            None => Some(nodes),
            Some(i) => {
                let [before, after] = [nodes[i][0], nodes[i + 1][0]];
                let what = format!("pair {} at {after} stands after pair {i} at {before}", i + 1);
                let remedy = "put the pairs in non-decreasing order of the value".into();
                check.fault_in_list(&format!("[{}]", i + 1), Problem::Contradiction { what, remedy });
                None
            }
        }
    }

    fn write(&self, value: &Vec<[f64; 2]>) -> Out {
        PAIRS.write(value)
    }
}
