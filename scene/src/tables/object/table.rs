//! The description of `[[object]]`.

use super::motion::{Factors, Matrix, ROTATION};
use super::strokes::STROKES;
use super::{GhostTable, Motion, PaintStroke, ghost};
use crate::document::check::Check;
use crate::document::declare::{choices, table};
use crate::document::describe::{Instead, Kind, Shape, Table};
use crate::document::fault::Problem;
use crate::document::item::Item;
use crate::document::kind::{Bounds, Flag, Lengths, ListOf, MANY, Number, Numbers, On, PathTo, Rule, TableOf, Text};
use crate::document::out::Out;
use crate::quantity::Quantity;
use crate::tables::over::Label;
use crate::tables::unit_pairs::UnitPairs;
use crate::tables::volume::Quantile;
use crate::tables::{GradientRange, LabelKey, Length, Outside, Shading, Styles, Transfer, shading, styles, transfer};
use serde_json::{Value as Json, json};
use std::path::PathBuf;

table! {
    /// One table `[[object]]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct ObjectTable {
        /// Name by which other tables call it.
        name: String = String::new(), key("VS-2", Text { what: "the name of an object" },
            |o| (!o.name.is_empty()).then(|| o.name.clone())).absent("\"object N\", N its place in the list, from 0");
        /// Data of its own, on a grid of its own: nothing is resampled. Such an object takes nothing from the background.
        volume: Option<PathBuf> = None, key("VS-2", PathTo { what: "a volume" }).absent("the data of [volume]");
        /// The label volume beside its own data.
        labels: Option<PathBuf> = None, key("VS-2", PathTo { what: "a label volume" }).absent("no labels");
        /// The names of these labels: a CSV file with an id and a name on each line.
        label_names: Option<PathBuf> = None,
            key("VS-2", PathTo { what: "a table of names" }).absent("labels have no names");
        /// The values of its own data that `unit = "normalized"` maps to 0 and 1.
        range: Option<[f64; 2]> = None, key("VAL-1", RANGE).absent("the data's own");
        /// The gradient of its own data that |g| = 1 stands for.
        gradient_range: GradientRange = GradientRange::Quantile(0.999), key("VAL-2", Quantile,
            |o| o.volume.is_some().then_some(o.gradient_range)).absent("\"q0.999\"");
        /// Which values of its own data lie outside a surface.
        outside: Outside = Outside::Low, key("NORM-1", Outside::KIND,
            |o| o.volume.is_some().then_some(o.outside)).absent("\"low\"");
        /// A selection volume with memberships from 0 to 1, on a grid of its own. Outside its box nothing is selected.
        selection: Option<PathBuf> = None,
            key("VS-2", PathTo { what: "a selection volume" }).absent("`label`, `value`, or all of the data");
        /// The label that is selected, by id or by name, or a list of them.
        label: Option<Vec<LabelKey>> = None, key("VS-2", Labels).absent("`selection`, `value`, or all of the data");
        /// Membership over the value: pairs [value, membership], linear between them and constant beyond both ends.
        ///
        /// In non-decreasing order of the value.
        value: Option<Vec<[f64; 2]>> = None, key("VS-2", UnitPairs).absent("`selection`, `label`, or all of the data");
        /// Strokes of brushes, grown regions and watershed basins that paint the selection onto the data, in their order.
        strokes: Option<Vec<PaintStroke>> = None,
            key("VS-6", STROKES).absent("`selection`, `label`, `value`, or all of the data");
        /// M.
        motion: Motion = Motion::NONE;
        /// The way that the selection is moved.
        shift: key("VS-2", WAY,
            |o| o.motion.matrix.is_none().then(|| o.motion.shift.to_array()),
            |o, v| o.motion.shift = v.into()).named("move");
        /// Factor by which the selection is scaled about `center`, or one for each world axis; negative reflects.
        scale: key("VS-2", Factors,
            |o| o.motion.matrix.is_none().then(|| o.motion.scale.to_array()),
            |o, v| o.motion.scale = v.into());
        /// Rotation of the selection about `center`, after it was scaled.
        rotate: key("VS-2", TableOf(&ROTATION), |o| o.motion.rotation, |o, v| o.motion.rotation = Some(v))
            .absent("no rotation");
        /// The point about which the selection is scaled and rotated.
        center: key("VS-2", POINT,
            |o| o.motion.center.map(|c| c.to_array()),
            |o, v| o.motion.center = Some(v.into())).absent("the centre of the selection's box");
        /// The motion as an affine matrix by rows, the last [0, 0, 0, 1]; in place of the other four.
        matrix: key("VS-2", Matrix, |o| o.motion.matrix, |o, v| o.motion.matrix = Some(v))
            .absent("`move`, `scale`, `rotate` and `center`");
        /// Motion of the selection while `[orbit]` turns the camera. Its ghost and the background stay in the world.
        ///
        /// The camera of the first frame counts.
        interaction: InteractionState = InteractionState::Integrated, key("VS-9", InteractionState::KIND);
        /// γ: how far the background before the selection fades, 1 all of it. Contours of strong boundaries fade last.
        ghosting: f64 = 0.0, key("VS-7", UNIT).needs(&[Quantity::GradientMagnitudeRange]);
        /// γ before the ghost.
        ghosting_of_ghost: f64 = 0.0, key("VS-7", UNIT).needs(&[Quantity::GradientMagnitudeRange]);
        /// The depth up to which the background is cut.
        cut: Cut = Cut::Bounds, key("VS-7", Cut::KIND);
        /// σ of the Gaussian that turns the cut into a funnel.
        ///
        /// On the page.
        funnel: Option<Length> = None,
            key("VS-7", Lengths { on: On::Picture, bounds: Bounds::NOT_NEGATIVE }).absent("a hard cut");
        /// Whether an arrow leads from the ghost to the selection, as a table `[[arrow]]` with `occluded = false`.
        arrow: bool = false, key("VS-8", Flag);
        /// Whether a fan joins the ghost and the selection, as a table `[[fan]]` without further keys.
        fan: bool = false, key("VS-8", Flag);
        /// Whether it is the object that a person works on. No pixel depends on it.
        active: bool = false, key("VS-2", Flag);
        /// Whether a viewer highlights it. No pixel depends on it.
        highlight: bool = false, key("VS-2", Flag);
        /// Its own colours or styles, and opacities.
        transfer: Option<Transfer> = None,
            key("VS-2", TableOf(&transfer::TABLE)).absent("the picture's").needs(&[Quantity::Value]);
        /// The lit-sphere pictures that its function names, over those of the picture.
        styles: Option<Styles> = None, key("VS-2", TableOf(&styles::TABLE)).absent("the picture's");
        /// Its own light on a regular function.
        shading: Option<Shading> = None,
            key("VS-2", TableOf(&shading::TABLE)).absent("the picture's").needs(&[Quantity::Gradient]);
        /// The look of its ghost.
        ghost: Option<GhostTable> = None, key("VS-2", TableOf(&ghost::TABLE)).absent("the object's");
    }
}

