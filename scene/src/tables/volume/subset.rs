//! `box` and `stride` of `[volume]`: less of a volume ([VOL-1]).

use super::layout::LONGEST_AXIS;
use crate::document::check::Check;
use crate::document::describe::{Kind, Shape};
use crate::document::item::Item;
use crate::document::kind::{Whole, Wholes};
use crate::document::out::Out;
use serde_json::{Value as Json, json};

/// A range of indices, both ends included.
const RANGE: Wholes<2> = Wholes {
    what: "a range [first, last]",
    each: Whole { lo: 0, hi: LONGEST_AXIS },
    product: u64::MAX >> 4,
    of_what: "voxels",
};

/// Three ranges of indices, `[[first, last], [first, last], [first, last]]`.
pub(super) struct IndexBox;

impl IndexBox {
    fn of(item: &Item) -> Option<[[usize; 2]; 3]> {
        let ranges: Option<Vec<[usize; 2]>> = item.list()?.iter().map(|range| RANGE.of(range)).collect();
        ranges?.try_into().ok().filter(|ranges: &[[usize; 2]; 3]| ranges.iter().all(|[first, last]| first <= last))
    }
}

impl Shape for IndexBox {
    fn expected(&self) -> String {
        "a range [first, last] of indices from 0 along each of x, y, z, the lower one first".into()
    }

    fn schema(&self) -> Json {
        json!({ "type": "array", "items": RANGE.schema(), "minItems": 3, "maxItems": 3 })
    }
}

impl Kind for IndexBox {
    type Of = [[usize; 2]; 3];

    fn read(&self, item: &Item, check: &mut Check) -> Option<[[usize; 2]; 3]> {
        Self::of(item).or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &[[usize; 2]; 3]) -> Out {
        Out::List(value.iter().map(|range| RANGE.write(range)).collect())
    }
}

/// Steps between voxels: one for all axes, or three.
pub(super) struct Strides;

impl Strides {
    const ONE: Whole = Whole { lo: 1, hi: LONGEST_AXIS };
    const THREE: Wholes<3> =
        Wholes { what: "three steps [x, y, z]", each: Self::ONE, product: u64::MAX >> 4, of_what: "voxels" };
}

impl Shape for Strides {
    fn expected(&self) -> String {
        format!("a whole number{}, or three of them for x, y, z", Self::ONE.words())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [Self::ONE.schema(), Self::THREE.schema()] })
    }
}

impl Kind for Strides {
    type Of = [usize; 3];

    fn read(&self, item: &Item, check: &mut Check) -> Option<[usize; 3]> {
        let one = Self::ONE.of(item).and_then(|n| usize::try_from(n).ok()).map(|n| [n; 3]);
        one.or_else(|| Self::THREE.of(item)).or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &[usize; 3]) -> Out {
        match *value {
            [x, y, z] if x == y && y == z => Out::Whole(x as u64),
            _ => Self::THREE.write(value),
        }
    }
}
