//! `strokes` of an object: what paints its selection, one stroke after the other ([VS-6]).

use crate::document::Problem;
use crate::document::check::Check;
use crate::document::declare::{choices, table};
use crate::document::describe::{Instead, Kind, Shape, Table};
use crate::document::item::{Item, Value};
use crate::document::kind::{Bounds, Lengths, ListOf, MANY, Number, Numbers, On, Rule, TableOf};
use crate::document::out::Out;
use crate::tables::Length;
use glam::DVec3;
use serde_json::{Value as Json, json};

table! {
    /// One stroke. The default does not say yet what is painted.
    #[derive(Clone, Debug, PartialEq)]
    pub struct PaintStroke {
        /// The part of the volume that is painted.
        target: PaintTarget = UNSAID;
        /// The pixel at which the volume is painted, column and row from the upper left corner, from 0. A whole number is
        /// the centre of a pixel. The brush is at the first visible structure, as `drypoint pick` tells it.
        pixel: key("VS-6", Numbers { what: "a pixel [x, y]", bounds: Bounds::NOT_NEGATIVE, rule: Rule::Free },
            |s| match s.target {
                PaintTarget::Pixel(pixel) => Some(pixel),
                _ => None,
            },
            |s, v| s.target = PaintTarget::Pixel(v)).absent("one of `at`, `grow` and `watershed`");
        /// A point of the world, about which the volume is painted.
        at: key("VS-6", POINT,
            |s| match s.target {
                PaintTarget::At(p) if !s.is_unsaid() => Some(p.to_array()),
                _ => None,
            },
            |s, v| s.target = PaintTarget::At(DVec3::from_array(v))).absent("one of `pixel`, `grow` and `watershed`");
        /// A point of the world from which a region grows, over neighbours whose values differ from the point's by at most
        /// `tolerance`.
        grow: key("VS-6", POINT,
            |s| match s.target {
                PaintTarget::Grow(p) => Some(p.to_array()),
                _ => None,
            },
            |s, v| s.target = PaintTarget::Grow(DVec3::from_array(v)))
            .absent("one of `pixel`, `at` and `watershed`");
        /// A point of the world from which the volume is flooded, over the gradient magnitude. Strokes of this kind that
        /// stand one after the other flood together, each up to the others; each paints its own basin by its own mode.
        watershed: key("VS-6", POINT,
            |s| match s.target {
                PaintTarget::Watershed(p) => Some(p.to_array()),
                _ => None,
            },
            |s, v| s.target = PaintTarget::Watershed(DVec3::from_array(v)))
            .absent("one of `pixel`, `at` and `grow`");
        /// The change of the selection.
        mode: PaintMode = PaintMode::Add, key("VS-6", PaintMode::KIND);
        /// Radius of the brush. With 0 it is one voxel.
        radius: Length = Length::Voxels(5.0), key("VS-6", Lengths { on: On::World, bounds: Bounds::NOT_NEGATIVE },
            |s| s.has_brush().then_some(s.radius));
        /// Shape of the brush.
        brush: Brush = Brush::Gaussian, key("VS-6", Brush::KIND, |s| s.has_brush().then_some(s.brush));
        /// The largest difference of a value of a grown region from the seed's.
        tolerance: f64 = 0.0, key("VS-6", Number { bounds: Bounds::NOT_NEGATIVE, unit: "" },
            |s| s.grows().then_some(s.tolerance));
        /// The neighbours of a voxel in a grown region: 6 share a face, 18 a face or an edge, 26 also a corner.
        connect: Connectivity = Connectivity::Faces, key("VS-6", Neighbours, |s| s.grows().then_some(s.connect));
    }
}

/// The target of a stroke of which no key has said it yet.
const UNSAID: PaintTarget = PaintTarget::At(DVec3::NAN);

impl PaintStroke {
    fn is_unsaid(&self) -> bool {
        matches!(self.target, PaintTarget::At(p) if p.is_nan())
    }

    /// Whether the keys of a brush act.
    fn has_brush(&self) -> bool {
        matches!(self.target, PaintTarget::Pixel(_) | PaintTarget::At(_))
    }

