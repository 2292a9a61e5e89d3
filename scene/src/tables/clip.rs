//! `[[clip]]`: planes that cut parts of the volume away ([RAY-8]).

use super::nodes::StyleName;
use super::object::{PartName, PartNames};
use crate::color::Rgba;
use crate::document::check::Check;
use crate::document::declare::{choices, table, unless_empty};
use crate::document::describe::{Instead, Kind, Shape, Table};
use crate::document::fault::Problem;
use crate::document::item::Item;
use crate::document::kind::{Bounds, Colors, FEW, ListOf, Numbers, Rule};
use crate::document::out::Out;
use glam::DVec3;
use serde_json::{Value as Json, json};

table! {
    /// One table `[[clip]]`: a plane by `point` and `normal`, or a box. The default says neither yet.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Clip {
        /// A point on the plane.
        point: Option<DVec3> = None, key("RAY-8", POINT).absent("none: `box` has planes of its own");
        /// Normal of the plane, of any length. The side to which it points is cut away.
        normal: Option<DVec3> = None, key("RAY-8", NORMAL).absent("none: `box` has planes of its own");
        /// The box that is kept, in place of a plane: lowest and highest coordinate on each axis.
        extent: Option<[[f64; 2]; 3]> = None,
            key("RAY-8", BoxKind).named("box").absent("a plane by `point` and `normal`");
        /// The space of `point`, `normal` and `box`. In index space the planes of a box follow the axes of the grid.
        space: ClipSpace = ClipSpace::World, key("RAY-8", ClipSpace::KIND);
        /// The things that are cut.
        applies: Vec<PartName> = Vec::new(),
            key("RAY-8", ListOf { what: "a list of names", most: FEW, each: PartNames }, |c| unless_empty(&c.applies))
                .absent("everything");
        /// Colour that a cut shows, unlit. Its own opacity multiplies that of the sample.
        ///
        /// Linear, straight.
        cap: Option<Rgba> = None, key("RAY-8", Colors).absent("the cut's own colour");
        /// The name of a style that a cut shows, in place of a colour.
        style: Option<String> = None, key("RAY-8", StyleName).absent("the cut's own colour");
    }
}

choices! {
    /// A space of coordinates ([SPACE-2]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ClipSpace {
        /// World space.
        World = "world",
        /// The volume's index space: voxels, counted from 0.
        Index = "index",
    }
}

const POINT: Numbers<3> = Numbers { what: "a point [x, y, z]", bounds: Bounds::ANY, rule: Rule::Free };
const NORMAL: Numbers<3> = Numbers { what: "a direction [x, y, z]", bounds: Bounds::ANY, rule: Rule::Direction };
const RANGE: Numbers<2> = Numbers { what: "two numbers", bounds: Bounds::ANY, rule: Rule::Ascending };

/// The description of a table `[[clip]]`.
pub(crate) static TABLE: Table<Clip> = Table {
    instead: &[Instead { one: "box", others: &["point", "normal"] }, Instead { one: "style", others: &["cap"] }],
    check: |_, check| {
        if check.has("box") {
            return;
        }
        let missing = match (check.has("point"), check.has("normal")) {
            (true, true) => return,
            (false, true) => ("point", "point = [x, y, z], which lies on the plane".to_string()),
            (true, false) => ("normal", "normal = [x, y, z], which points to the side that is cut away".to_string()),
            (false, false) => {
                ("point", "point = [x, y, z] and normal = [x, y, z], or box = [[x0, x1], [y0, y1], [z0, z1]]".into())
            }
        };
        check.fault_in(missing.0, Problem::Missing { expected: missing.1 });
    },
    ..Clip::description(
        "a clip",
        "A plane that cuts part of the volume away, or a box that is kept: two planes on each axis. It cuts the volume, \
         iso-surfaces, halos, points and strokes alike.",
    )
};

/// Three ranges, one for each axis.
struct BoxKind;

impl Shape for BoxKind {
    fn expected(&self) -> String {
        "a box [[x0, x1], [y0, y1], [z0, z1]], the lower number first on each axis".into()
    }

    fn schema(&self) -> Json {
        json!({ "type": "array", "items": RANGE.schema(), "minItems": 3, "maxItems": 3 })
    }
}

impl Kind for BoxKind {
    type Of = [[f64; 2]; 3];

    fn read(&self, item: &Item, check: &mut Check) -> Option<[[f64; 2]; 3]> {
        let ranges: Option<Vec<[f64; 2]>> = item.list().and_then(|items| items.iter().map(|i| RANGE.of(i)).collect());
        let ranges = ranges.and_then(|ranges| ranges.try_into().ok());
        ranges.or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &[[f64; 2]; 3]) -> Out {
        Out::List(value.iter().map(|range| RANGE.write(range)).collect())
    }
}
