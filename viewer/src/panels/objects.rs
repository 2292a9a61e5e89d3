//! Objects: how each is selected, painted and moved.

use super::handle::Handle;
use super::keys::{Filter, tree};
use super::nodes::table;
use super::paint::PaintTool;
use super::{Panel, PictureArea};
use crate::camera::{number, place};
use crate::document::{Document, Edit};
use crate::key::KeyPath;
use crate::schema::Node;
use crate::session::Session;
use drypoint::scene::glam::DVec3;
use drypoint::scene::source::Disk;
use drypoint::scene::style::Theme;
use drypoint::scene::tables::{self, NodeColor, ObjectTable, Unit};
use eframe::egui::{self, Color32, ComboBox, ScrollArea, Stroke, Ui};
use toml_edit::{Array, InlineTable, Item, Value};

/// The style of what is painted, if the theme has it.
const STYLE: &str = "muscle";

/// The colour of what is painted, in linear light: #b4483c.
const COLOR: [f64; 3] = [0.456, 0.065, 0.045];

/// The keys of an object that the panel shows, in their order.
const KEYS: [&str; 8] = ["name", "ghosting", "funnel", "move", "rotate", "scale", "interaction", "arrow"];

/// The keys of which an object has one at most: they say how it is selected.
const SELECTIONS: [(&str, &str); 4] =
    [("strokes", "the brush"), ("label", "labels"), ("value", "values"), ("selection", "a file")];

/// Colours of the axes x, y and z.
const AXES: [(DVec3, &str, Color32); 3] = [
    (DVec3::X, "x", Color32::from_rgb(222, 104, 92)),
    (DVec3::Y, "y", Color32::from_rgb(116, 186, 104)),
    (DVec3::Z, "z", Color32::from_rgb(104, 150, 226)),
];

/// The panel of objects.
pub(super) struct ObjectsPanel {
    /// Descriptions of an object's keys.
    keys: Vec<Node>,
    chosen: usize,
    tool: PaintTool,
    /// Whether the panel is in front; the object then has handles.
    is_shown: bool,
}

impl Default for ObjectsPanel {
    fn default() -> Self {
        let keys = Node::scene().children().iter().find(|key| key.name == "object").map(|key| key.children().to_vec());
        Self { keys: keys.unwrap_or_default(), chosen: 0, tool: PaintTool::default(), is_shown: false }
    }
}

impl Panel for ObjectsPanel {
    fn title(&self) -> &'static str {
        "Objects"
    }

    fn ui(&mut self, ui: &mut Ui, session: &mut Session) {
        self.is_shown = true;
        let Some(scene) = session.scene.clone() else {
            ui.weak("The volume is being read.");
            return;
        };
        ui.horizontal(|ui| {
            self.chosen = self.chosen.min(scene.objects.len());
            let name = |i: usize| scene.objects.get(i).map_or("a new object", |object| object.name.as_str());
            let combo = ComboBox::from_id_salt("object").selected_text(name(self.chosen)).width(150.0);
            let shown = combo.show_ui(ui, |ui| {
                for i in 0..=scene.objects.len() {
                    ui.selectable_value(&mut self.chosen, i, name(i));
                }
            });
            crate::widgets::named(&shown.response, "Object");
            if ui.add_enabled(self.chosen < scene.objects.len(), egui::Button::new("Remove")).clicked() {
                let key = KeyPath::from("object").item(self.chosen);
                session.edit(&format!("remove {key}"), vec![Edit::Remove(key)]);
            }
        });
        ui.separator();
        let Some(object) = scene.objects.get(self.chosen) else {
            ui.label("A part of the volume with a look of its own. The first stroke of the brush makes it.");
            self.tool.ui(ui, session);
            return;
        };
        let key = KeyPath::from("object").item(self.chosen);
        let given = self.selected_by(ui, session, &key);
        match given {
            Some("strokes") if object.volume.is_none() => self.tool.ui(ui, session),
            Some("strokes") => drop(ui.weak("It has a volume of its own. Its strokes are edited among all keys.")),
            _ => {}
        }
        ui.separator();
        if object.motion.matrix.is_some() {
            ui.weak("It is moved by a matrix, which is edited among all keys.");
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let own = given.filter(|name| *name != "strokes");
            for name in own.into_iter().chain(KEYS) {
                if let Some(node) = self.keys.iter().find(|node| node.name == name) {
                    tree(ui, session, node, &key.name(name), &Filter::default());
                }
            }
        });
    }

    fn over_picture(&mut self, ui: &mut Ui, picture: &PictureArea, session: &mut Session) -> bool {
        let is_shown = std::mem::take(&mut self.is_shown);
        let Some(scene) = session.scene.clone() else { return false };
        self.chosen = self.chosen.min(scene.objects.len());
        let object = scene.objects.get(self.chosen);
        if session.is_painting && object.is_some_and(|object| object.strokes.is_none() || object.volume.is_some()) {
            session.is_painting = false;
            session.notice = format!("{} is not selected by a brush", object.map_or("", |object| &object.name));
        }
        let is_brush = self.tool.over_picture(ui, picture, session, self.chosen);
        let is_handle = match object.filter(|_| is_shown && !is_brush) {
            Some(object) => self.handles(ui, picture, session, object),
            None => false,
        };
        is_brush || is_handle
    }
}