    /// Whether the keys of a region act.
    fn grows(&self) -> bool {
        matches!(self.target, PaintTarget::Grow(_)) || self.is_unsaid()
    }
}

/// The part of the volume that a stroke paints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PaintTarget {
    /// A brush about the first visible structure at a pixel: column and row from 0; whole numbers are centres of pixels.
    Pixel([f64; 2]),
    /// A brush about a point of the world.
    At(DVec3),
    /// The region about a point of the world in which values are like that of the point.
    Grow(DVec3),
    /// The watershed basin of a point of the world.
    Watershed(DVec3),
}

choices! {
    /// The shape of a brush: its membership b at a distance r from the centre, R the radius ([VS-6]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Brush {
        /// b = exp(−½ (r/σ)²) up to R, with σ = R/3.
        Gaussian = "gaussian",
        /// b = 1 up to R.
        Ball = "ball",
        /// b = 1 up to R along each axis of the world.
        Box = "box",
    }
}

choices! {
    /// The change of a membership f by a brush of membership b, within [0, 1] ([VS-6]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum PaintMode {
        /// f + b, at most 1.
        Add = "add",
        /// f − b, at least 0.
        Subtract = "subtract",
        /// The larger of f and b.
        Maximum = "maximum",
        /// b.
        Replace = "replace",
    }
}

/// The neighbours of a voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Connectivity {
    /// The 6 voxels that share a face.
    Faces,
    /// The 18 voxels that share a face or an edge.
    Edges,
    /// The 26 voxels that share a face, an edge or a corner.
    Corners,
}

impl Connectivity {
    /// Every connectivity.
    const ALL: [Self; 3] = [Self::Faces, Self::Edges, Self::Corners];

    /// The number of neighbours.
    pub fn neighbours(self) -> u64 {
        match self {
            Self::Faces => 6,
            Self::Edges => 18,
            Self::Corners => 26,
        }
    }
}

/// 6, 18 or 26.
struct Neighbours;

impl Shape for Neighbours {
    fn expected(&self) -> String {
        "6, 18 or 26".into()
    }

    fn schema(&self) -> Json {
        json!({ "enum": Connectivity::ALL.map(Connectivity::neighbours) })
    }
}

impl Kind for Neighbours {
    type Of = Connectivity;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Connectivity> {
        let found = Connectivity::ALL
            .into_iter()
            .find(|connect| matches!(item.value, Value::Whole(n) if u64::try_from(n) == Ok(connect.neighbours())));
        found.or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &Connectivity) -> Out {
        Out::Whole(value.neighbours())
    }
}

/// A point of the world.
const POINT: Numbers<3> = Numbers { what: "a point [x, y, z]", bounds: Bounds::ANY, rule: Rule::Free };

/// The keys of which a stroke has one.
const TARGETS: [&str; 4] = ["pixel", "at", "grow", "watershed"];

/// The description of a stroke.
static STROKE: Table<PaintStroke> = Table {
    instead: &[
        Instead { one: "pixel", others: &["at", "grow", "watershed", "tolerance", "connect"] },
        Instead { one: "at", others: &["grow", "watershed", "tolerance", "connect"] },
        Instead { one: "grow", others: &["watershed", "radius", "brush"] },
        Instead { one: "watershed", others: &["radius", "brush", "tolerance", "connect"] },
    ],
    check: |_, check| {
        if !TARGETS.iter().any(|target| check.has(target)) {
            let expected = "pixel = [x, y], at = [x, y, z], grow = [x, y, z] or watershed = [x, y, z]".into();
            check.fault_in("pixel", Problem::Missing { expected });
        }
    },
    ..PaintStroke::description(
        "a stroke",
        "One stroke of a brush, one grown region or one basin of a watershed. Voxels that the transfer function does not \
         show are not painted.",
    )
};

/// The kind of `strokes`.
pub(super) const STROKES: ListOf<TableOf<PaintStroke>> =
    ListOf { what: "a list of strokes", most: MANY, each: TableOf(&STROKE) };