choices! {
    /// The depth d up to which the background of a ray is cut away ([VS-7]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum Cut {
        /// The far side of the object's oriented bounding box: the paper's.
        Bounds = "bounds",
        /// The last sample that belongs to the object.
        Object = "object",
    }
}

choices! {
    /// The part of a change of camera that a selection takes (VolumeShop 6.3; [VS-9]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum InteractionState {
        /// The selection belongs to the scene: M' = M.
        Integrated = "integrated",
        /// The selection keeps its placement before the eye: M' = V'⁻¹·V·M.
        Decoupled = "decoupled",
        /// The centre of the selection keeps its pixel and its eye depth, and the selection turns with the scene: M' = M
        /// followed by a translation.
        Pinned = "pinned",
    }
}

impl ObjectTable {
    /// The files that the object names, and the folders of its themes.
    pub(crate) fn files(&self) -> impl Iterator<Item = &PathBuf> {
        let own = [&self.volume, &self.labels, &self.label_names, &self.selection].into_iter().flatten();
        let ghost = self.ghost.iter();
        let transfers = self.transfer.iter().chain(ghost.clone().filter_map(|ghost| ghost.transfer.as_ref()));
        let styles = self.styles.iter().chain(ghost.filter_map(|ghost| ghost.styles.as_ref()));
        own.chain(transfers.flat_map(Transfer::volumes)).chain(styles.flat_map(Styles::paths))
    }

    /// Returns the object with a name. An object without a name gets one from its place in the list.
    pub(crate) fn named(self, place: usize) -> Self {
        if self.name.is_empty() { Self { name: format!("object {place}"), ..self } } else { self }
    }
}

/// A number from 0 to 1.
const UNIT: Number = Number { bounds: Bounds::UNIT, unit: "" };
const POINT: Numbers<3> = Numbers { what: "a point [x, y, z]", bounds: Bounds::ANY, rule: Rule::Free };
const WAY: Numbers<3> = Numbers { what: "a way [x, y, z] in world units", bounds: Bounds::ANY, rule: Rule::Free };
const RANGE: Numbers<2> = Numbers { what: "a range [lo, hi]", bounds: Bounds::ANY, rule: Rule::Ascending };

/// Keys that stand beside `volume`.
const OF_OWN_VOLUME: [&str; 5] = ["labels", "label_names", "range", "gradient_range", "outside"];

/// The description of a table `[[object]]`.
pub(crate) static TABLE: Table<ObjectTable> = Table {
    instead: &[
        Instead { one: "selection", others: &["label", "value", "strokes"] },
        Instead { one: "label", others: &["value", "strokes"] },
        Instead { one: "value", others: &["strokes"] },
        Instead { one: "matrix", others: &["move", "scale", "rotate", "center"] },
    ],
    check: |object, check| {
        if object.volume.is_none() && check.sound(&["volume"]) {
            for key in OF_OWN_VOLUME.into_iter().filter(|key| check.has(key)).collect::<Vec<_>>() {
                let what = format!("{key} is about the object's own data, and the object has none");
                let remedy = "add volume = \"…\", or write the key in [volume]".into();
                check.fault_in(key, Problem::Contradiction { what, remedy });
            }
        }
        let name = if object.name.is_empty() { String::new() } else { format!(" {:?}", object.name) };
        object.motion.check(&format!("the object{name}"), check);
    },
    ..ObjectTable::description(
        "an object",
        "A selection of the data with a look of its own. Moved, it leaves a ghost at its original place; the rest is the \
         background, which can be cut away before the object.",
    )
};

/// A label, or a list of labels.
struct Labels;

const LABELS: ListOf<Label> = ListOf { what: "a list of labels", most: MANY, each: Label };

impl Shape for Labels {
    fn expected(&self) -> String {
        format!("{}, or {}", Label.expected(), LABELS.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [Label.schema(), LABELS.schema()] })
    }
}

impl Kind for Labels {
    type Of = Vec<LabelKey>;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Vec<LabelKey>> {
        if item.list().is_some() { LABELS.read(item, check) } else { Some(vec![Label.read(item, check)?]) }
    }

    fn write(&self, value: &Vec<LabelKey>) -> Out {
        if let [one] = &value[..] { Label.write(one) } else { LABELS.write(value) }
    }
}