impl ObjectsPanel {
    /// Shows how the object is selected, and lets the user choose. Returns the key that says it; none: all of the data.
    fn selected_by(&self, ui: &mut Ui, session: &mut Session, key: &KeyPath) -> Option<&'static str> {
        let has = |session: &Session, name: &str| session.document.get(&key.name(name)).is_some();
        let given = SELECTIONS.iter().find(|(name, _)| has(session, name)).copied();
        let mut chosen = given;
        ui.horizontal(|ui| {
            let label = ui.label("selected by").id;
            let text = given.map_or("nothing: all of it", |(_, text)| text);
            let combo = ComboBox::from_id_salt("selected by").selected_text(text).width(130.0).show_ui(ui, |ui| {
                for one in SELECTIONS
                    .into_iter()
                    .filter(|one| !["selection", "strokes"].contains(&one.0) || given == Some(*one))
                {
                    ui.selectable_value(&mut chosen, Some(one), one.1);
                }
                ui.selectable_value(&mut chosen, None, "nothing: all of it");
            });
            combo.response.labelled_by(label);
        });
        if chosen != given {
            let others = SELECTIONS.iter().filter(|one| Some(**one) != chosen);
            let mut edits: Vec<Edit> = others.map(|(name, _)| Edit::Remove(key.name(name))).collect();
            edits.extend(chosen.map(|(name, _)| Edit::Set(key.name(name), first(session, name))));
            session.edit("select otherwise", edits);
        }
        chosen.map(|(name, _)| name)
    }

    /// Shows the object's box with a handle for each axis of the world, and moves the object. Returns whether the pointer
    /// is on a handle.
    fn handles(&self, ui: &Ui, picture: &PictureArea, session: &mut Session, object: &ObjectTable) -> bool {
        let corners = session.boxes.get(self.chosen).copied().flatten();
        let (Some(corners), Some(pose), Some(data)) = (corners, session.pose(), session.data().cloned()) else {
            return false;
        };
        let map = object.motion.map(corners.iter().sum::<DVec3>() / 8.0);
        let corners = corners.map(|corner| map.transform_point3(corner));
        let painter = ui.painter_at(picture.rect);
        let place_of = |p: DVec3| pose.view.point_of(p).map(|p| picture.place(p));
        for (i, j) in (0..8).flat_map(|i| [1, 2, 4].map(|bit| (i, i | bit))).filter(|(i, j)| i != j) {
            if let (Some(from), Some(to)) = (place_of(corners[i]), place_of(corners[j])) {
                painter.line_segment([from, to], Stroke::new(2.0, Color32::from_black_alpha(90)));
                painter.line_segment([from, to], Stroke::new(1.0, Color32::from_white_alpha(140)));
            }
        }
        let centre = corners.iter().sum::<DVec3>() / 8.0;
        let mut is_taken = false;
        for (axis, name, color) in AXES.into_iter().filter(|_| object.motion.matrix.is_none()) {
            // From the side of the box to an eighth of the volume's radius beyond.
            let reach = corners.iter().map(|corner| (*corner - centre).dot(axis)).fold(0.0, f64::max);
            let foot = centre + axis * reach;
            let tip = foot + axis * (0.25 * data.volume.grid().radius());
            let handle = Handle { name: &format!("Move along {name}"), foot, tip, color };
            let grip = handle.show(ui, ui.scope_id().with(("move", name)), picture, &pose.view);
            is_taken |= grip.is_taken;
            if let Some(by) = grip.by {
                let key = KeyPath::from("object").item(self.chosen).name("move");
                session.set(&key, place(object.motion.shift + by, data.volume.grid()));
            }
        }
        is_taken
    }
}

