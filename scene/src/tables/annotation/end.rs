//! Places that annotations name: the centre of a part, or a point.

use crate::document::check::Check;
use crate::document::describe::{Kind, Shape};
use crate::document::item::Item;
use crate::document::kind::{Bounds, Numbers, Rule};
use crate::document::out::Out;
use crate::tables::PartName;
use crate::tables::object::PartNames;
use glam::DVec3;
use serde_json::{Value as Json, json};

/// An end of an arrow or a fan.
#[derive(Clone, Debug, PartialEq)]
pub enum AnnotatedPlace {
    /// The box of a part, where it is moved, and the box's centre.
    Part(PartName),
    /// A point in world space.
    Point(DVec3),
}

/// The name of a part, or a point.
pub(super) struct Places;

const POINT: Numbers<3> = Numbers { what: "a point [x, y, z]", bounds: Bounds::ANY, rule: Rule::Free };

impl Shape for Places {
    fn expected(&self) -> String {
        format!("{}, or {}", PartNames.expected(), POINT.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [PartNames.schema(), POINT.schema()] })
    }
}

impl Kind for Places {
    type Of = AnnotatedPlace;

    fn read(&self, item: &Item, check: &mut Check) -> Option<AnnotatedPlace> {
        match (item.text(), POINT.of(item)) {
            (Some(_), _) => PartNames.read(item, check).map(AnnotatedPlace::Part),
            (None, Some(point)) => Some(AnnotatedPlace::Point(point.into())),
            (None, None) => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &AnnotatedPlace) -> Out {
        match value {
            AnnotatedPlace::Part(name) => PartNames.write(name),
            AnnotatedPlace::Point(point) => POINT.write(&point.to_array()),
        }
    }
}
