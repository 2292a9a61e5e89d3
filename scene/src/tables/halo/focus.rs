//! `seed.focus` of a halo: seeds near a point or a polyline ([HALO-2]).

use crate::document::Problem;
use crate::document::declare::table;
use crate::document::describe::{Instead, Table};
use crate::document::kind::{Bounds, Lengths, ListOf, MANY, Numbers, On, Rule};
use crate::tables::Length;
use glam::DVec3;

table! {
    /// The table `seed.focus`: h_p = clamp₀₁(1 − (dist − inner)/falloff). The default has no points yet.
    #[derive(Clone, Debug, PartialEq)]
    pub struct HaloFocus {
        /// The point, or the vertices of the polyline.
        points: FocusPoints = FocusPoints::World(Vec::new());
        /// A point, or the vertices of a polyline, in world space.
        at: key("HALO-2", POINTS,
            |f| match &f.points {
                FocusPoints::World(points) if !points.is_empty() => {
                    Some(points.iter().map(|p| p.to_array()).collect())
                }
                _ => None,
            },
            |f, v| f.points = FocusPoints::World(v.into_iter().map(DVec3::from_array).collect()))
            .absent("`pixels`");
        /// Pixels of the picture in place of `at`: column and row from the upper left corner, from 0. A whole number is
        /// the centre of a pixel. Each is the first visible place on its ray, as `drypoint pick` tells it.
        pixels: key("HALO-12", PIXELS,
            |f| f.pixels().map(<[_]>::to_vec),
            |f, v| f.points = FocusPoints::Pixels(v)).absent("`at`");
        /// The distance up to which the factor is 1.
        inner: Length = Length::World(0.0), key("HALO-2", DISTANCE);
        /// The length over which it falls to 0; 0 is a step.
        falloff: Length = Length::Voxels(20.0), key("HALO-2", DISTANCE);
    }
}

/// The points of a focus; at least one.
#[derive(Clone, Debug, PartialEq)]
pub enum FocusPoints {
    /// In world space.
    World(Vec<DVec3>),
    /// In pixels of the picture, column and row from 0, to be picked ([HALO-12]). A whole number is a pixel's centre.
    Pixels(Vec<[f64; 2]>),
}

impl HaloFocus {
    /// The pixels that are still to be picked; none where the focus is in the world.
    pub fn pixels(&self) -> Option<&[[f64; 2]]> {
        match &self.points {
            FocusPoints::World(_) => None,
            FocusPoints::Pixels(pixels) => Some(pixels),
        }
    }

    /// Puts points of the world in place of pixels.
    pub fn set_points(&mut self, points: Vec<DVec3>) {
        self.points = FocusPoints::World(points);
    }
}

/// A length from a focus.
const DISTANCE: Lengths = Lengths { on: On::World, bounds: Bounds::NOT_NEGATIVE };

/// Points of the world.
const POINTS: ListOf<Numbers<3>> = ListOf {
    what: "a list of points",
    most: MANY,
    each: Numbers { what: "a point [x, y, z]", bounds: Bounds::ANY, rule: Rule::Free },
};

/// Points of the picture.
const PIXELS: ListOf<Numbers<2>> = ListOf {
    what: "a list of pixels",
    most: MANY,
    each: Numbers { what: "a pixel [x, y]", bounds: Bounds::NOT_NEGATIVE, rule: Rule::Free },
};

/// The description of `seed.focus`.
pub(super) static TABLE: Table<HaloFocus> = Table {
    instead: &[Instead { one: "pixels", others: &["at"] }],
    check: |focus, check| {
        let (FocusPoints::World(points), true) = (&focus.points, check.sound(&["at", "pixels"])) else { return };
        if points.is_empty() {
            let expected = format!("at = [[x, y, z]] or pixels = [[x, y]] in {}", check.key());
            check.fault_in("at", Problem::Missing { expected });
        }
    },
    ..HaloFocus::description(
        "seed.focus of a halo",
        "Seeds near a point or a polyline: the factor is 1 up to the distance `inner` from it and falls to 0 over \
         `falloff`.",
    )
};