/// Returns a first value of a key that says how an object is selected: the upper half of the values, or label 1.
fn first(session: &Session, name: &str) -> Value {
    if name == "label" {
        return 1.into();
    }
    let [lo, hi] = session.data().map_or([0.0, 1.0], |data| [data.histogram.lo, data.histogram.hi]);
    let pair = |share: f64, membership: i64| {
        Value::Array(Array::from_iter([number(lo + (hi - lo) * share), membership.into()]))
    };
    Value::Array(Array::from_iter([pair(0.5, 0), pair(0.625, 1)]))
}

/// Returns a name that no object of a scene has.
pub(super) fn new_name(scene: &tables::Scene) -> String {
    let names = (1..).map(|n| if n == 1 { "painted".to_owned() } else { format!("painted {n}") });
    let mut free = names.filter(|name| scene.objects.iter().all(|object| object.name != *name));
    free.next().unwrap_or_default()
}

/// Returns the edits that add an object to paint after all others, with the picture's function in another colour or style.
/// It has no stroke yet, so dabs must follow. A soft selection shares with the background what both are made of, unless
/// the scene says how they are combined.
pub(super) fn new_object(session: &Session, scene: &tables::Scene, name: &str) -> Vec<Edit> {
    // One stroke a line.
    let mut strokes = Array::new();
    strokes.set_trailing("\n");
    let mut object = InlineTable::from_iter([("name", Value::from(name)), ("strokes", strokes.into())]);
    if let Some(transfer) = session.prepared.as_ref().and_then(|prepared| look(prepared, &session.document)) {
        object.insert("transfer", transfer.into());
    }
    let mut edits = vec![Edit::Insert("object".into(), usize::MAX, object)];
    if scene.objects.is_empty() && session.document.get(&"combine".into()).is_none() {
        edits.push(Edit::set("combine.fuzzy", "product"));
    }
    edits
}

/// Returns the function of what is painted: the picture's in one style or colour, mixed as the document says for the
/// picture's. None for a function over two quantities.
fn look(scene: &tables::Scene, document: &Document) -> Option<InlineTable> {
    let transfer = scene.transfer.as_ref().filter(|transfer| transfer.rows.is_none())?;
    let nodes = transfer.nodes.as_ref()?;
    let style = style(&scene.styles, nodes);
    let node = |node: &tables::Node| {
        let color = match &node.color {
            NodeColor::Style(own) => NodeColor::Style(style.as_ref().unwrap_or(own).clone()),
            NodeColor::Color(_) => NodeColor::Color(COLOR),
        };
        table(&tables::Node { color, ..node.clone() }, transfer.kind)
    };
    let nodes: Array = nodes.iter().map(node).collect();
    let kind = match transfer.kind {
        tables::TransferKind::Style => "style",
        tables::TransferKind::Regular => "regular",
    };
    let mut look = InlineTable::from_iter([("kind", Value::from(kind)), ("nodes", nodes.into())]);
    if transfer.unit != Unit::Value {
        look.insert("unit", transfer.unit.name().into());
    }
    for name in ["transparency", "mix", "sphere_frame", "table"] {
        if let Some(value) = document.get(&KeyPath::from("transfer").name(name)).and_then(Item::as_value) {
            let mut value = value.clone();
            value.decor_mut().clear();
            look.insert(name, value);
        }
    }
    Some(look)
}

/// Returns the style of what is painted: in a theme without [`STYLE`], it is the first one that no node of the picture has.
fn style(styles: &tables::Styles, nodes: &[tables::Node]) -> Option<String> {
    let theme = Theme::open(&Disk, &styles.theme).ok();
    let of_theme = theme.iter().flat_map(Theme::names);
    let all: Vec<&str> = styles.files.iter().map(|(name, _)| name.as_str()).chain(of_theme).collect();
    let is_taken = |name: &str| nodes.iter().any(|node| matches!(&node.color, NodeColor::Style(own) if own == name));
    let free = || all.iter().find(|name| !is_taken(name));
    all.iter().find(|name| **name == STYLE).or_else(free).map(|name| (*name).to_owned())
}
