//! Arrows and fans that objects ask for ([VS-8]).

use super::{AnnotatedPlace, Annotations, ArrowTable, FanTable};
use crate::tables::{ObjectTable, PartName, Scene};

impl Scene {
    /// All annotations: those of tables, then an arrow and a fan from ghost to selection of each object that asks for
    /// them. Nothing hides the arrow: its head ends inside the selection.
    pub fn all_annotations(&self) -> Annotations {
        let ends = |object: &ObjectTable| {
            let name = || object.name.clone();
            [PartName::Ghost(name()), PartName::Selection(name())].map(|part| Some(AnnotatedPlace::Part(part)))
        };
        let mut all = self.annotations.clone();
        all.arrows.extend(self.objects.iter().filter(|object| object.arrow).map(|object| {
            let [from, to] = ends(object);
            ArrowTable { from, to, occluded: false, ..ArrowTable::default() }
        }));
        all.fans.extend(self.objects.iter().filter(|object| object.fan).map(|object| {
            let [from, to] = ends(object);
            FanTable { from, to, ..FanTable::default() }
        }));
        all
    }
}
